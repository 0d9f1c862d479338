// Vapour, tracer and heat, carried by the fluxes of the projection: implicit upwind, brought to second order as far as
// no new extremes appear, and two-point diffusion taken at both ends of the step as far as the step is short for it.
//
// Heat is solved in its sensible part, capacity times (T - 0 degC): the part that vapour holds, its evaporation
// enthalpy at 0 degC, travels with the vapour's own fluxes. The capacity fluxes follow from the fluxes of mass and
// vapour, diffusion included, so that gas of one temperature keeps it whatever its vapour does.
#include "granum/base/vectorised.hpp"
#include "granum/gas/inside.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace
{
constexpr double sweep_tolerance = 1e-12;  // change of a sweep over the largest value
constexpr int most_sweeps = 500;
constexpr double longest_explicit = 1.0 / 6;  // of a link's diffusion, over the capacity of its smaller cell

struct Loop
{
    std::array<std::ptrdiff_t, 3> s;
    double per_dt, dt;
    double const *capacity, *content, *source, *sink, *earlier, *x;
    std::array<double const*, 3> flux, conductance, added;
    std::array<double*, 6> coupling;
    std::array<double*, 3> passed;
    double *inverse, *right;
};

inline double positive(double x)
{
    return x > 0 ? x : 0;
}

//! Share of a link's diffusion that is taken at the beginning of the step.
inline double early(Loop const& l, std::size_t e, Index q)
{
    double const here = l.capacity[q], there = l.capacity[q - static_cast<Index>(l.s[e])];
    double const fast = l.dt * l.conductance[e][q], room = longest_explicit * (here < there ? here : there);
    return 0.5 * fast > room ? room / fast : 0.5;
}

GRANUM_VECTORISED void assemble(Loop const& given, Index first, Index end)
{
    Loop const l = given;
#pragma GCC ivdep
    for (Index c = first; c < end; ++c) {
        double centre = l.capacity[c] * l.per_dt + l.sink[c];
        double right = l.content[c] * l.per_dt + l.source[c];
        for (std::size_t e = 0; e < 3; ++e) {
            Index const se = static_cast<Index>(l.s[e]), low = c - se, high = c + se;
            double const in = l.flux[e][c], out = l.flux[e][high];
            double const below = early(l, e, c), above = early(l, e, high);
            double const late_below = (1 - below) * l.conductance[e][c];
            double const late_above = (1 - above) * l.conductance[e][high];
            l.coupling[2 * e][c] = positive(in) + late_below;
            l.coupling[2 * e + 1][c] = positive(-out) + late_above;
            centre += positive(-in) + late_below + positive(out) + late_above;
            right += below * l.conductance[e][c] * (l.earlier[low] - l.earlier[c]) +
                     above * l.conductance[e][high] * (l.earlier[high] - l.earlier[c]);
        }
        l.inverse[c] = 1 / centre;
        l.right[c] = right;
    }
}

//! Total flux through the lower face of c across e, with `added` from convection of second order.
inline double passes(Loop const& l, std::size_t e, Index c)
{
    Index const low = c - static_cast<Index>(l.s[e]);
    double const flux = l.flux[e][c], at_start = early(l, e, c);
    double const fall = (1 - at_start) * (l.x[low] - l.x[c]) + at_start * (l.earlier[low] - l.earlier[c]);
    return flux * (flux > 0 ? l.x[low] : l.x[c]) + l.conductance[e][c] * fall + l.added[e][c];
}

GRANUM_VECTORISED void pass(Loop const& given, std::size_t e, Index first, Index end)
{
    Loop const l = given;
    double* const __restrict passed = l.passed[e];
#pragma GCC ivdep
    for (Index c = first; c < end; ++c) passed[c] = passes(l, e, c);
}
}

