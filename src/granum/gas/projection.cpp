// The projection: mass fluxes that bring every cell to the mass its equation of state asks for.
//
// Pressure correction q on cells, velocity correction on faces with the same implicit drag and friction in the
// denominator as in the predictor, so that the momentum balance holds with them at the final velocity.
#include "granum/base/error.hpp"
#include "granum/base/vectorised.hpp"
#include "granum/gas/inside.hpp"

#include <cmath>

namespace granum::gas
{
namespace
{
//! Mass flux per velocity of the faces of a run, and what a pressure difference of 1 Pa between the cells does to the
//! flux.
GRANUM_VECTORISED void open_links(Index first, Index end, std::ptrdiff_t sd, double const* __restrict mass,
                                  double const* __restrict under_pressure, double const* __restrict volume,
                                  double const* __restrict area, double const* __restrict per_gap,
                                  double const* __restrict mobility, double const* __restrict u,
                                  double* __restrict flux, double* __restrict link)
{
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        Index const low = q - static_cast<Index>(sd);
        double const per_speed = 0.5 * (mass[low] + mass[q]) / volume[q] * area[q];
        double const pushed = 0.5 * (under_pressure[low] + under_pressure[q]);
        flux[q] = per_speed * u[q];
        link[q] = per_speed * pushed * per_gap[q] / mobility[q];
    }
}

GRANUM_VECTORISED void correct(Index first, Index end, std::ptrdiff_t sd, double const* __restrict mass,
                               double const* __restrict under_pressure, double const* __restrict volume,
                               double const* __restrict area, double const* __restrict per_gap,
                               double const* __restrict mobility, double const* __restrict correction,
                               double* __restrict u, double* __restrict flux)
{
#pragma GCC ivdep
    for (Index q = first; q < end; ++q) {
        Index const low = q - static_cast<Index>(sd);
        double const per_speed = 0.5 * (mass[low] + mass[q]) / volume[q] * area[q];
        double const pushed = 0.5 * (under_pressure[low] + under_pressure[q]);
        u[q] -= pushed * per_gap[q] / mobility[q] * (correction[q] - correction[low]);
        flux[q] = per_speed * u[q];
    }
}
}

solve::Outcome Solver::Inside::project(State& state, SharedSources const& sources, double dt, Balance& balance)
{
    auto& u = state.velocity;
    auto& flux = state.mass_flux;
    state.earlier_flux = flux;
    set_inlet_velocities(state);
    Field const& under_pressure = settings.model == Model::b ? grid.open_volume : gas_volume;

    std::fill(system.extra.begin(), system.extra.end(), 0.0);
    for (std::size_t d = 0; d < 3; ++d) {
        std::fill(system.link[d].begin(), system.link[d].end(), 0.0);
        for (auto const& run : faces[d])
            open_links(run.first, run.end, grid.strides[d], state.mass.data(), under_pressure.data(),
                       face_volume[d].data(), area[d].data(), per_gap[d].data(), mobility[d].data(), u[d].data(),
                       flux[d].data(), system.link[d].data());
    }
    auto const per_speed_out = [&](OpenFace const& face) {
        return state.mass[face.inside] / grid.open_volume[face.inside] * face.area;
    };
    for (auto const& face : outlets) {
        double const per_speed = per_speed_out(face);
        flux[face.d][face.face] = per_speed * u[face.d][face.face];
        system.extra[face.inside] +=
            per_speed * 0.5 * under_pressure[face.inside] / (face.half * mobility[face.d][face.face]);
    }
    refresh({&system.link[0], &system.link[1], &system.link[2], &flux[0], &flux[1], &flux[2]});

    // A low-Mach box without outlet keeps its gas: its pressure follows from how much there is.
    auto const state_of = [&](Index c, double at_pressure) {
        return equation_of_state(at_pressure, expected_temperature[c], expected_vapour[c], expected_tracer[c]);
    };
    if (settings.compressibility == Compressibility::low_mach && outlet_areas.empty()) {
        std::array<double, 3> sums{};
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) {
                sums[0] += state.mass[c] + dt * sources.mass[c];
                sums[1] += gas_volume[c] * state_of(c, 1.0);
                sums[2] += gas_volume[c];
            }
        for (auto const& face : inlets) sums[0] += dt * settings.inlets[face.number].mass_flow * face.share;
        comm.sum(sums);
        double const now = sums[0] / sums[1];
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c)
                balance.pressure_work += gas_volume[c] * (now - state.static_pressure);
        state.static_pressure = now;
    }

    auto outflow = [&](Index c) {
        double sum = 0;
        for (std::size_t d = 0; d < 3; ++d) sum += flux[d][next(c, d)] - flux[d][c];
        return sum;
    };
    std::fill(system.right.begin(), system.right.end(), 0.0);
    bool const full = settings.compressibility == Compressibility::full;
    double scale = 0;
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c) {
            double goal = gas_volume[c];
            if (full) {
                double const yields = gas_volume[c] * state_of(c, 1.0);
                system.extra[c] += yields / dt;
                goal = yields * (settings.pressure + state.pressure[c]);
            } else {
                goal *= state_of(c, state.static_pressure);
            }
            system.right[c] = sources.mass[c] - (goal - state.mass[c]) / dt - outflow(c);
            scale += goal * goal;
        }
    // A flux error that moves a cell's mass by less than this fraction is corrected in the next step anyway.
    double const floor = 0.01 * settings.tolerance * std::sqrt(comm.sum(scale)) / dt;
    auto const outcome = pressure.solve(system, correction, settings.tolerance, floor);
    if (!std::isfinite(outcome.residual)) check(state);  // names what is not finite on the rank that has it
    base::require(std::isfinite(outcome.residual), "gas: the pressure equation has a residual that is not finite");

    for (std::size_t d = 0; d < 3; ++d)
        for (auto const& run : faces[d])
            correct(run.first, run.end, grid.strides[d], state.mass.data(), under_pressure.data(),
                    face_volume[d].data(), area[d].data(), per_gap[d].data(), mobility[d].data(), correction.data(),
                    u[d].data(), flux[d].data());
    for (auto const& face : outlets) {
        auto& speed = u[face.d][face.face];
        double const pushed = 0.5 * under_pressure[face.inside] / (face.half * mobility[face.d][face.face]);
        speed += (face.upper ? 1 : -1) * pushed * correction[face.inside];
        flux[face.d][face.face] = per_speed_out(face) * speed;
    }
    refresh({&u[0], &u[1], &u[2], &flux[0], &flux[1], &flux[2]});
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c) {
            state.pressure[c] += correction[c];
            state.mass[c] += dt * (sources.mass[c] - outflow(c));
            if (full) balance.pressure_work += gas_volume[c] * correction[c];
        }
    refresh({&state.pressure, &state.mass});
    // What walls hold belongs to the stress, at the final velocity.
    for (std::size_t d = 0; d < 3; ++d)
        for (auto const& run : faces[d])
            for (Index q = run.first; q < run.end; ++q) {
                Index const low = before(q, d);
                double const held = 0.5 * (friction[d][low] + friction[d][q]) * u[d][q];
                stress[d][q] = (stress[d][q] + 0.5 * (dragged[d][low] + dragged[d][q]) - held) / face_volume[d][q];
            }
    state.last_step = dt;
    return outcome;
}
}
