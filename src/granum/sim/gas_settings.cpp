// From the gas of a case to the settings of the solver: openings as integrals over rectangles, walls by place.
#include "granum/base/error.hpp"
#include "granum/geometry/region.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/sim/balance.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/case_sections.hpp"

#include <algorithm>
#include <cmath>

namespace granum::sim
{
namespace
{
//! Integral of (x - a)(b - x) between two places within [a, b].
double parabola(double low, double high, double a, double b)
{
    double const from = std::clamp(low, a, b), to = std::clamp(high, a, b);
    auto const whole = [&](double x) { return x * (x * (0.5 * (a + b) - x / 3) - a * b); };
    return whole(to) - whole(from);
}

//! A rectangle of an end, along the two directions that lie in it.
struct Rectangle
{
    std::array<double, 2> low, high;
    double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }
};

double disc(Rectangle const& r, std::array<double, 2> const& centre, double radius)
{
    return geometry::circle_rectangle_area(radius, r.low[0] - centre[0], r.high[0] - centre[0], r.low[1] - centre[1],
                                           r.high[1] - centre[1]);
}

//! Integral of 1 - (r/R)^2 over the part of a rectangle within a circle: discs of all radii, each as thick as the fall
//! of the profile there.
double paraboloid(Rectangle const& r, std::array<double, 2> const& centre, double radius)
{
    constexpr int layers = 64;
    double sum = 0;
    for (int k = 0; k < layers; ++k) {
        double const share = (k + 0.5) / layers;  // of R squared
        sum += disc(r, centre, radius * std::sqrt(share)) / layers;
    }
    return sum;
}

//! Walls by their names: what of the chamber a point lies at.
void describe_walls(Case const& data, gas::Settings& settings)
{
    settings.walls.clear();
    std::vector<std::size_t> of_end(6, 0);
    std::size_t of_chamber = 0;
    std::vector<std::size_t> of_solid(data.chamber.region ? data.chamber.region->solids() : 0, 0);
    for (auto const& wall : data.gas.walls) {
        std::size_t const number = settings.walls.size();
        settings.walls.push_back({.slip = wall.slip,
                                  .velocity = wall.velocity,
                                  .temperature = wall.temperature,
                                  .loss = wall.loss,
                                  .outside = wall.outside});
        auto const& names = end_names();
        auto const end = std::find(names.begin(), names.end(), wall.of);
        if (end != names.end()) of_end[static_cast<std::size_t>(end - names.begin())] = number;
        if (wall.of == "chamber") of_chamber = number;
        for (std::size_t k = 0; k < of_solid.size(); ++k)
            if (data.chamber.region->name(k) == wall.of) of_solid[k] = number;
    }
    if (settings.walls.size() == 1) return;
    Vec3 const low = data.chamber.lower(), high = data.chamber.upper();
    using Shape = geometry::Chamber::Shape;
    std::size_t const first_end = data.chamber.shape == Shape::box          ? 0
                                  : data.chamber.shape == Shape::revolution ? 2
                                                                            : 3;
    settings.wall_at = [=, region = data.chamber.region](Vec3 const& x) {
        for (std::size_t d = first_end; d < 3; ++d) {
            double const near = 1e-9 * (high[d] - low[d]);
            if (std::abs(x[d] - low[d]) <= near) return of_end[2 * d];
            if (std::abs(x[d] - high[d]) <= near) return of_end[2 * d + 1];
        }
        return region ? of_solid[region->nearest_solid(x)] : of_chamber;
    };
}
}

gas::Opening gas_opening(Case const& data, OpeningCase const& one)
{
    gas::Opening out{.name = one.name, .direction = one.direction, .upper = one.upper, .share = {}};
    bool const even = !one.parabolic && one.rings.empty() && one.holes.empty();
    if (even && !one.round && !one.rectangle) return out;
    std::size_t const e = (one.direction + 1) % 3, f = (one.direction + 2) % 3;
    Vec3 const low = data.chamber.lower(), high = data.chamber.upper();
    Rectangle whole{{low[e], low[f]}, {high[e], high[f]}};
    if (one.rectangle)
        whole = {{std::max(low[e], one.rectangle->lower[e]), std::max(low[f], one.rectangle->lower[f])},
                 {std::min(high[e], one.rectangle->upper[e]), std::min(high[f], one.rectangle->upper[f])}};
    std::array<double, 2> const centre{one.centre[e], one.centre[f]};
    bool const round_chamber = data.chamber.shape == geometry::Chamber::Shape::revolution;
    double const widest = one.round       ? one.outer
                          : round_chamber ? data.chamber.radius(one.upper ? data.chamber.top() : data.chamber.bottom())
                                          : 0;
    std::array<bool, 2> const repeats{data.periodic[e], data.periodic[f]};
    out.share = [=](Vec3 const& from, Vec3 const& to) {
        Rectangle part;
        for (std::size_t a = 0; a < 2; ++a) {
            std::size_t const axis = a == 0 ? e : f;
            part.low[a] = std::max(from[axis], whole.low[a]);
            part.high[a] = std::min(to[axis], whole.high[a]);
            if (part.low[a] >= part.high[a]) return 0.0;
        }
        if (!one.holes.empty()) {
            double sum = 0;
            for (auto const& hole : one.holes) sum += disc(part, {hole.x, hole.y}, hole.radius);
            return sum;
        }
        if (!one.rings.empty()) {
            double sum = 0, inner = 0;
            for (auto const& [radius, flow] : one.rings) {
                double const within = disc(part, centre, radius);
                sum += flow * (within - inner);
                inner = within;
            }
            return sum;
        }
        if (one.parabolic && widest > 0) return paraboloid(part, centre, widest);
        if (one.parabolic) {
            double product = 1;
            for (std::size_t a = 0; a < 2; ++a)
                product *= repeats[a] ? part.high[a] - part.low[a]
                                      : parabola(part.low[a], part.high[a], whole.low[a], whole.high[a]);
            return product;
        }
        if (one.round) return disc(part, centre, one.outer) - disc(part, centre, one.inner);
        return part.area();
    };
    return out;
}

