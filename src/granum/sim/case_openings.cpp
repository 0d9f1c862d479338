// Reads [[inlet]], [[outlet]] and [[gas.wall]]: where gas enters and leaves, and what it meets.
#include "granum/base/error.hpp"
#include "granum/geometry/region.hpp"
#include "granum/io/csv.hpp"
#include "granum/sim/case_sections.hpp"

#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace granum::sim
{
using io::Dimension;

std::vector<std::string> const& end_names()
{
    static std::vector<std::string> const names{"left", "right", "front", "back", "bottom", "top"};
    return names;
}

namespace
{
std::size_t number_of_end(std::string const& name)
{
    auto const& names = end_names();
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

//! Holes of a triangular pattern, as far as they lie within the opening.
std::vector<HoleCase> triangular(double pitch, double radius, Vec3 const& lower, Vec3 const& upper, std::size_t e,
                                 std::size_t f)
{
    std::vector<HoleCase> out;
    double const row = pitch * std::sqrt(3.0) / 2, x0 = 0.5 * (lower[e] + upper[e]), y0 = 0.5 * (lower[f] + upper[f]);
    int const rows = static_cast<int>((upper[f] - lower[f]) / row) + 1;
    int const columns = static_cast<int>((upper[e] - lower[e]) / pitch) + 1;
    for (int j = -rows; j <= rows; ++j)
        for (int i = -columns; i <= columns; ++i) {
            double const x = x0 + (i + (j % 2 == 0 ? 0 : 0.5)) * pitch, y = y0 + j * row;
            if (x - radius < lower[e] || x + radius > upper[e] || y - radius < lower[f] || y + radius > upper[f])
                continue;
            out.push_back({x, y, radius});
        }
    return out;
}

OpeningCase read_opening(io::CaseFile& file, Case const& data, std::string const& key, std::string const& fallback_name,
                         std::string const& fallback_end)
{
    OpeningCase out;
    out.name = file.words(key + "name", fallback_name, "for messages and results");
    auto const end = number_of_end(file.name(
        key + "end", fallback_end, "end of the apparatus: x = 0 is left, y = 0 front", end_names(), "an end"));
    if (end >= end_names().size()) return out;
    out.direction = end / 2, out.upper = end % 2 == 1;
    if (data.periodic[out.direction]) file.mistake(key + "end", "repeats itself: nothing enters or leaves there");
    std::size_t const e = (out.direction + 1) % 3, f = (out.direction + 2) % 3;
    Vec3 const low = data.chamber.lower(), high = data.chamber.upper();

    bool const rectangle = file.has(key + "lower") || file.has(key + "upper");
    auto const lower = file.vector(key + "lower", Dimension::length, low, "corner of the part of the end that is open");
    auto const upper = file.vector(key + "upper", Dimension::length, high, "opposite corner");
    if (rectangle) {
        out.rectangle = RegionCase{lower, upper};
        if (!file.wrong(key + "lower") && !file.wrong(key + "upper") && (lower[e] >= upper[e] || lower[f] >= upper[f]))
            file.mistake(key + "upper", "is not beyond lower");
    }
    auto const diameter =
        file.optional_quantity(key + "diameter", Dimension::length, "of a round opening", io::positive);
    double const hole =
        file.quantity(key + "hole", Dimension::length, 0.0, "diameter that is closed in its middle", io::not_negative);
    Vec3 middle = 0.5 * (low + high);
    out.centre = file.vector(key + "centre", Dimension::length, middle, "of a round opening, rings or a profile");
    if (diameter) {
        out.round = true;
        out.outer = 0.5 * *diameter, out.inner = 0.5 * hole;
        if (rectangle) file.mistake(key + "diameter", "does not go with lower and upper");
        if (!(out.inner < out.outer)) file.mistake(key + "hole", "is not narrower than the opening");
    } else if (file.has(key + "hole")) {
        file.mistake(key + "hole", "belongs to an opening with a diameter");
    }
    return out;
}

void read_profile(io::CaseFile& file, Case const& data, std::string const& key, OpeningCase& out)
{
    auto const profile = file.name(key + "profile", "uniform", "of what enters over the opening",
                                   {"uniform", "parabolic", "rings", "holes"}, "a profile");
    out.parabolic = profile == "parabolic";
    if (out.parabolic && !out.round && !out.rectangle && data.chamber.shape == geometry::Chamber::Shape::solids)
        file.mistake(key + "profile", "needs the diameter, or lower and upper, in an apparatus of solids");
    auto const rings = file.table(key + "rings", 2, Dimension::length,
                                  "outer diameter of each ring and a length that says how much enters per area");
    if (profile == "rings") {
        if (rings.empty() && !file.wrong(key + "rings"))
            file.mistake(
                key + "rings", "is missing",
                {"e.g. [[\"60 mm\", \"1 m\"], [\"180 mm\", \"0.5 m\"]]: outer diameter, relative flow per area"});
        for (auto const& ring : rings) {
            if (!out.rings.empty() && 0.5 * ring[0] <= out.rings.back()[0])
                file.mistake(key + "rings", "must widen from row to row");
            if (ring[1] < 0) file.mistake(key + "rings", "has a flow below 0");
            out.rings.push_back({0.5 * ring[0], ring[1]});
        }
    } else if (file.has(key + "rings")) {
        file.mistake(key + "rings", "belongs to profile = \"rings\"");
    }
    auto const pitch =
        file.optional_quantity(key + "pitch", Dimension::length, "of holes in a triangular pattern", io::positive);
    auto const hole =
        file.optional_quantity(key + "hole_diameter", Dimension::length, "of a hole of the plate", io::positive);
    auto const list = file.words(key + "hole_file", "",
                                 "CSV of holes beside the case: x,y,diameter, then m,m,m, then a row for each");
    if (profile != "holes") {
        for (auto const* belongs : {"pitch", "hole_diameter", "hole_file"})
            if (file.has(key + belongs)) file.mistake(key + belongs, "belongs to profile = \"holes\"");
        return;
    }
    std::size_t const e = (out.direction + 1) % 3, f = (out.direction + 2) % 3;
    if (!list.empty()) {
        try {
            auto const series = io::read_series(file.beside(list));
            auto const column = [&](char const* name) -> std::vector<double> const& {
                auto const* const found = series.find(name);
                if (!found) throw base::IoError(fmt::format("{} has no column {}", list, name));
                return *found;
            };
            auto const &x = column("x"), &y = column("y"), &d = column("diameter");
            for (std::size_t k = 0; k < x.size(); ++k) out.holes.push_back({x[k], y[k], 0.5 * d[k]});
            file.note_contents(key + "hole_file", file.beside(list));
        } catch (base::Error const& error) {
            file.mistake(key + "hole_file", error.what());
        }
    } else if (pitch && hole && data.chamber.known()) {
        if (*hole >= *pitch) file.mistake(key + "hole_diameter", "is not below the pitch");
        Vec3 lower = data.chamber.lower(), upper = data.chamber.upper();
        if (out.rectangle) lower = out.rectangle->lower, upper = out.rectangle->upper;
        out.holes = triangular(*pitch, 0.5 * *hole, lower, upper, e, f);
        double const reach = out.round                                                    ? out.outer
                             : data.chamber.shape == geometry::Chamber::Shape::revolution ? data.chamber.radius(0)
                                                                                          : 1e300;
        std::erase_if(out.holes, [&](HoleCase const& one) {
            double const away = std::hypot(one.x - out.centre[e], one.y - out.centre[f]);
            return away + one.radius > reach || away - one.radius < out.inner;
        });
    } else if (!pitch || !hole) {
        file.mistake(key + "profile", "needs the holes", {"hole_file, or pitch and hole_diameter"});
    }
    if (data.chamber.known() && out.holes.empty() && !file.wrong(key + "hole_file") && !file.wrong(key + "profile") &&
        pitch && hole)
        file.mistake(key + "pitch", "leaves no hole in the opening");
}

InletCase read_inlet(io::CaseFile& file, Case const& data, std::string const& key, std::string const& fallback_name)
{
    GasCase const& gas = data.gas;
    InletCase inlet;
    inlet.at = read_opening(file, data, key, fallback_name, "bottom");
    read_profile(file, data, key, inlet.at);
    inlet.temperature = file.quantity(key + "temperature", Dimension::temperature, gas.inlet.temperature,
                                      "of what enters", {.low = 200, .high = 1000});
    static_cast<FlowCase&>(inlet) = read_flow(file, key, gas, inlet.temperature);
    inlet.tracer = file.quantity(key + "tracer", Dimension::one, 0.0, "kg per kg of what enters", io::zero_to_one);
    if (inlet.tracer > 0 && !gas.tracer) file.mistake(key + "tracer", "needs [gas.tracer]");
    inlet.turbulence_intensity =
        file.quantity(key + "turbulence_intensity", Dimension::one, gas.turbulence.intensity,
                      "root mean square of a fluctuation over the velocity of what enters", io::not_negative);
    inlet.turbulence_length = file.optional_quantity(key + "turbulence_length", Dimension::length,
                                                     "of the eddies that enter; 0.07 diameters", io::positive);
    if (!inlet.turbulence_length) inlet.turbulence_length = gas.turbulence.length;
    return inlet;
}

OutletCase read_outlet(io::CaseFile& file, Case const& data, std::string const& key, std::string const& fallback_name)
{
    GasCase const& gas = data.gas;
    OutletCase outlet;
    outlet.at = read_opening(file, data, key, fallback_name, "top");
    outlet.pressure = file.quantity(key + "pressure", Dimension::pressure, 0.0, "above gas.pressure");
    outlet.resistance = file.quantity(key + "resistance", Dimension::flow_resistance, outlet.resistance,
                                      "of the filter: pressure drop per velocity; 0: open", io::not_negative);
    outlet.temperature = file.quantity(key + "temperature", Dimension::temperature, gas.inlet.temperature,
                                       "of what is drawn in", {.low = 200, .high = 1000});
    outlet.humidity = file.quantity(key + "humidity", Dimension::one, gas.inlet.humidity,
                                    "of what is drawn in, kg water per kg dry air", io::not_negative);
    return outlet;
}
}

void read_openings(io::CaseFile& file, Case& data)
{
    GasCase& gas = data.gas;
    if (!gas.present) return;
    int const inlets = file.count("inlet"), outlets = file.count("outlet");
    if (gas.closed && inlets + outlets > 0) {
        file.mistake(inlets > 0 ? "inlet" : "outlet", "contradicts gas.closed = true");
        return;
    }
    std::set<std::string> names;
    auto const unique = [&](std::string const& key, std::string const& name) {
        if (!names.insert(name).second) file.mistake(key + "name", "is the name of another opening too");
    };
    for (int i = 0; i < inlets; ++i) {
        auto const key = fmt::format("inlet[{}].", i);
        InletCase inlet = read_inlet(file, data, key, inlets > 1 ? fmt::format("inlet-{}", i) : "inlet");
        unique(key, inlet.at.name);
        gas.inlets.push_back(std::move(inlet));
    }
    for (int i = 0; i < outlets; ++i) {
        auto const key = fmt::format("outlet[{}].", i);
        OutletCase outlet = read_outlet(file, data, key, outlets > 1 ? fmt::format("outlet-{}", i) : "outlet");
        unique(key, outlet.at.name);
        gas.outlets.push_back(std::move(outlet));
    }
    if (inlets > 0 && outlets == 0 && gas.compressibility == "constant")
        file.mistake("inlet", "lets gas in, but no [[outlet]] lets it out",
                     {"add [[outlet]] with end = \"top\"", "gas of constant density cannot fill a closed vessel"});
    auto const overlap = [](OpeningCase const& a, OpeningCase const& b) {
        return a.direction == b.direction && a.upper == b.upper && !a.rectangle && !b.rectangle && !a.round && !b.round;
    };
    for (std::size_t i = 0; i < gas.inlets.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            if (overlap(gas.inlets[i].at, gas.inlets[j].at))
                file.mistake(fmt::format("inlet[{}]", i), "takes the same end as \"" + gas.inlets[j].at.name + "\"",
                             {"give each its part: lower and upper, or diameter"});
        for (auto const& outlet : gas.outlets)
            if (overlap(gas.inlets[i].at, outlet.at))
                file.mistake(fmt::format("inlet[{}]", i), "takes the same end as the outlet \"" + outlet.at.name + "\"",
                             {"give each its part: lower and upper, or diameter"});
    }
    // The plate of [gas] where no inlet is told.
    if (inlets == 0 && !gas.closed && outlets == 0) {
        InletCase plate;
        static_cast<FlowCase&>(plate) = gas.inlet;
        plate.at.name = "plate";
        plate.turbulence_intensity = gas.turbulence.intensity;
        plate.turbulence_length = gas.turbulence.length;
        gas.inlets.push_back(plate);
        OutletCase outlet;
        outlet.at = {.name = "outlet", .direction = 2, .upper = true};
        outlet.temperature = gas.inlet.temperature, outlet.humidity = gas.inlet.humidity;
        gas.outlets.push_back(outlet);
    }
}

void read_gas_walls(io::CaseFile& file, Case& data)
{
    GasCase& gas = data.gas;
    if (!gas.present) return;
    GasWallCase everywhere;
    everywhere.loss = file.quantity("gas.heat_loss", Dimension::heat_transfer, 0.0,
                                    "of all walls to the surroundings; 0: adiabatic", io::not_negative);
    everywhere.outside =
        file.quantity("gas.surroundings", Dimension::temperature, 293.15, "temperature outside", io::positive);
    gas.walls = {everywhere};
    std::vector<std::string> known{"all"};
    using Shape = geometry::Chamber::Shape;
    auto const& region = data.chamber.region;
    // Of a box and of a body of revolution the chamber itself is the first solid.
    for (std::size_t k = data.chamber.shape == Shape::solids ? 0 : 1; region && k < region->solids(); ++k)
        known.push_back(region->name(k));
    if (data.chamber.shape == Shape::box) {
        for (std::size_t end = 0; end < 6; ++end)
            if (!data.periodic[end / 2]) known.push_back(end_names()[end]);
    } else if (data.chamber.shape == Shape::revolution) {
        known.insert(known.end(), {"chamber", "bottom", "top"});
    }
    std::set<std::string> met;
    for (int i = 0; i < file.count("gas.wall"); ++i) {
        auto const key = fmt::format("gas.wall[{}].", i);
        GasWallCase wall;
        wall.of = file.name(key + "of", "all", "which wall", known, "a wall");
        if (!met.insert(wall.of).second) file.mistake(key + "of", "names a wall that has been described already");
        wall.slip = file.boolean(key + "slip", false, "gas slides along it without friction");
        wall.velocity = file.vector(key + "velocity", Dimension::velocity, Vec3{}, "of the wall along itself");
        wall.temperature = file.optional_quantity(key + "temperature", Dimension::temperature, "of the wall",
                                                  {.low = 200, .high = 1000});
        wall.loss = file.quantity(key + "heat_loss", Dimension::heat_transfer, everywhere.loss, "to the surroundings",
                                  io::not_negative);
        wall.outside = file.quantity(key + "surroundings", Dimension::temperature, everywhere.outside,
                                     "temperature outside", io::positive);
        if (wall.temperature && file.has(key + "heat_loss"))
            file.mistake(key + "heat_loss", "and temperature cannot both be given");
        if (wall.slip && math::norm(wall.velocity) > 0)
            file.mistake(key + "velocity", "has no effect on gas that slips");
        if (wall.of == "all")
            gas.walls.front() = wall;
        else
            gas.walls.push_back(wall);
    }
}
}