void Solver::Inside::carry(Carried& what, Field& x, Range& range, double dt)
{
    // Beyond openings stands what enters there.
    auto const outside = [&](OpenFace const& face) { return face.upper ? face.face : before(face.face, face.d); };
    for (auto const& face : inlets) x[outside(face)] = what.at_inlets[face.number];
    for (auto const& face : outlets) x[outside(face)] = what.at_outlets[face.number];
    Field const earlier = x;
    for (std::size_t e = 0; e < 3; ++e)
        if (repeats_itself(e))
            for (auto* links : {&what.flux[e], &what.conductance[e]}) std::fill(links->begin(), links->end(), 0.0);

    Loop loop{.s = grid.strides,
              .per_dt = 1 / dt,
              .dt = dt,
              .capacity = what.capacity.data(),
              .content = what.content.data(),
              .source = what.source.data(),
              .sink = what.sink.data(),
              .earlier = earlier.data(),
              .x = x.data(),
              .flux = {},
              .conductance = {},
              .added = {},
              .coupling = {},
              .passed = {},
              .inverse = rows.inverse.data(),
              .right = rows.right.data()};
    for (std::size_t e = 0; e < 3; ++e) {
        loop.flux[e] = what.flux[e].data();
        loop.conductance[e] = what.conductance[e].data();
        loop.added[e] = limit.added[e].data();
        loop.passed[e] = what.passed[e].data();
    }
    for (std::size_t m = 0; m < 6; ++m) loop.coupling[m] = rows.coupling[m].data();
    rows.ends.clear();
    for (auto const& run : cells) assemble(loop, run.first, run.end);
    sweep(rows, cells, x, sweep_tolerance, most_sweeps);

    limit.clear();
    if (settings.second_order) {
        sharpen(cells,
                {{&what.flux[0], &what.flux[1], &what.flux[2]},
                 {&solved[0], &solved[1], &solved[2]},
                 {&low_share[0], &low_share[1], &low_share[2]}},
                x, earlier);
        std::array<double, 2> seen{range.most, -range.least};
        for (std::size_t k = 0; k < settings.inlets.size() && what.entering_bounds; ++k)
            if (settings.inlets[k].mass_flow > 0)
                seen = {std::max(seen[0], what.at_inlets[k]), std::max(seen[1], -what.at_inlets[k])};
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) seen = {std::max(seen[0], x[c]), std::max(seen[1], -x[c])};
        comm.max(seen);
        range = {-seen[1], seen[0]};
        Field& room = rows.partial;
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) room[c] = what.capacity[c] / dt;
        FaceField const& known = what.entering_bounds ? bounding : solved;
        limit.scale(grid, cells, x, earlier, room, {&solved[0], &solved[1], &solved[2]},
                    {&known[0], &known[1], &known[2]}, range.least, range.most);
    }

    // What passed each face at the solution; contents change by that and by nothing else.
    for (std::size_t e = 0; e < 3; ++e) {
        for (auto const& run : cells) pass(loop, e, run.first, run.end);
        for (auto const* list : {&inlets, &outlets})
            for (auto const& face : *list)
                if (face.d == e && face.upper) what.passed[e][face.face] = passes(loop, e, face.face);
    }
    refresh({&what.passed[0], &what.passed[1], &what.passed[2]});
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c) {
            double gain = what.source[c] - what.sink[c] * x[c];
            for (std::size_t d = 0; d < 3; ++d) gain += what.passed[d][c] - what.passed[d][next(c, d)];
            what.content[c] += dt * gain;
        }
}

void Solver::Inside::conduct(Field const& property)
{
    for (std::size_t d = 0; d < 3; ++d) {
        auto& conductance = carried.conductance[d];
        for (auto const& run : faces[d])
            for (Index q = run.first; q < run.end; ++q)
                conductance[q] = 0.5 * (property[q] + property[before(q, d)]) * area[d][q] * per_gap[d][q];
        refresh({&conductance});
    }
}

void Solver::Inside::add_passed(double Balance::*in, double Balance::*out, double dt, double worth, Balance& to) const
{
    for (auto const& face : inlets) to.*in += dt * worth * carried.passed[face.d][face.face] * (face.upper ? -1 : 1);
    for (auto const& face : outlets) to.*out += dt * worth * carried.passed[face.d][face.face] * (face.upper ? 1 : -1);
}

