// The predictor: momentum of the gas on faces with the old pressure, implicit in convection, viscosity, drag and wall
// friction.
//
// Control volumes are the halves of the two cells at a face, so their mass fluxes are means of the cells' fluxes and
// obey the cells' continuity. Convection takes the fluxes of the middle of the step, extrapolated from the last two,
// and what a face starts from is less by what they bring: uniform flow stays uniform whatever the fluxes do. The mass
// at the end, that of the middle of the step, makes steps of equal length pass the momentum on without loss. After the
// sweeps what passes between control volumes is evaluated once more, so that what leaves one enters the next to
// round-off: convection, brought to second order (limit.hpp), and then viscosity with what came of it, at both ends of
// the step as far as the step is not long against its time.
//
// The stress is mu (grad u + grad u^T); its isotropic part belongs to the pressure.
#include "granum/base/vectorised.hpp"
#include "granum/gas/inside.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace
{
constexpr double sweep_tolerance = 1e-12;  // change of a sweep over the largest speed
constexpr int most_sweeps = 200;
constexpr double endless = 1e300;
constexpr double longest_explicit = 2;  // of a link's viscous exchange, over the mass of its smaller node
constexpr double fastest_extrapolation = 2;

//! What the loops over the faces of one direction read and write. Links at the index of their upper node.
struct Loop
{
    std::ptrdiff_t sd;
    std::array<std::ptrdiff_t, 3> s;
    double per_dt, dt, gravity, model_b, warm, reference;
    double const *inertia, *mass, *gas, *volume, *p, *per_gap, *drag, *carried, *force, *below, *above, *source,
        *friction, *dragged, *viscous, *u, *temperature;
    std::array<double const*, 3> flux, coupled, reach, velocity, area, per_gap_of;
    double *mobility, *inverse, *right, *stress;
    std::array<double*, 6> coupling;
    // Once the upwind solution is there:
    double const* x;
    std::array<double const*, 3> added;
    double* exact;
};

inline double positive(double x)
{
    return x > 0 ? x : 0;
}
inline double larger(double x, double y)
{
    return x > y ? x : y;
}

//! Viscosity times area over distance of a link, and the share of it that is taken at the beginning of the step.
struct Viscous
{
    double whole, early;
};
inline Viscous viscous_link(Loop const& l, std::size_t e, bool along, Index q)
{
    Index const low = q - static_cast<Index>(l.sd), se = static_cast<Index>(l.s[e]);
    double const mu =
        along ? l.viscous[low] : 0.25 * (l.viscous[low] + l.viscous[q] + l.viscous[low - se] + l.viscous[q - se]);
    double const whole = mu * l.reach[e][q];
    // Along the component the cell between both nodes stands for them: cells beyond are not all known.
    double const here = l.inertia[low] + (along ? l.inertia[low] : l.inertia[q]);
    double const there = along ? here : l.inertia[low - se] + l.inertia[q - se];
    double const lighter = 0.5 * (here < there ? here : there);
    double const fast = l.dt * whole, room = longest_explicit * lighter;
    return {whole, 0.5 * fast > room ? room / fast : 0.5};
}

//! Stress mu du_e/dx_d that a link carries beside mu du_d/dx_e.
inline double turned(Loop const& l, std::size_t e, bool along, Index q)
{
    Index const low = q - static_cast<Index>(l.sd);
    if (along) return l.viscous[low] * l.reach[e][q] * (l.u[q] - l.u[low]);
    Index const se = static_cast<Index>(l.s[e]);
    double const mu = 0.25 * (l.viscous[low] + l.viscous[q] + l.viscous[low - se] + l.viscous[q - se]);
    double const edge = 0.5 * (l.area[e][low] + l.area[e][q]) * l.coupled[e][q];
    return mu * edge * l.per_gap[q] * (l.velocity[e][q] - l.velocity[e][low]);
}

template <std::size_t d>
inline void assemble_one(Loop const& l, Index q)
{
    Index const low = q - static_cast<Index>(l.sd);
    double const gas = 0.5 * (l.gas[low] + l.gas[q]);
    double const volume = l.volume[q], u = l.u[q];
    double const under_pressure = l.model_b > 0 ? volume : gas, eps = l.model_b > 0 ? 1 : gas / volume;
    double const drag = 0.5 * (l.drag[low] + l.drag[q]);
    double const push = 0.5 * (l.carried[low] + l.carried[q]) + l.below[low] * l.force[low] + l.above[q] * l.force[q];
    double const friction = 0.5 * eps * (l.friction[low] + l.friction[q]);
    double const dragged = 0.5 * eps * (l.dragged[low] + l.dragged[q]);
    double const slope = (l.p[q] - l.p[low]) * l.per_gap[q];
    // In model B the gas carries its weight over the whole volume: the granules' buoyancy is its reaction.
    double weight = 0.5 * (l.mass[low] + l.mass[q]) * l.gravity;
    weight = l.model_b > 0 ? weight * volume / gas : weight;
    weight *= 1 - l.warm * (0.5 * (l.temperature[low] + l.temperature[q]) - l.reference);

    double sum = 0, early = 0, stress = 0, arrives = 0;
    auto const link = [&](std::size_t e, Index at, Index beside, bool upper, double* out) {
        double const through = l.flux[e][at];
        auto const [whole, share] = viscous_link(l, e, e == d, at);
        double const enters = positive(upper ? -through : through) * l.coupled[e][at];
        double const passed = eps * (1 - share) * whole;
        out[q] = enters + passed;
        sum += enters + passed;
        arrives += (upper ? -through : through) * l.coupled[e][at];
        double const at_start = share * whole * (l.u[beside] - u);
        early += at_start;
        double const across = turned(l, e, e == d, at);
        stress += upper ? across : -across;
    };
    for (std::size_t e = 0; e < 3; ++e) {
        Index const se = static_cast<Index>(l.s[e]);
        link(e, q, q - se, false, l.coupling[2 * e]);
        link(e, q + se, q + se, true, l.coupling[2 * e + 1]);
    }
    double const source = 0.5 * (l.source[low] + l.source[q]);
    double const alone = positive(source);  // enters at rest
    // The mass that the velocity at the end of the step goes with, and that at its beginning: by what arrives less.
    double after = 0.5 * (l.inertia[low] + l.inertia[q]) * l.per_dt;
    double const before = larger(after - (arrives + source), 0.25 * (l.mass[low] + l.mass[q]) * l.per_dt);
    after = before + (arrives + source);
    l.mobility[q] = after + drag + friction;
    l.stress[q] = early + stress;
    l.right[q] = before * u + push + weight + dragged - under_pressure * slope + eps * (early + stress);
    l.inverse[q] = 1 / (before + drag + friction + alone + sum);
}

//! Once convection is known, in its fluxes of second order: the equation that is left is that of viscosity.
template <std::size_t d>
inline void convect_one(Loop const& l, Index q)
{
    Index const low = q - static_cast<Index>(l.sd);
    double const eps = l.model_b > 0 ? 1 : 0.5 * (l.gas[low] + l.gas[q]) / l.volume[q];
    double const x = l.x[q];
    double const source = 0.5 * (l.source[low] + l.source[q]);
    double convected = -positive(-source) * x, sum = 0;
    auto const link = [&](std::size_t e, Index at, Index beside, bool upper, double* coupling) {
        double const through = l.flux[e][at];
        double const inwards = upper ? -through : through;
        convected += l.coupled[e][at] * (positive(inwards) * l.x[beside] - positive(-inwards) * x);
        auto const [whole, share] = viscous_link(l, e, e == d, at);
        coupling[q] = eps * (1 - share) * whole;
        sum += coupling[q];
    };
    for (std::size_t e = 0; e < 3; ++e) {
        Index const se = static_cast<Index>(l.s[e]);
        link(e, q, q - se, false, l.coupling[2 * e]);
        link(e, q + se, q + se, true, l.coupling[2 * e + 1]);
        convected += l.added[e][q] - l.added[e][q + se];
    }
    l.right[q] += convected;
    l.inverse[q] = 1 / (l.mobility[q] + sum);
}

//! The velocity from what passes the links, the same on both sides.
template <std::size_t d>
inline void pass_one(Loop const& l, Index q)
{
    double const x = l.x[q];
    double sum = l.right[q], late = 0;
    auto const link = [&](std::size_t e, Index at, Index beside, double const* coupling) {
        sum += coupling[q] * (l.x[beside] - x);
        auto const [whole, share] = viscous_link(l, e, e == d, at);
        late += (1 - share) * whole * (l.x[beside] - x);
    };
    for (std::size_t e = 0; e < 3; ++e) {
        Index const se = static_cast<Index>(l.s[e]);
        link(e, q, q - se, l.coupling[2 * e]);
        link(e, q + se, q + se, l.coupling[2 * e + 1]);
    }
    l.stress[q] += late;
    l.exact[q] = sum / l.mobility[q];
}

template <std::size_t d>
inline void assemble_run(Loop const& given, Index first, Index end)
{
    Loop const l = given;
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) assemble_one<d>(l, q);
}
template <std::size_t d>
inline void convect_run(Loop const& given, Index first, Index end)
{
    Loop const l = given;
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) convect_one<d>(l, q);
}
template <std::size_t d>
inline void pass_run(Loop const& given, Index first, Index end)
{
    Loop const l = given;
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) pass_one<d>(l, q);
}
GRANUM_VECTORISED void assemble_x(Loop const& l, Index first, Index end)
{
    assemble_run<0>(l, first, end);
}
GRANUM_VECTORISED void assemble_y(Loop const& l, Index first, Index end)
{
    assemble_run<1>(l, first, end);
}
GRANUM_VECTORISED void assemble_z(Loop const& l, Index first, Index end)
{
    assemble_run<2>(l, first, end);
}

