#include "granum/coupling/exchange.hpp"

#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::coupling
{
namespace air = material;

void Seen::resize(std::size_t rows)
{
    velocity.resize(rows), own_velocity.resize(rows);
    for (auto* column : {&temperature, &vapour_fraction, &density, &solids_fraction, &slip, &reynolds, &sherwood, &drag,
                         &heat, &drag_rate})
        column->resize(rows);
}

Exchange::Exchange(Laws laws, gas::Solver const& solver, Grid const& grid, par::Communicator const& comm,
                   Mapping& mapping, double pressure, double heat_capacity, bool frozen)
    : laws_(std::move(laws)),
      solver_(solver),
      grid_(grid),
      comm_(comm),
      mapping_(mapping),
      pressure_(pressure),
      heat_capacity_(heat_capacity),
      frozen_(frozen)
{
}

double Exchange::heat_capacity(particle::Store const& granules, std::size_t row) const
{
    double const dry = granules.core_mass[row] + granules.layer_mass[row] + granules.solute[row];
    return dry * heat_capacity_ + granules.water[row] * air::heat_capacity_water;
}

Field Exchange::voidage(particle::Store const& granules)
{
    Field solids = grid_.make_field();
    auto const stencils = mapping_.stencils();
    for (std::size_t const row : mapping_.order()) {
        double const d = granules.diameter[row];
        Mapping::spread(stencils[row], granules.count[row] * math::pi / 6 * d * d * d, solids);
    }
    Field* fields[] = {&solids};
    mapping_.finish(fields);
    clamped_ = 0;
    for (Index cell = 0; cell < solids.size(); ++cell) {
        double const open = grid_.open_volume[cell];
        double const voidage = open > 0 ? 1 - solids[cell] / open : 1;
        clamped_ += voidage < 0.35;
        solids[cell] = std::max(voidage, 0.35);
    }
    return solids;
}

void Exchange::share(particle::Store const& granules, gas::State const& state, double dt, Seen& seen,
                     gas::Sources& sources)
{
    auto velocity = solver_.cell_velocity(state);
    Field temperature = state.temperature, vapour = state.vapour_fraction, density = state.density;
    Field voidage = state.voidage;
    Field* gathered[] = {&velocity[0], &velocity[1], &velocity[2], &temperature, &vapour, &density, &voidage};
    mapping_.prepare(gathered);

    auto const& settings = solver_.settings();
    auto const stencils = mapping_.stencils();
    seen.resize(granules.owned);
    for (std::size_t row = 0; row < granules.owned; ++row) {
        Stencil const& stencil = stencils[row];
        seen.velocity[row] = Mapping::gather(stencil, velocity);
        seen.own_velocity[row] = granules.velocity[row];
        seen.temperature[row] = Mapping::gather(stencil, temperature);
        seen.vapour_fraction[row] = Mapping::gather(stencil, vapour);
        seen.density[row] = Mapping::gather(stencil, density);
        seen.solids_fraction[row] = 1 - std::clamp(Mapping::gather(stencil, voidage), 0.35, 1.0);
    }
    std::visit(
        [&](auto const& drag_law) {
            for (std::size_t row = 0; row < granules.owned; ++row) {
                double const eps = 1 - seen.solids_fraction[row];
                double const viscosity =
                    settings.viscosity ? *settings.viscosity : air::viscosity(seen.temperature[row]);
                double const d = granules.diameter[row];
                seen.slip[row] = eps * math::norm(seen.velocity[row] - granules.velocity[row]);
                seen.reynolds[row] = seen.density[row] * seen.slip[row] * d / viscosity;
                double const factor =
                    drag_law({.solid_fraction = seen.solids_fraction[row], .reynolds = seen.reynolds[row]});
                double const beta = granules.count[row] * 3 * math::pi * viscosity * d * eps * factor;
                seen.drag_rate[row] = beta / granules.mass[row];
                seen.drag[row] = frozen_ ? beta : beta / (1 + dt * seen.drag_rate[row]);
            }
        },
        laws_.drag);
    std::visit(
        [&](auto const& heat_law) {
            for (std::size_t row = 0; row < granules.owned; ++row) {
                double const t = seen.temperature[row], w = seen.vapour_fraction[row];
                double const viscosity = settings.viscosity ? *settings.viscosity : air::viscosity(t);
                double const conductivity = settings.conductivity ? *settings.conductivity : air::conductivity(t);
                double const prandtl = viscosity * air::heat_capacity(w) / conductivity;
                double const schmidt = viscosity / (seen.density[row] * air::diffusivity(t, pressure_));
                double const phi = seen.solids_fraction[row], re = seen.reynolds[row];
                double const nusselt = heat_law({.solid_fraction = phi, .reynolds = re, .prandtl = prandtl});
                seen.sherwood[row] = heat_law({.solid_fraction = phi, .reynolds = re, .prandtl = schmidt});
                double const transfer =
                    granules.count[row] * nusselt * conductivity * math::pi * granules.diameter[row];
                seen.heat[row] = transfer / (1 + dt * transfer / heat_capacity(granules, row));
            }
        },
        laws_.heat);

    for (std::size_t const row : mapping_.order()) {
        Stencil const& stencil = stencils[row];
        Vec3 const momentum = seen.drag[row] * granules.velocity[row];
        Vec3 const carried = granules.drag_impulse[row] / -dt;
        double const heat_value = seen.heat[row] * (granules.temperature[row] - math::zero_celsius);
        for (int s = 0; s < 8; ++s) {
            double const w = stencil.weight[static_cast<std::size_t>(s)];
            Index const cell = stencil.cell[static_cast<std::size_t>(s)];
            sources.drag_coefficient[cell] += w * seen.drag[row];
            sources.heat_coefficient[cell] += w * seen.heat[row];
            sources.heat_value[cell] += w * heat_value;
            for (std::size_t d = 0; d < 3; ++d) {
                sources.drag_momentum[d][cell] += w * momentum[d];
                sources.force[d][cell] += w * carried[d];
            }
        }
    }
}

double Exchange::deliver(particle::Store& granules, gas::State const& state, Field const& exchanged_temperature,
                         double dt, Seen const& seen, gas::Sources const& sources)
{
    auto velocity = solver_.cell_velocity(state);
    auto gradient = solver_.cell_pressure_gradient(state);
    // What the gas was told, cell by cell, before smoothing for the gather.
    std::array<double, 7> told{};
    grid::for_each_cell(grid_, [&](int, int, int, Index cell) {
        if (!grid_.open(cell)) return;
        for (std::size_t d = 0; d < 3; ++d) {
            told[d] += sources.drag_momentum[d][cell] - sources.drag_coefficient[cell] * velocity[d][cell];
            told[6] +=
                std::abs(sources.drag_momentum[d][cell]) + std::abs(sources.drag_coefficient[cell] * velocity[d][cell]);
        }
    });
    Field temperature = exchanged_temperature;
    Field* gathered[] = {&velocity[0], &velocity[1], &velocity[2], &gradient[0],
                         &gradient[1], &gradient[2], &temperature};
    mapping_.prepare(gathered);

    auto const stencils = mapping_.stencils();
    for (std::size_t const row : mapping_.order()) {
        Stencil const& stencil = stencils[row];
        Vec3 const u = Mapping::gather(stencil, velocity);
        double const d = granules.diameter[row];
        granules.gas_velocity[row] = u;
        granules.drag_rate[row] = seen.drag_rate[row];
        granules.gas_force[row] = -granules.count[row] * math::pi / 6 * d * d * d * Mapping::gather(stencil, gradient);
        Vec3 const force = seen.drag[row] * (u - seen.own_velocity[row]);
        granules.drag_impulse[row] = -dt * force;  // the engine adds what really happens
        for (std::size_t k = 0; k < 3; ++k) told[3 + k] += force[k];
        granules.enthalpy[row] +=
            dt * seen.heat[row] * (Mapping::gather(stencil, temperature) - granules.temperature[row]);
        granules.temperature[row] = math::zero_celsius + granules.enthalpy[row] / heat_capacity(granules, row);
    }
    comm_.sum(told);
    double mismatch = 0;
    for (std::size_t k = 0; k < 3; ++k) mismatch = std::max(mismatch, std::abs(told[k] + told[3 + k]));
    return told[6] > 0 ? mismatch / told[6] : 0;
}
}
