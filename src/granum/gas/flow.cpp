#include "granum/gas/flow.hpp"

#include "granum/base/error.hpp"
#include "granum/gas/inside.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::gas
{
namespace
{
constexpr double bearable_mismatch = 0.05;  // of a cell's mass against its equation of state
constexpr int most_trials = 4;
}

std::vector<std::pair<std::string, Field*>> State::fields()
{
    std::vector<std::pair<std::string, Field*>> out{{"mass", &mass},
                                                    {"vapour", &vapour},
                                                    {"tracer", &tracer},
                                                    {"enthalpy", &enthalpy},
                                                    {"velocity_x", &velocity[0]},
                                                    {"velocity_y", &velocity[1]},
                                                    {"velocity_z", &velocity[2]},
                                                    {"mass_flux_x", &mass_flux[0]},
                                                    {"mass_flux_y", &mass_flux[1]},
                                                    {"mass_flux_z", &mass_flux[2]},
                                                    {"earlier_flux_x", &earlier_flux[0]},
                                                    {"earlier_flux_y", &earlier_flux[1]},
                                                    {"earlier_flux_z", &earlier_flux[2]},
                                                    {"pressure", &pressure},
                                                    {"voidage", &voidage},
                                                    {"temperature", &temperature},
                                                    {"vapour_fraction", &vapour_fraction},
                                                    {"tracer_fraction", &tracer_fraction},
                                                    {"density", &density}};
    if (turbulent) {
        out.emplace_back("energy_of_eddies", &energy_of_eddies);
        out.emplace_back("rate_of_eddies", &rate_of_eddies);
    }
    return out;
}

void Sources::clear(grid::Grid const& grid)
{
    for (Field* field :
         {&drag_coefficient, &drag_momentum[0], &drag_momentum[1], &drag_momentum[2], &force[0], &force[1], &force[2],
          &couple[0], &couple[1], &couple[2], &mass, &vapour, &enthalpy, &heat_coefficient, &heat_value})
        field->assign(grid.size(), 0.0);
}

Solver::Solver(Settings settings, grid::Grid const& grid, par::Communicator const& comm)
    : inside_(std::make_unique<Inside>(std::move(settings), grid, comm))
{
}
Solver::~Solver() = default;

FaceWeights const& Solver::weights() const
{
    return inside_->weights;
}
Settings const& Solver::settings() const
{
    return inside_->settings;
}
Inlet& Solver::inlet(std::size_t number)
{
    return inside_->settings.inlets.at(number);
}
Field const& Solver::exchanged_temperature() const
{
    return inside_->exchanged;
}

Field const& Solver::correction() const
{
    return inside_->correction;
}
solve::Pressure::Memory const& Solver::pressure_memory() const
{
    return inside_->pressure.memory();
}
void Solver::recall(Field correction, std::optional<solve::Pressure::Memory> memory)
{
    inside_->correction = std::move(correction);
    if (memory) inside_->pressure.recall(std::move(*memory));
}

State Solver::start(Field const& voidage, Field const& temperature, double vapour_fraction, Vec3 velocity) const
{
    Inside const& in = *inside_;
    grid::Grid const& grid = in.grid;
    State state{.mass = grid.make_field(),
                .vapour = grid.make_field(),
                .tracer = grid.make_field(),
                .enthalpy = grid.make_field(),
                .velocity = grid.make_face_field(),
                .mass_flux = grid.make_face_field(),
                .earlier_flux = grid.make_face_field(),
                .pressure = grid.make_field(),
                .static_pressure = in.settings.pressure,
                .voidage = voidage,
                .temperature = temperature,
                .vapour_fraction = grid.make_field(vapour_fraction),
                .tracer_fraction = grid.make_field(),
                .density = grid.make_field(),
                .vapour_fractions = {vapour_fraction, vapour_fraction}};
    in.refresh({&state.voidage, &state.temperature});
    double coldest = std::numeric_limits<double>::max(), hottest = 0;
    for (Index c = 0; c < state.density.size(); ++c)
        state.density[c] = in.equation_of_state(in.settings.pressure, state.temperature[c], vapour_fraction, 0);
    // Pressures count from the upper end of the domain, or from that at which an outlet lies.
    Vec3 zero;
    for (std::size_t d = 0; d < 3; ++d) zero[d] = grid.lines[d].back();
    if (!in.settings.outlets.empty()) {
        auto const& at = in.settings.outlets.front().at;
        if (!at.upper) zero[at.direction] = grid.lines[at.direction].front();
    }
    grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
        if (!grid.open(c)) return;
        base::require(voidage[c] > 0 && voidage[c] <= 1, "gas: the voidage at the start is {} in cell ({}, {}, {})",
                      voidage[c], i + grid.shift[0], j + grid.shift[1], k + grid.shift[2]);
        double const density = state.density[c];
        coldest = std::min(coldest, temperature[c]), hottest = std::max(hottest, temperature[c]);
        Vec3 const x = grid.centre(i, j, k);
        for (std::size_t d = 0; d < 3; ++d)
            if (!grid.periodic[d]) state.pressure[c] += density * in.settings.gravity[d] * (x[d] - zero[d]);
        state.mass[c] = voidage[c] * grid.open_volume[c] * density;
        if (in.settings.compressibility == Compressibility::full)
            state.mass[c] *= 1 + state.pressure[c] / in.settings.pressure;
        state.vapour[c] = vapour_fraction * state.mass[c];
        state.enthalpy[c] = material::enthalpy(temperature[c], vapour_fraction) * state.mass[c];
    });
    state.temperatures = {in.comm.min(coldest), in.comm.max(hottest)};
    in.refresh({&state.mass, &state.vapour, &state.enthalpy, &state.pressure});
    for (std::size_t d = 0; d < 3; ++d) {
        for (auto const& run : in.faces[d])
            for (Index q = run.first; q < run.end; ++q) {
                double const mass = 0.5 * (state.mass[q] + state.mass[in.before(q, d)]);
                state.velocity[d][q] = velocity[d];
                state.mass_flux[d][q] = mass / in.face_volume[d][q] * in.area[d][q] * velocity[d];
            }
        for (auto const& face : in.outlets) {
            if (face.d != d) continue;
            state.velocity[d][face.face] = velocity[d];
            state.mass_flux[d][face.face] =
                state.mass[face.inside] / grid.open_volume[face.inside] * face.area * velocity[d];
        }
    }
    in.set_inlet_velocities(state);
    for (std::size_t d = 0; d < 3; ++d) in.refresh({&state.velocity[d], &state.mass_flux[d]});
    state.earlier_flux = state.mass_flux;
    if (in.closure) in.start_eddies(state);
    return state;
}