GRANUM_VECTORISED void convect_x(Loop const& l, Index first, Index end)
{
    convect_run<0>(l, first, end);
}
GRANUM_VECTORISED void convect_y(Loop const& l, Index first, Index end)
{
    convect_run<1>(l, first, end);
}
GRANUM_VECTORISED void convect_z(Loop const& l, Index first, Index end)
{
    convect_run<2>(l, first, end);
}
GRANUM_VECTORISED void pass_x(Loop const& l, Index first, Index end)
{
    pass_run<0>(l, first, end);
}
GRANUM_VECTORISED void pass_y(Loop const& l, Index first, Index end)
{
    pass_run<1>(l, first, end);
}
GRANUM_VECTORISED void pass_z(Loop const& l, Index first, Index end)
{
    pass_run<2>(l, first, end);
}

//! Mass flux through the links of a component: the mean of those of its two cells.
GRANUM_VECTORISED void mean_flux(Index size, std::ptrdiff_t sd, double const* __restrict flux, double* __restrict out)
{
    for (Index q = static_cast<Index>(sd); q < size; ++q) out[q] = 0.5 * (flux[q - static_cast<Index>(sd)] + flux[q]);
}
}

void Solver::Inside::set_inlet_velocities(State& state) const
{
    for (auto const& face : inlets) {
        auto const& inlet = settings.inlets[face.number];
        double const density =
            equation_of_state(state.static_pressure, inlet.temperature, inlet.vapour_fraction, inlet.tracer_fraction);
        double const sign = face.upper ? -1 : 1, flux = inlet.mass_flow * face.share;
        state.mass_flux[face.d][face.face] = sign * flux;
        state.velocity[face.d][face.face] = sign * flux / (density * state.voidage[face.inside] * face.area);
    }
}

