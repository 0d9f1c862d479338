// The projection: mass fluxes that bring every cell to the mass its equation of state asks for.
//
// Pressure correction q on cells, velocity correction on faces with the same implicit drag in the denominator as in the
// predictor, so that the momentum balance holds with the drag at the final velocity.
#include "granum/base/error.hpp"
#include "granum/gas/inside.hpp"

#include <cmath>

namespace granum::gas
{
solve::Outcome Solver::Inside::project(State& state, SharedSources const& sources, Field const& voidage, double dt)
{
    auto& u = state.velocity;
    auto& flux = state.mass_flux;
    set_plate_velocity(state, voidage);

    std::fill(system.extra.begin(), system.extra.end(), 0.0);
    for (std::size_t d = 0; d < 3; ++d) {
        std::fill(system.link[d].begin(), system.link[d].end(), 0.0);
        for (FaceRow const& face : faces[d]) {
            Index const q = face.face;
            double const per_speed = face_mass(face, d, state.mass) / face_volume[d][q] * area[d][q];
            double const gas = face_gas_volume(face, d, voidage);
            flux[d][q] = per_speed * u[d][q];
            double const width = face.outlet ? 0.5 * grid.spacing[d] : grid.spacing[d];
            double const link = per_speed * gas / (width * mobility[d][q]);
            if (face.outlet)
                system.extra[before(q, d)] = link;
            else
                system.link[d][q] = link;
        }
    }
    refresh({&system.link[0], &system.link[1], &system.link[2], &flux[0], &flux[1], &flux[2]});

    // A box without outlet keeps its gas: its pressure follows from how much there is.
    double static_pressure = settings.pressure;
    if (!top && !settings.density) {
        std::array<double, 2> sums{};
        grid::for_each_cell(grid, [&](int, int, int, Index c) {
            if (!grid.open(c)) return;
            sums[0] += state.mass[c] + dt * sources.mass[c];
            sums[1] += voidage[c] * grid.open_volume[c] *
                       equation_of_state(1.0, state.temperature[c], state.vapour_fraction[c]);
        });
        comm.sum(sums);
        static_pressure = sums[0] / sums[1];
    }

    auto outflow = [&](Index c) {
        double sum = 0;
        for (std::size_t d = 0; d < 3; ++d) sum += flux[d][next(c, d)] - flux[d][c];
        return sum;
    };
    double scale = 0;
    grid::for_each_cell(grid, [&](int, int, int, Index c) {
        system.right[c] = 0;
        if (!grid.open(c)) return;
        double const goal = voidage[c] * grid.open_volume[c] *
                            equation_of_state(static_pressure, state.temperature[c], state.vapour_fraction[c]);
        system.right[c] = sources.mass[c] - (goal - state.mass[c]) / dt - outflow(c);
        scale += goal * goal;
    });
    // A flux error that moves a cell's mass by less than this fraction is corrected in the next step anyway.
    double const floor = 0.01 * settings.tolerance * std::sqrt(comm.sum(scale)) / dt;
    auto const outcome = pressure.solve(system, correction, settings.tolerance, floor);
    if (!std::isfinite(outcome.residual)) check(state);  // names what is not finite on the rank that has it
    base::require(std::isfinite(outcome.residual), "gas: the pressure equation has a residual that is not finite");

    for (std::size_t d = 0; d < 3; ++d)
        for (FaceRow const& face : faces[d]) {
            Index const q = face.face;
            double const per_speed = face_mass(face, d, state.mass) / face_volume[d][q] * area[d][q];
            u[d][q] -= face_gas_volume(face, d, voidage) * pressure_slope(face, d, correction) / mobility[d][q];
            flux[d][q] = per_speed * u[d][q];
        }
    refresh({&u[0], &u[1], &u[2], &flux[0], &flux[1], &flux[2]});
    grid::for_each_cell(grid, [&](int, int, int, Index c) {
        if (!grid.open(c)) return;
        state.pressure[c] += correction[c];
        state.mass[c] += dt * (sources.mass[c] - outflow(c));
    });
    refresh({&state.pressure, &state.mass});
    return outcome;
}
}