Balance Solver::advance(State& state, Sources const& sources, Field const& voidage, double dt)
{
    Inside& in = *inside_;
    base::require(dt > 0, "gas: the step is {} s", dt);
    in.check(sources);
    Balance balance;
    state.voidage = voidage;
    in.refresh({&state.voidage});
    for (Index c = 0; c < in.gas_volume.size(); ++c) in.gas_volume[c] = state.voidage[c] * in.grid.open_volume[c];
    in.static_before = state.static_pressure;
    in.sweeps = 0;
    SharedSources const shared = in.share(sources);
    if (in.closure) in.closure->mass_before = state.mass;
    in.predict(state, shared, dt);
    in.expected_temperature = state.temperature;
    in.expected_vapour = state.vapour_fraction;
    in.expected_tracer = state.tracer_fraction;
    // Gas of another density that enters a cell changes the mass that belongs into it: where that is much in a step,
    // the step is done again with what came of it.
    bool const may_repeat = in.settings.compressibility != Compressibility::constant;
    std::optional<State> const predicted = may_repeat ? std::optional(state) : std::nullopt;
    Balance total;
    for (int trial = 0;; ++trial) {
        balance = {};
        auto const pressure = in.project(state, shared, dt, balance);
        total.pressure_iterations += pressure.iterations;
        total.pressure_converged = total.pressure_converged && pressure.converged;
        in.carry_scalars(state, sources, dt, balance);
        in.derive(state);
        if (!may_repeat || trial == most_trials || in.off_state(state) < bearable_mismatch) break;
        in.expected_temperature = state.temperature;
        in.expected_vapour = state.vapour_fraction;
        in.expected_tracer = state.tracer_fraction;
        state = *predicted;
    }
    balance.pressure_iterations = total.pressure_iterations;
    balance.pressure_converged = total.pressure_converged;
    if (state.turbulent) in.carry_eddies(state, sources, dt);
    balance.sweeps = in.sweeps;
    in.refresh({&state.vapour, &state.tracer, &state.enthalpy, &state.temperature, &state.vapour_fraction,
                &state.tracer_fraction, &state.density});
    in.check(state);
    return balance;
}

double Solver::courant_step(State const& state, double courant) const
{
    Inside const& in = *inside_;
    double rate = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        if (in.repeats_itself(d)) continue;
        for (auto const& run : in.faces[d])
            for (Index q = run.first; q < run.end; ++q)
                rate = std::max(rate, std::abs(state.velocity[d][q]) * in.per_gap[d][q]);
    }
    rate = in.comm.max(rate);
    return rate > 0 ? courant / rate : std::numeric_limits<double>::infinity();
}

Vec3 Solver::momentum(State const& state) const
{
    Inside const& in = *inside_;
    Field const& mass = in.stepped ? in.inertia : state.mass;
    std::array<double, 3> sums{};
    for (std::size_t d = 0; d < 3; ++d)
        for (auto const& run : in.faces[d])
            for (Index q = run.first; q < run.end; ++q)
                sums[d] += 0.5 * (mass[q] + mass[in.before(q, d)]) * state.velocity[d][q];
    in.comm.sum(sums);
    return {sums[0], sums[1], sums[2]};
}
}
