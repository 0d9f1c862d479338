#include "granum/gas/flow.hpp"

#include "granum/base/error.hpp"
#include "granum/gas/inside.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::gas
{
void Sources::clear(grid::Grid const& grid)
{
    for (Field* field : {&drag_coefficient, &drag_momentum[0], &drag_momentum[1], &drag_momentum[2], &force[0],
                         &force[1], &force[2], &mass, &vapour, &enthalpy, &heat_coefficient, &heat_value})
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

State Solver::start(Field const& voidage, double temperature, double vapour_fraction, Vec3 velocity) const
{
    Inside const& in = *inside_;
    grid::Grid const& grid = in.grid;
    double const density = in.equation_of_state(in.settings.pressure, temperature, vapour_fraction);
    State state{.mass = grid.make_field(),
                .vapour = grid.make_field(),
                .enthalpy = grid.make_field(),
                .velocity = grid.make_face_field(),
                .mass_flux = grid.make_face_field(),
                .pressure = grid.make_field(),
                .voidage = voidage,
                .temperature = grid.make_field(temperature),
                .vapour_fraction = grid.make_field(vapour_fraction),
                .density = grid.make_field(density)};
    in.refresh({&state.voidage});
    grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
        if (!grid.open(c)) return;
        base::require(voidage[c] > 0 && voidage[c] <= 1, "gas: the voidage at the start is {} in cell ({}, {}, {})",
                      voidage[c], i + grid.shift, j, k);
        state.mass[c] = voidage[c] * grid.open_volume[c] * density;
        state.vapour[c] = vapour_fraction * state.mass[c];
        state.enthalpy[c] = material::enthalpy(temperature, vapour_fraction) * state.mass[c];
        Vec3 const x = grid.centre(i, j, k);
        for (std::size_t d = 0; d < 3; ++d)
            if (!grid.periodic[d])
                state.pressure[c] +=
                    density * in.settings.gravity[d] * (x[d] - grid.origin[d] - grid.global[d] * grid.spacing[d]);
    });
    in.refresh({&state.mass, &state.vapour, &state.enthalpy, &state.pressure});
    for (std::size_t d = 0; d < 3; ++d)
        for (FaceRow const& face : in.faces[d]) {
            Index const q = face.face;
            state.velocity[d][q] = velocity[d];
            state.mass_flux[d][q] =
                in.face_mass(face, d, state.mass) / in.face_volume[d][q] * in.area[d][q] * velocity[d];
        }
    in.set_plate_velocity(state, state.voidage);
    for (std::size_t d = 0; d < 3; ++d) in.refresh({&state.velocity[d], &state.mass_flux[d]});
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
    SharedSources const shared = in.share(sources);
    in.predict(state, shared, state.voidage, dt);
    auto const pressure = in.project(state, shared, state.voidage, dt);
    balance.pressure_iterations = pressure.iterations;
    balance.pressure_converged = pressure.converged;
    in.carry_vapour_and_heat(state, sources, dt, balance);
    in.derive(state);
    in.refresh({&state.vapour, &state.enthalpy, &state.temperature, &state.vapour_fraction, &state.density});
    in.check(state);
    return balance;
}

double Solver::courant_step(State const& state, double courant) const
{
    Inside const& in = *inside_;
    double rate = 0;
    for (std::size_t d = 0; d < 3; ++d)
        for (FaceRow const& face : in.faces[d])
            rate = std::max(rate, std::abs(state.velocity[d][face.face]) / in.grid.spacing[d]);
    rate = in.comm.max(rate);
    return rate > 0 ? courant / rate : std::numeric_limits<double>::infinity();
}

namespace
{
//! Means of face values by the weights of each cell's two faces.
std::array<Field, 3> cell_means(grid::Grid const& grid, FaceWeights const& weights, FaceField const& values)
{
    std::array<Field, 3> means{grid.make_field(), grid.make_field(), grid.make_field()};
    for (std::size_t d = 0; d < 3; ++d) {
        auto const up = static_cast<Index>(grid.strides()[d]);
        grid::for_each_cell(grid, [&](int, int, int, Index c) {
            means[d][c] = weights.lower[d][c] * values[d][c] + weights.upper[d][c] * values[d][c + up];
        });
    }
    return means;
}
}

std::array<Field, 3> Solver::cell_velocity(State const& state) const
{
    auto means = cell_means(inside_->grid, inside_->weights, state.velocity);
    inside_->refresh({&means[0], &means[1], &means[2]});
    return means;
}

std::array<Field, 3> Solver::cell_pressure_gradient(State const& state) const
{
    Inside const& in = *inside_;
    FaceField slope = in.grid.make_face_field();
    for (std::size_t d = 0; d < 3; ++d) {
        double const* u = state.velocity[d].data();
        for (FaceRow const& face : in.faces[d]) {
            Index const q = face.face, low = in.before(q, d);
            double const mu = face.outlet ? in.viscosity(state.temperature[low])
                                          : in.viscosity(0.5 * (state.temperature[low] + state.temperature[q]));
            auto const reach = in.viscous_reach(face, d);
            double drawn = -in.shear[d][q] * u[q];
            for (std::size_t e = 0; e < 3; ++e) {
                drawn += reach[2 * e] * (u[in.before(q, e)] - u[q]);
                // Above a face of the outlet there is nothing, not even a ghost.
                if (reach[2 * e + 1] != 0) drawn += reach[2 * e + 1] * (u[in.next(q, e)] - u[q]);
            }
            slope[d][q] = in.pressure_slope(face, d, state.pressure) - mu * drawn / in.face_volume[d][q];
        }
    }
    in.refresh({&slope[0], &slope[1], &slope[2]});
    auto means = cell_means(in.grid, in.weights, slope);
    in.refresh({&means[0], &means[1], &means[2]});
    return means;
}

Vec3 Solver::momentum(State const& state) const
{
    Inside const& in = *inside_;
    std::array<double, 3> sums{};
    for (std::size_t d = 0; d < 3; ++d)
        for (FaceRow const& face : in.faces[d])
            sums[d] += in.face_mass(face, d, state.mass) * state.velocity[d][face.face];
    in.comm.sum(sums);
    return {sums[0], sums[1], sums[2]};
}
}