void Solver::Inside::predict(State& state, SharedSources const& sources, double dt)
{
    for (Index c = 0; c < viscous.size(); ++c) viscous[c] = grid.open(c) ? viscosity(state.temperature[c]) : 0;
    if (closure) close(state);

    double const ahead = state.last_step > 0 ? 0.5 * std::min(dt / state.last_step, fastest_extrapolation) : 0;
    for (std::size_t d = 0; d < 3; ++d)
        for (Index q = 0; q < viscous.size(); ++q)
            middle_flux[d][q] = state.mass_flux[d][q] + ahead * (state.mass_flux[d][q] - state.earlier_flux[d][q]);
    inertia = state.mass;
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c) {
            double leaves = 0;
            for (std::size_t d = 0; d < 3; ++d) leaves += state.mass_flux[d][next(c, d)] - state.mass_flux[d][c];
            inertia[c] = std::max(inertia[c] - 0.5 * dt * leaves, 0.5 * inertia[c]);
        }
    refresh({&inertia});
    stepped = true;

    for (std::size_t d = 0; d < 3; ++d) {
        std::fill(friction[d].begin(), friction[d].end(), 0.0);
        std::fill(dragged[d].begin(), dragged[d].end(), 0.0);
    }
    for (std::size_t n = 0; n < wall_pieces.size(); ++n) {
        auto const& piece = wall_pieces[n];
        auto const& wall = settings.walls[piece.wall];
        if (wall.slip) continue;
        double const viscosity_here = closure ? closure->wall_viscosity[n] : viscous[piece.cell];
        double const holds = viscosity_here * piece.area / piece.distance;
        for (std::size_t d = 0; d < 3; ++d) {
            if (d == piece.e) continue;
            friction[d][piece.cell] += holds;
            dragged[d][piece.cell] += holds * wall.velocity[d];
        }
    }
    refresh({&friction[0], &friction[1], &friction[2], &dragged[0], &dragged[1], &dragged[2]});

    begun = state.velocity;
    for (std::size_t d = 0; d < 3; ++d) predict_component(d, state, sources, dt);
}

