#include "granum/sim/scale.hpp"

#include "granum/base/error.hpp"
#include "granum/io/case_edit.hpp"
#include "granum/sim/balance.hpp"
#include "granum/sim/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace granum::sim
{
namespace
{
std::string in(double value, char const* unit)
{
    return fmt::format("\"{:.8g} {}\"", value, unit);
}

//! To a nanometre: 0 for the cosine of a right angle.
std::string at(Vec3 const& x)
{
    auto const mm = [](double length) { return in(std::round(1e9 * length) / 1e6 + 0.0, "mm"); };
    return fmt::format("[{}, {}, {}]", mm(x.x), mm(x.y), mm(x.z));
}

//! Places above the plate of the pilot.
std::vector<Vec3> places(Case const& lab, int nozzles, double across, double up)
{
    Vec3 const& own = lab.spray.nozzles.front().position;
    double const z = own.z * up;
    std::vector<Vec3> out;
    if (lab.chamber.shape == geometry::Chamber::Shape::revolution) {
        if (nozzles == 1) return {{own.x * across, own.y * across, z}};
        double const ring = across * lab.chamber.radius(0) / std::sqrt(2.0);
        for (int n = 0; n < nozzles; ++n) {
            double const angle = 2 * math::pi * n / nozzles;
            out.push_back({ring * std::cos(angle), ring * std::sin(angle), z});
        }
        return out;
    }
    auto const& size = lab.chamber.size;
    int const rows = nozzles % 2 == 0 && nozzles > 2 ? 2 : 1, columns = nozzles / rows;
    bool const along_x = size.x >= size.y;
    for (int n = 0; n < nozzles; ++n) {
        double const first = (n % columns + 0.5) / columns, second = (n / columns + 0.5) / rows;
        out.push_back({across * size.x * (along_x ? first : second), across * size.y * (along_x ? second : first), z});
    }
    return out;
}

void refuse(std::string const& path, std::string const& key, std::string const& what,
            std::vector<std::string> hints = {})
{
    throw base::CaseError({{path, 0, key, what, std::move(hints)}});
}
}

std::string scaled_case(std::string const& path, Scaling const& scaling)
{
    Case const lab = read_case(path).data;
    if (lab.chamber.shape == geometry::Chamber::Shape::solids || !lab.bodies.empty() || !lab.walls.empty())
        refuse(path, "apparatus", "is made of solids or has bodies in it: which of them a pilot has is not told",
               {"scale cases of shape \"revolution\" or \"box\""});
    if (lab.spray.nozzles.size() != 1)
        refuse(path, "nozzle", fmt::format("is there {} times: a case to scale has one", lab.spray.nozzles.size()));
    io::CaseEdit edit(path);
    for (auto const* name : {"inlet", "outlet"})
        if (edit.has(name))
            refuse(path, name, "is where a pilot's is not told: scale cases whose air comes through the plate");
    if (lab.granules.batches.size() != 1 || !lab.feeds.empty())
        refuse(path, "granules", "must be one batch without feeds to be scaled");
    if (!(scaling.factor > 0) || scaling.nozzles < 1) refuse("", "--factor, --nozzles", "must be above 0");

    bool const alike = scaling.likeness == Likeness::geometry;
    double const across = alike ? std::cbrt(scaling.factor) : std::sqrt(scaling.factor), up = alike ? across : 1;
    double const area = across * across;
    edit.set("title", fmt::format("\"{} x {:g}, {} nozzle{}\"", lab.title, scaling.factor, scaling.nozzles,
                                  scaling.nozzles == 1 ? "" : "s"));
    if (lab.chamber.shape == geometry::Chamber::Shape::revolution) {
        std::string profile = "[";
        for (auto const& point : lab.chamber.profile)
            profile += fmt::format("{}[{}, {}]", profile.size() > 1 ? ", " : "", in(1e3 * up * point.height, "mm"),
                                   in(2e3 * across * point.radius, "mm"));
        edit.set("apparatus.profile", profile + "]");
    } else {
        auto const& size = lab.chamber.size;
        edit.set("apparatus.size", at({across * size.x, across * size.y, up * size.z}));
    }
    // Cells as large as in the lab.
    edit.remove("gas.cell_size");
    auto const cells = [&](int count, double factor) {
        return std::max(3, static_cast<int>(std::lround(factor * count)));
    };
    edit.set("gas.cells", fmt::format("[{}, {}, {}]", cells(lab.gas.cells[0], across), cells(lab.gas.cells[1], across),
                                      cells(lab.gas.cells[2], up)));
    // A velocity stays; a flow grows with the plate.
    if (!edit.has("gas.velocity")) {
        for (auto const* key : {"gas.flow", "gas.flow_reference"}) edit.remove(key);
        edit.set("gas.dry_mass_flow", in(3600 * area * dry_inlet_flow(lab), "kg/h"));
    }
    auto const& granules = lab.granules.batches.front();
    if (edit.has("granules.number"))
        edit.set("granules.number", fmt::format("{:.0f}", scaling.factor * static_cast<double>(granules.parcels) *
                                                              std::pow(granules.parcel_ratio, 3)));
    if (edit.has("granules.mass")) edit.set("granules.mass", in(scaling.factor * lab.granules.mass, "kg"));
    if (edit.has("granules.parcels"))
        edit.set("granules.parcels", fmt::format("{:.0f}", scaling.factor * static_cast<double>(granules.parcels)));

    edit.set("spray.rate", in(3600 * area * lab.spray.rate, "kg/h"));
    edit.set("spray.parcels_per_second", in(area * lab.spray.parcels_per_second, "1/s"));
    edit.repeat("nozzle", scaling.nozzles);
    auto const where = places(lab, scaling.nozzles, across, up);
    double const share = area / scaling.nozzles;
    auto const& nozzle = lab.spray.nozzles.front();
    for (int n = 0; n < scaling.nozzles; ++n) {
        auto const key = fmt::format("nozzle[{}].", n);
        edit.set(key + "position", at(where[static_cast<std::size_t>(n)]));
        if (nozzle.air_mouth > 0)
            edit.set(key + "air_mouth", in(1e6 * share * nozzle.air_mouth, "mm2"));
        else if (nozzle.air_mass_flow > 0)
            edit.set(key + "air", in(3600 * share * nozzle.air_mass_flow, "kg/h"));
        if (nozzle.bore > 0) edit.set(key + "bore", in(1e3 * std::sqrt(share) * nozzle.bore, "mm"));
    }
    return edit.text(
        fmt::format("Made by granum scale --factor {:g} --nozzles {}{} from a lab case: same velocity, inlet air and "
                    "drying potential.",
                    scaling.factor, scaling.nozzles, alike ? " --alike geometry" : ""));
}
}
