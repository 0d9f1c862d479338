// Transport of turbulence: k and its rate, carried by the fluxes of the step as the other scalars are, with the voidage
// in storage, flux and diffusion.
//
// Sinks are implicit and sources explicit, so that implicit upwind convection keeps both positive at any step; a floor
// takes up rounding. First the rate is moved on, with the k of the beginning, then k with the rate that came of it. In
// cells at walls the rate is that of the wall law.
#include "granum/gas/inside.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace turbulence = law::turbulence;

namespace
{
constexpr double quiet = 1e-4;          // k where nothing else is said, m2/s2
constexpr double least_energy = 1e-14;  // m2/s2
constexpr double least_rate = 1e-14;    // of epsilon or omega
constexpr double largest_ratio = 1e5;   // of eddy viscosity to viscosity
constexpr double of_diameter = 0.07;    // length of eddies
constexpr double endless = 1e300;
constexpr double holds_fixed = 1e9;  // of a sink that fixes a value, over what the cell takes up in a step

//! Calls visit(model) with the two-equation model that is held.
template <class Visit>
void with_transport(turbulence::Any const& any, Visit&& visit)
{
    std::visit(
        [&](auto const& model) {
            if constexpr (std::decay_t<decltype(model)>::transports) visit(model);
        },
        any);
}
}

double Solver::Inside::inlet_energy(State const& state, std::size_t number) const
{
    auto const& inlet = settings.inlets[number];
    double const density =
        equation_of_state(state.static_pressure, inlet.temperature, inlet.vapour_fraction, inlet.tracer_fraction);
    double const swing = inlet.turbulence_intensity * inlet.mass_flow / (density * inlet_areas[number]);
    return std::max(1.5 * swing * swing, least_energy);
}

double Solver::Inside::inlet_length(std::size_t number) const
{
    double const diameter = std::sqrt(4 / math::pi * inlet_areas[number]);
    return settings.inlets[number].turbulence_length.value_or(of_diameter * diameter);
}

void Solver::Inside::start_eddies(State& state) const
{
    auto const& set = settings.turbulence;
    if (!turbulence::transports(set.model)) return;
    state.turbulent = true;
    double energy = 0, length = 0;
    for (std::size_t n = 0; n < settings.inlets.size(); ++n)
        if (double const k = inlet_energy(state, n); k > energy) energy = k, length = inlet_length(n);
    if (energy <= least_energy) {
        energy = quiet, length = endless;
        for (std::size_t d = 0; d < 3; ++d)
            if (!repeats_itself(d))
                length = std::min(length, of_diameter * (grid.lines[d].back() - grid.lines[d].front()));
        if (length == endless) length = of_diameter * (grid.lines[0].back() - grid.lines[0].front());
    }
    energy = set.energy.value_or(energy), length = set.length.value_or(length);
    state.energy_of_eddies = grid.make_field(energy);
    state.rate_of_eddies = grid.make_field();
    with_transport(set.model, [&](auto const& model) {
        state.rate_of_eddies = grid.make_field(std::max(model.rate_of(energy, length), least_rate));
    });
}

// Drag on the slip makes wakes, and granules that lag behind the eddies damp them. The drag of the cell is the
// effective one of a step: what a granule takes up meanwhile is set back for the time of relaxation.
void Solver::Inside::add_granules(State const& state, Sources const& sources, double dt)
{
    auto const& granules = settings.turbulence.granules;
    Closure& it = *closure;
    auto const mean = mean_velocity(state);
    with_transport(settings.turbulence.model, [&](auto const& model) {
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) {
                double const effective = sources.drag_coefficient[c];
                if (effective <= 0) continue;
                double const solids = granules.solids_density * (grid.open_volume[c] - gas_volume[c]);
                double const relaxation = std::max(solids / effective - dt, 0.0);
                double const drag = relaxation > 0 ? solids / relaxation : effective;
                double slip2 = 0;
                for (std::size_t d = 0; d < 3; ++d) {
                    double const slip = mean[d][c] - sources.drag_momentum[d][c] / effective;
                    slip2 += slip * slip;
                }
                double const k = state.energy_of_eddies[c], rate = state.rate_of_eddies[c], mass = state.mass[c];
                double const per_time = model.decay(k, rate);
                double const lagrangian = per_time > 0 ? granules.lagrangian / per_time : endless;
                double const made = granules.wake * drag * slip2 / mass;
                double const lost = 2 * drag / mass * (relaxation / (lagrangian + relaxation));
                it.made[c] += made;
                it.granular[c] = lost;
                // Over the energy with what comes in the step: that at its beginning may be next to nothing.
                double const gain = model.rate_with(made - lost * k, k + dt * made, rate, granules.rate);
                (gain > 0 ? it.rate_made[c] : it.rate_lost[c]) += gain > 0 ? gain : -gain / rate;
            }
    });
}