void Solver::Inside::predict_component(std::size_t d, State& state, SharedSources const& sources, double dt)
{
    Field& x = state.velocity[d];
    Field const& before_step = begun[d];
    auto const pointers = [](auto const& fields) {
        return std::array<double const*, 3>{fields[0].data(), fields[1].data(), fields[2].data()};
    };
    for (std::size_t e = 0; e < 3; ++e)
        mean_flux(x.size(), grid.strides[d], middle_flux[e].data(), link_flux[e].data());
    Loop loop{.sd = grid.strides[d],
              .s = grid.strides,
              .per_dt = 1 / dt,
              .dt = dt,
              .gravity = settings.gravity[d],
              .model_b = settings.model == Model::b ? 1.0 : 0.0,
              .warm = settings.expansion,
              .reference = settings.expansion_temperature,
              .inertia = inertia.data(),
              .mass = state.mass.data(),
              .gas = gas_volume.data(),
              .volume = face_volume[d].data(),
              .p = state.pressure.data(),
              .per_gap = per_gap[d].data(),
              .drag = sources.drag_coefficient.data(),
              .carried = sources.drag_momentum[d].data(),
              .force = sources.force[d].data(),
              .below = weights.upper[d].data(),
              .above = weights.lower[d].data(),
              .source = sources.mass.data(),
              .friction = friction[d].data(),
              .dragged = dragged[d].data(),
              .viscous = viscous.data(),
              .u = before_step.data(),
              .temperature = state.temperature.data(),
              .flux = pointers(link_flux),
              .coupled = pointers(coupled[d]),
              .reach = pointers(reach[d]),
              .velocity = pointers(begun),
              .area = pointers(area),
              .mobility = mobility[d].data(),
              .inverse = rows.inverse.data(),
              .right = rows.right.data(),
              .stress = stress[d].data(),
              .coupling = {},
              .x = x.data(),
              .added = pointers(limit.added),
              .exact = rows.partial.data()};
    for (std::size_t m = 0; m < 6; ++m) loop.coupling[m] = rows.coupling[m].data();
    constexpr std::array assemble{assemble_x, assemble_y, assemble_z};
    for (auto const& run : faces[d]) assemble[d](loop, run.first, run.end);
    // What an inlet brings along a face has no velocity along it.
    for (auto const& edge : inlet_edges[d]) {
        auto const& flux = middle_flux[edge.e];
        double const enters = positive(edge.sign * 0.5 * (flux[edge.first] + flux[edge.second]));
        mobility[d][edge.face] += enters;
        rows.inverse[edge.face] = 1 / (1 / rows.inverse[edge.face] + enters);
    }
    make_end_rows(d, state, dt);
    sweep(rows, faces[d], x, sweep_tolerance, most_sweeps);

    limit.clear();
    if (settings.second_order) {
        std::array<Field const*, 3> share{&low_share[0], &low_share[1], &low_share[2]};
        share[d] = &half;  // a cell's centre lies in the middle of its faces
        sharpen(
            faces[d],
            {{&link_flux[0], &link_flux[1], &link_flux[2]}, {&coupled[d][0], &coupled[d][1], &coupled[d][2]}, share}, x,
            before_step);
        limit.scale(grid, faces[d], x, before_step, mobility[d], {&coupled[d][0], &coupled[d][1], &coupled[d][2]},
                    {&coupled[d][0], &coupled[d][1], &coupled[d][2]}, -endless, endless);
    }
    // Convection is known now; viscosity is taken at what comes of it.
    constexpr std::array convect{convect_x, convect_y, convect_z}, pass{pass_x, pass_y, pass_z};
    for (auto const& run : faces[d]) convect[d](loop, run.first, run.end);
    for (auto& end : rows.ends) {
        end.right += end.convected * (x[end.inner] - x[end.face]);
        end.coupling -= end.convected;
    }
    sweep(rows, faces[d], x, sweep_tolerance, most_sweeps);
    for (auto const& run : faces[d]) pass[d](loop, run.first, run.end);
    for (auto& end : rows.ends) end.right = (end.right + end.coupling * (x[end.inner] - x[end.face])) / end.mobility;
    for (auto const& run : faces[d])
        for (Index q = run.first; q < run.end; ++q) x[q] = rows.partial[q];
    for (auto const& end : rows.ends) x[end.face] = end.right;
    refresh({&x});
}

