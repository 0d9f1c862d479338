#include "granum/io/snapshot_file.hpp"

#include "granum/base/error.hpp"
#include "granum/geometry/cut_outline.hpp"
#include "granum/io/hdf5_file.hpp"
#include "granum/io/text_file.hpp"

namespace granum::io
{
namespace
{
//! Calls visit(name, numbers) for every plain column; the one list that writer and reader share.
template <class SnapshotType, class Visitor>
void for_each_numbers(SnapshotType& snapshot, Visitor&& visit)
{
    auto& granules = snapshot.granules;
    visit("granules_id", granules.id), visit("granules_material", granules.material);
    visit("granules_mass", granules.mass);
    visit("granules_radius", granules.radius), visit("granules_temperature", granules.temperature);
    visit("granules_moisture", granules.moisture), visit("granules_diameter", granules.diameter);
    visit("granules_count", granules.count), visit("granules_porosity", granules.porosity);
    visit("granules_layer_mass", granules.layer_mass);
    visit("droplets_diameter", snapshot.droplets.diameter);
    auto& gas = snapshot.gas;
    visit("gas_speed", gas.speed), visit("gas_temperature", gas.temperature), visit("gas_humidity", gas.humidity);
    visit("gas_voidage", gas.voidage), visit("gas_drying_potential", gas.drying_potential), visit("gas_open", gas.open);
}

template <class SnapshotType, class Visitor>
void for_each_points(SnapshotType& snapshot, Visitor&& visit)
{
    visit("granules_position", snapshot.granules.position);
    visit("granules_velocity", snapshot.granules.velocity);
    visit("granules_spin", snapshot.granules.spin);
    visit("droplets_position", snapshot.droplets.position);
    visit("nozzles", snapshot.nozzles);
}
}

std::vector<std::array<double, 2>> mid_plane_outline(geometry::Chamber const& chamber)
{
    if (chamber.region) return geometry::cut_outline(*chamber.region, mid_plane(chamber));
    if (chamber.shape == geometry::Chamber::Shape::box) {
        auto const& size = chamber.size;
        return {{0, 0}, {size.x, 0}, {size.x, size.z}, {0, size.z}};
    }
    std::vector<std::array<double, 2>> out;
    for (auto const& point : chamber.profile) out.push_back({point.radius, point.height});
    for (auto point = chamber.profile.rbegin(); point != chamber.profile.rend(); ++point)
        out.push_back({-point->radius, point->height});
    return out;
}

double mid_plane(geometry::Chamber const& chamber)
{
    return 0.5 * (chamber.lower().y + chamber.upper().y);
}

void write_snapshot(std::string const& path, Snapshot const& snapshot)
{
    std::string const temporary = path + ".part";
    {
        auto const file = create_hdf5(temporary);
        write_text_attribute(file, temporary, "units", "SI: m, s, K, kg, m/s, kg/kg");
        auto const& gas = snapshot.gas;
        write_numbers(file, temporary, "scalars",
                      {snapshot.time, snapshot.mid_plane, static_cast<double>(gas.nx), static_cast<double>(gas.nz),
                       gas.x0, gas.z0, gas.dx, gas.dz});
        for_each_numbers(snapshot,
                         [&](char const* name, auto const& numbers) { write_numbers(file, temporary, name, numbers); });
        for_each_points(snapshot, [&](char const* name, auto const& points) {
            std::vector<double> flat;
            flat.reserve(3 * points.size());
            for (auto const& x : points) flat.insert(flat.end(), {x.x, x.y, x.z});
            write_numbers(file, temporary, name, flat);
        });
        std::vector<double> outline;
        for (auto const& corner : snapshot.outline) outline.insert(outline.end(), {corner[0], corner[1]});
        write_numbers(file, temporary, "outline", outline);
        check_hdf5(H5Fflush(file, H5F_SCOPE_GLOBAL), temporary, "be flushed; is the disk full?");
    }
    rename_into_place(temporary, path);
}

Snapshot read_snapshot(std::string const& path)
{
    auto const file = open_hdf5(path);
    Snapshot out;
    auto const scalars = read_numbers(file, path, "scalars");
    if (scalars.size() != 8)
        throw base::IoError(fmt::format("{}: scalars has {} numbers, not 8", path, scalars.size()));
    out.time = scalars[0];
    out.mid_plane = scalars[1];
    out.gas.nx = static_cast<int>(scalars[2]), out.gas.nz = static_cast<int>(scalars[3]);
    out.gas.x0 = scalars[4], out.gas.z0 = scalars[5];
    out.gas.dx = scalars[6], out.gas.dz = scalars[7];
    for_each_numbers(out, [&](char const* name, auto& numbers) { numbers = read_numbers(file, path, name); });
    for_each_points(out, [&](char const* name, auto& points) {
        auto const flat = read_numbers(file, path, name);
        for (std::size_t i = 0; i + 2 < flat.size(); i += 3) points.push_back({flat[i], flat[i + 1], flat[i + 2]});
    });
    auto const outline = read_numbers(file, path, "outline");
    for (std::size_t i = 0; i + 1 < outline.size(); i += 2) out.outline.push_back({outline[i], outline[i + 1]});

    auto const rows = out.granules.position.size();
    auto const cells = static_cast<std::size_t>(out.gas.nx) * static_cast<std::size_t>(out.gas.nz);
    for_each_numbers(out, [&](std::string const name, auto const& numbers) {
        auto const expected = name.starts_with("granules") ? rows
                              : name.starts_with("gas")    ? cells
                                                           : out.droplets.position.size();
        if (!numbers.empty() && numbers.size() != expected)
            throw base::IoError(fmt::format("{}: {} has {} numbers, not {}", path, name, numbers.size(), expected));
    });
    return out;
}
}