namespace
{
gas::Turbulence turbulence(Case const& data)
{
    TurbulenceCase const& given = data.gas.turbulence;
    gas::Turbulence out;
    auto const model = law::turbulence::All::make(given.model);
    base::require(model.has_value(), "there is no model of turbulence called \"{}\"", given.model);
    out.model = *model;
    auto const take = [&](char const* name, double& constant) {
        auto const found = given.constants.find(name);
        if (found != given.constants.end()) constant = found->second;
    };
    std::visit([&](auto& law) { law.each_constant(take); }, out.model);
    out.wall.each_constant(take);
    out.prandtl = given.prandtl, out.schmidt = given.schmidt;
    out.dense = given.dense, out.free = given.free;
    if (given.velocity) out.energy = 1.5 * *given.velocity * *given.velocity;
    out.length = given.length;
    out.granules = {.on = given.granules,
                    .wake = given.wake,
                    .lagrangian = given.memory,
                    .rate = given.rate,
                    .solids_density = data.granules.density};
    return out;
}
}

grid::Lines gas_lines(Case const& data)
{
    auto lines = grid::uniform_lines(data.chamber.lower(), data.chamber.upper(), data.gas.cells);
    for (std::size_t d = 0; d < 3; ++d)
        if (!data.gas.faces[d].empty()) lines[d] = data.gas.faces[d];
    return lines;
}

gas::Settings gas_settings(Case const& data)
{
    GasCase const& gas = data.gas;
    gas::Settings settings;
    settings.outlets.clear();
    for (auto const& inlet : gas.inlets)
        settings.inlets.push_back({.mass_flow = moist_mass_flow(data, inlet),
                                   .temperature = inlet.temperature,
                                   .vapour_fraction = material::fraction(inlet.humidity),
                                   .tracer_fraction = inlet.tracer,
                                   .turbulence_intensity = inlet.turbulence_intensity,
                                   .turbulence_length = inlet.turbulence_length,
                                   .at = gas_opening(data, inlet.at)});
    for (auto const& outlet : gas.outlets)
        settings.outlets.push_back({.pressure = outlet.pressure,
                                    .resistance = outlet.resistance,
                                    .ambient_temperature = outlet.temperature,
                                    .ambient_vapour_fraction = material::fraction(outlet.humidity),
                                    .at = gas_opening(data, outlet.at)});
    describe_walls(data, settings);
    settings.model = gas.model == "B" ? gas::Model::b : gas::Model::a;
    settings.compressibility = gas.compressibility == "constant" ? gas::Compressibility::constant
                               : gas.compressibility == "full"   ? gas::Compressibility::full
                                                                 : gas::Compressibility::low_mach;
    settings.tolerance = gas.tolerance;
    settings.pressure_solver = gas.pressure_solver == "pfmg"       ? solve::Method::pfmg
                               : gas.pressure_solver == "smg"      ? solve::Method::smg
                               : gas.pressure_solver == "diagonal" ? solve::Method::diagonal
                                                                   : solve::Method::multigrid;
    settings.second_order = gas.convection == "second-order";
    settings.pressure = gas.pressure;
    settings.gravity = data.gravity;
    settings.push = gas.push;
    settings.density = gas.density;
    settings.expansion = gas.expansion;
    settings.expansion_temperature = gas.expansion_temperature;
    settings.viscosity = gas.viscosity;
    settings.conductivity = gas.conductivity;
    settings.diffusivity = gas.diffusivity;
    settings.molar_mass = gas.molar_mass;
    settings.vapour_molar_mass = gas.vapour_molar_mass;
    settings.turbulence = turbulence(data);
    auto const thinning = law::viscosity::All::make(gas.thinning.law);
    base::require(thinning.has_value(), "there is no law of viscosity called \"{}\"", gas.thinning.law);
    settings.thinning = {*thinning, gas.thinning.infinite, gas.thinning.time, gas.thinning.exponent};
    if (gas.tracer) settings.tracer = gas::Tracer{gas.tracer->diffusivity, gas.tracer->molar_mass};
    return settings;
}
}