void Solver::Inside::make_end_rows(std::size_t d, State const& state, double dt)
{
    rows.ends.clear();
    // Mean velocity into each outlet's filter, which evens it out.
    std::vector<double> through(outlet_areas.size(), 0.0);
    bool any = false;
    for (auto const& outlet : settings.outlets) any = any || outlet.at.direction == d;
    if (!any) return;
    for (auto const& face : outlets)
        if (face.d == d) through[face.number] += begun[d][face.face] * face.area;
    comm.sum(through);
    for (auto const& face : outlets) {
        if (face.d != d) continue;
        auto const& outlet = settings.outlets[face.number];
        Index const q = face.face, c = face.inside, inner = face.upper ? c : next(c, d);
        double const volume = 0.5 * grid.open_volume[c], gas = 0.5 * gas_volume[c], eps = gas / volume;
        double const inertia_here = 0.5 * inertia[c] / dt, filter = outlet.resistance * face.area;
        double const slope = (face.upper ? 1 : -1) * (outlet.pressure - state.pressure[c]) / face.half;
        double const reach_in = reach[d][d][face.upper ? q : inner] * viscous[c] * eps;
        double const from_inside = (face.upper ? 1 : -1) * 0.5 * (middle_flux[d][q] + middle_flux[d][inner]);
        bool const b = settings.model == Model::b;
        double const weight = 0.5 * state.mass[c] * settings.gravity[d] * (b ? 1 / eps : 1.0);
        mobility[d][q] = inertia_here + filter;
        rows.ends.push_back({q, inner, mobility[d][q], positive(from_inside) + reach_in, positive(from_inside),
                             inertia_here * begun[d][q] + filter * through[face.number] / outlet_areas[face.number] +
                                 weight - (b ? volume : gas) * slope});
    }
}
}