void Solver::Inside::carry_scalars(State& state, Sources const& sources, double dt, Balance& balance)
{
    using namespace material;
    constexpr double more = heat_capacity_vapour - heat_capacity_air;
    Settings const& set = settings;
    Carried& it = carried;
    for (auto const& face : inlets) balance.mass_in += dt * set.inlets[face.number].mass_flow * face.share;
    for (auto const& face : outlets)
        balance.mass_out += dt * state.mass_flux[face.d][face.face] * (face.upper ? 1 : -1);
    auto const at_openings = [&](auto&& of_inlet, auto&& of_outlet) {
        it.at_inlets.clear(), it.at_outlets.clear();
        for (auto const& inlet : set.inlets) it.at_inlets.push_back(of_inlet(inlet));
        for (auto const& outlet : set.outlets) it.at_outlets.push_back(of_outlet(outlet));
    };
    Field property = grid.make_field();

    // Sensible heat before the vapour changes.
    Field sensible = grid.make_field();
    for (Index c = 0; c < grid.size(); ++c) sensible[c] = state.enthalpy[c] - evaporation_enthalpy_0 * state.vapour[c];

    std::fill(it.sink.begin(), it.sink.end(), 0.0);
    it.capacity = state.mass;
    it.flux = state.mass_flux;
    if (set.tracer) {
        for (Index c = 0; c < grid.size(); ++c)
            property[c] = grid.open(c) ? state.mass[c] / grid.open_volume[c] * set.tracer->diffusivity : 0;
        if (closure) add_eddies(property, set.turbulence.schmidt);
        conduct(property);
        it.content = state.tracer;
        std::fill(it.source.begin(), it.source.end(), 0.0);
        // Gas of another molar mass is many times as heavy: the projection, which knows the gas of the step before
        // only, needs the first cell behind an inlet to follow slowly.
        it.entering_bounds = !set.tracer->molar_mass;
        at_openings([](auto const& in) { return in.tracer_fraction; },
                    [](auto const& out) { return out.ambient_tracer_fraction; });
        carry(it, state.tracer_fraction, state.tracer_fractions, dt);
        state.tracer = it.content;
        add_passed(&Balance::tracer_in, &Balance::tracer_out, dt, 1, balance);
    }

    for (Index c = 0; c < grid.size(); ++c)
        property[c] = grid.open(c) ? state.mass[c] / grid.open_volume[c] *
                                         set.diffusivity.value_or(diffusivity(state.temperature[c], set.pressure))
                                   : 0;
    if (closure) add_eddies(property, set.turbulence.schmidt);
    conduct(property);
    it.content = state.vapour;
    it.source = sources.vapour;
    it.entering_bounds = !set.molar_mass && !set.vapour_molar_mass;
    at_openings([](auto const& in) { return in.vapour_fraction; },
                [](auto const& out) { return out.ambient_vapour_fraction; });
    carry(it, state.vapour_fraction, state.vapour_fractions, dt);
    state.vapour = it.content;
    add_passed(&Balance::vapour_in, &Balance::vapour_out, dt, 1, balance);
    add_passed(&Balance::enthalpy_in, &Balance::enthalpy_out, dt, evaporation_enthalpy_0, balance);

    for (Index c = 0; c < grid.size(); ++c)
        property[c] =
            grid.open(c) ? state.voidage[c] * set.conductivity.value_or(conductivity(state.temperature[c])) : 0;
    if (closure) add_eddies(property, set.turbulence.prandtl / heat_capacity_air);
    conduct(property);
    for (std::size_t d = 0; d < 3; ++d)
        for (Index q = 0; q < grid.size(); ++q)
            it.flux[d][q] = heat_capacity_air * state.mass_flux[d][q] + more * it.passed[d][q];
    for (Index c = 0; c < grid.size(); ++c) {
        it.capacity[c] = heat_capacity_air * state.mass[c] + more * state.vapour[c];
        it.source[c] = sources.enthalpy[c] - evaporation_enthalpy_0 * sources.vapour[c] + sources.heat_value[c];
        exchanged[c] = state.temperature[c] - math::zero_celsius;
    }
    refresh({&it.capacity});
    it.content = sensible;
    it.sink = sources.heat_coefficient;
    it.entering_bounds = true;
    add_walls(state, it);
    add_pressure_work(state, dt, it);
    at_openings([](auto const& in) { return in.temperature - math::zero_celsius; },
                [](auto const& out) { return out.ambient_temperature - math::zero_celsius; });
    Range above_zero{state.temperatures.least - math::zero_celsius, state.temperatures.most - math::zero_celsius};
    carry(it, exchanged, above_zero, dt);
    state.temperatures = {above_zero.least + math::zero_celsius, above_zero.most + math::zero_celsius};
    add_passed(&Balance::enthalpy_in, &Balance::enthalpy_out, dt, 1, balance);
    for (auto const& exchange : wall_exchange)
        balance.wall_heat += dt * exchange.conductance * (exchanged[exchange.cell] - exchange.outside);
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c)
            state.enthalpy[c] = it.content[c] + evaporation_enthalpy_0 * state.vapour[c];
    for (double& value : exchanged) value += math::zero_celsius;
}