void Solver::Inside::carry_eddies(State& state, Sources const& sources, double dt)
{
    Closure& it = *closure;
    auto const& set = settings.turbulence;
    Carried& flow = carried;
    Field property = grid.make_field();
    auto const diffuse = [&](Field const& spread) {
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c)
                property[c] = gas_volume[c] / grid.open_volume[c] * (it.molecular[c] + spread[c] * it.eddy[c]);
        refresh({&property});
        conduct(property);
    };
    std::vector<double> energies, lengths;
    for (std::size_t n = 0; n < settings.inlets.size(); ++n) {
        energies.push_back(inlet_energy(state, n));
        lengths.push_back(inlet_length(n));
    }
    std::fill(it.granular.begin(), it.granular.end(), 0.0);
    if (set.granules.on) add_granules(state, sources, dt);
    Field& k = state.energy_of_eddies;
    Field& rate = state.rate_of_eddies;
    flow.capacity = state.mass;
    flow.flux = state.mass_flux;
    auto const begin = [&](Field const& x, Field const& made, Field const& lost) {
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) {
                flow.content[c] = it.mass_before[c] * x[c];
                flow.source[c] = state.mass[c] * made[c];
                flow.sink[c] = state.mass[c] * lost[c];
            }
    };
    with_transport(set.model, [&](auto const& model) {
        // What is drawn in through an outlet is quiet.
        double const rate_outside = std::max(model.rate_of(quiet, inlet_areas.empty() ? 0.01 : lengths[0]), least_rate);
        begin(rate, it.rate_made, it.rate_lost);
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c)
                if (it.fixed_rate[c] >= 0) {
                    flow.sink[c] = holds_fixed * state.mass[c] / dt;
                    flow.source[c] = flow.sink[c] * it.fixed_rate[c];
                }
        flow.at_inlets.clear(), flow.at_outlets.assign(settings.outlets.size(), rate_outside);
        for (std::size_t n = 0; n < energies.size(); ++n)
            flow.at_inlets.push_back(model.rate_of(energies[n], lengths[n]));
        diffuse(it.spread_rate);
        Range any{0, endless};
        carry(flow, rate, any, dt);
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) {
                rate[c] = it.fixed_rate[c] >= 0 ? it.fixed_rate[c] : flow.content[c] / state.mass[c];
                rate[c] = std::max(rate[c], least_rate);
                it.lost[c] = it.granular[c] + model.decay(k[c], rate[c]);
            }

        begin(k, it.made, it.lost);
        flow.at_inlets = energies, flow.at_outlets.assign(settings.outlets.size(), quiet);
        diffuse(it.spread_energy);
        any = {0, endless};
        carry(flow, k, any, dt);
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) {
                k[c] = std::max(flow.content[c] / state.mass[c], least_energy);
                double const largest = largest_ratio * it.molecular[c] / state.density[c];
                rate[c] = std::max(rate[c], model.least_rate(k[c], largest));
            }
    });
    refresh({&k, &rate});
}

Eddies Solver::eddies(State const& state) const
{
    Inside const& in = *inside_;
    base::require(state.turbulent, "gas: the model of turbulence has no k");
    Eddies out{state.energy_of_eddies,
               state.rate_of_eddies,
               {in.grid.make_field(), in.grid.make_field(), in.grid.make_field()}};
    with_transport(in.settings.turbulence.model, [&](auto const& model) {
        for (Index c = 0; c < out.energy.size(); ++c)
            out.dissipation[c] = model.dissipation(out.energy[c], state.rate_of_eddies[c]);
    });
    grid::for_each_cell(in.grid, [&](int i, int j, int k, Index c) {
        if (!in.grid.open(c)) return;
        std::array<int, 3> const cell{i, j, k};
        for (std::size_t e = 0; e < 3; ++e)
            out.gradient[e][c] = in.slope_of(state.energy_of_eddies, e, c, in.grid.axes[e].width(cell[e]));
    });
    in.refresh({&out.gradient[0], &out.gradient[1], &out.gradient[2]});
    return out;
}
}