// Walls of a given temperature conduct through the gas between them and the middle of the cell.
void Solver::Inside::add_walls(State const& state, Carried& heat)
{
    wall_exchange.clear();
    for (std::size_t first = 0; first < wall_pieces.size();) {
        // The pieces of a cell are the projections of its wall.
        std::size_t end = first;
        double sum = 0, squares = 0;
        for (; end < wall_pieces.size() && wall_pieces[end].cell == wall_pieces[first].cell; ++end)
            sum += wall_pieces[end].area, squares += wall_pieces[end].area * wall_pieces[end].area;
        bool const oblique = end - first > 1 && wall_oblique[first];
        double const share = oblique ? std::sqrt(squares) / sum : 1;
        for (; first < end; ++first) {
            auto const& piece = wall_pieces[first];
            auto const& wall = settings.walls[piece.wall];
            Index const c = piece.cell;
            double conductance = share * piece.area * wall.loss;
            if (wall.temperature)
                conductance = share * piece.area / piece.distance * state.voidage[c] *
                              settings.conductivity.value_or(material::conductivity(state.temperature[c])) *
                              (closure ? closure->wall_heat[first] : 1);
            if (conductance == 0) continue;
            double const outside = wall.temperature.value_or(wall.outside) - math::zero_celsius;
            heat.sink[c] += conductance;
            heat.source[c] += conductance * outside;
            wall_exchange.push_back({c, conductance, outside});
        }
    }
}

// A change of the pressure does work on the gas; that of flow against its gradient stays with the heat of friction.
void Solver::Inside::add_pressure_work(State const& state, double dt, Carried& heat) const
{
    bool const full = settings.compressibility == Compressibility::full;
    double const rise = (state.static_pressure - static_before) / dt;
    if (!full && rise == 0) return;
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c)
            heat.source[c] += gas_volume[c] * (full ? correction[c] / dt : rise);
}

double Solver::Inside::off_state(State const& state) const
{
    double worst = 0;
    bool const full = settings.compressibility == Compressibility::full;
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c) {
            double const at = full ? settings.pressure + state.pressure[c] : state.static_pressure;
            double const goal = gas_volume[c] * equation_of_state(at, state.temperature[c], state.vapour_fraction[c],
                                                                  state.tracer_fraction[c]);
            worst = std::max(worst, std::abs(state.mass[c] / goal - 1));
        }
    return comm.max(worst);
}

void Solver::Inside::derive(State& state) const
{
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c) {
            double const w = state.vapour[c] / state.mass[c];
            state.vapour_fraction[c] = w;
            state.tracer_fraction[c] = state.tracer[c] / state.mass[c];
            state.temperature[c] = material::temperature(state.enthalpy[c] / state.mass[c], w);
            state.density[c] = state.mass[c] / gas_volume[c];
        }
}
}
