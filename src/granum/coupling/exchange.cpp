#include "granum/coupling/exchange.hpp"

#include "granum/base/error.hpp"
#include "granum/law/drag/filtered.hpp"
#include "granum/law/drag/fluidisation.hpp"
#include "granum/law/heat/radiation.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::coupling
{
namespace air = material;

namespace
{
constexpr double densest = 0.35;  // voidage of the densest packing of spheres, and a little less
constexpr int spreadings = 8;     // of what is too much for a cell

template <class Any>
bool does_nothing(Any const& law)
{
    return law.index() == 0;  // the first of every list of forces
}

template <class... Columns>
void resize_all(std::size_t rows, Columns&... columns)
{
    (columns.resize(rows), ...);
}
}

Exchange::Exchange(Laws laws, gas::Solver const& solver, Grid const& grid, par::Communicator const& comm,
                   Mapping& mapping, Solids solids, Histories* histories)
    : laws_(std::move(laws)),
      solver_(solver),
      grid_(grid),
      comm_(comm),
      mapping_(mapping),
      solids_(solids),
      model_b_(solver.settings().model == gas::Model::b),
      adds_mass_(!does_nothing(laws_.virtual_mass) || laws_.history),
      turns_(!does_nothing(laws_.torque)),
      lifts_(!does_nothing(laws_.shear_lift) || !does_nothing(laws_.spin_lift)),
      disperses_(!does_nothing(laws_.dispersion)),
      histories_(histories)
{
    base::require(!laws_.history || histories_, "coupling: the history force has no histories");
}

double Exchange::heat_capacity(particle::Store const& granules, std::size_t row) const
{
    double const dry = granules.core_mass[row] + granules.layer_mass[row] + granules.solute[row];
    return dry * solids_.heat_capacity + granules.water[row] * air::heat_capacity_water;
}

double Exchange::viscosity(double temperature) const
{
    auto const& settings = solver_.settings();
    return settings.viscosity ? *settings.viscosity : air::viscosity(temperature);
}

Vec3 Exchange::debt(particle::Store const& granules, std::size_t row) const
{
    Vec3 const kept = granules.drag_impulse[row];
    return adds_mass_ ? kept - granules.added_mass[row] * granules.velocity[row] : kept;
}

Field Exchange::voidage(particle::Store const& granules)
{
    Field solids = grid_.make_field();
    auto const stencils = mapping_.stencils();
    for (std::size_t const row : mapping_.order()) {
        double const d = granules.diameter[row];
        mapping_.spread(stencils[row], granules.count[row] * math::pi / 6 * d * d * d, solids);
    }
    Field* fields[] = {&solids};
    mapping_.finish(fields);

    auto const most = [&](Index cell) { return (1 - densest) * grid_.open_volume[cell]; };
    clamped_ = 0;
    grid::for_each_cell(grid_, [&](int, int, int, Index cell) {
        clamped_ += grid_.open(cell) && solids[cell] > most(cell) * (1 + 1e-12);
    });
    for (int pass = 0; pass < spreadings && comm_.sum(clamped_) > 0; ++pass) {
        // What a cell has too much goes to the cells beside it by the room that they have.
        Field moved = grid_.make_field();
        double left = 0;
        grid::for_each_cell(grid_, [&](int, int, int, Index cell) {
            double const excess = solids[cell] - most(cell);
            if (!grid_.open(cell) || excess <= 0) return;
            std::array<double, 6> room{};
            double rooms = 0;
            for (std::size_t m = 0; m < 6; ++m) {
                std::size_t const d = m / 2;
                Index const beside = m % 2 == 0 ? grid_.before(cell, d) : grid_.next(cell, d);
                Index const face = m % 2 == 0 ? cell : beside;
                if (grid_.open_area[d][face] == 0 || !grid_.open(beside)) continue;
                rooms += room[m] = std::max(0.0, most(beside) - solids[beside]);
            }
            if (rooms <= 0) return;
            double const goes = std::min(excess, 0.5 * rooms);  // others may come too
            for (std::size_t m = 0; m < 6; ++m) {
                Index const beside = m % 2 == 0 ? grid_.before(cell, m / 2) : grid_.next(cell, m / 2);
                moved[beside] += goes * room[m] / rooms;
            }
            moved[cell] -= goes;
            left = std::max(left, goes);
        });
        Field* both[] = {&moved};
        grid::fold(grid_, both);
        for (Index cell = 0; cell < solids.size(); ++cell) solids[cell] += moved[cell];
        grid::refresh(grid_, fields);
        if (comm_.max(left) == 0) break;
    }
    for (Index cell = 0; cell < solids.size(); ++cell) {
        double const open = grid_.open_volume[cell];
        solids[cell] = std::max(open > 0 ? 1 - solids[cell] / open : 1, densest);
    }
    return solids;
}

Field Exchange::sauter_diameter(particle::Store const& granules) const
{
    Field volume = grid_.make_field(), area = grid_.make_field();
    auto const stencils = mapping_.stencils();
    for (std::size_t const row : mapping_.order()) {
        double const d = granules.diameter[row], square = granules.count[row] * d * d;
        mapping_.spread(stencils[row], square * d, volume);
        mapping_.spread(stencils[row], square, area);
    }
    Field* fields[] = {&volume, &area};
    mapping_.finish(fields);
    // Where there is nothing nobody asks; cells beside have what comes nearest.
    for (Index cell = 0; cell < volume.size(); ++cell) volume[cell] = area[cell] > 0 ? volume[cell] / area[cell] : 0;
    return volume;
}

void Exchange::find_drag(particle::Store const& granules, std::size_t row, double dt, Seen& seen, double sauter) const
{
    double const phi = seen.solids_fraction[row], eps = 1 - phi, mu = viscosity(seen.temperature[row]);
    double const d = granules.diameter[row];
    seen.slip[row] = eps * math::norm(seen.velocity[row] - granules.velocity[row]);
    seen.reynolds[row] = seen.density[row] * seen.slip[row] * d / mu;
    double ratio = 0;
    if (sauter > 0)  // a size of a mixture: the law takes the mean, the granule its share of it
        ratio = d / sauter * law::drag::force_ratio(laws_.drag, {phi, seen.reynolds[row] * sauter / d});
    else
        ratio = law::drag::force_ratio(laws_.drag, {phi, seen.reynolds[row]});
    double beta = granules.count[row] * 3 * math::pi * mu * d * eps * ratio;
    if (laws_.filtered) {
        Index const cell = mapping_.cell(mapping_.stencils()[row], 0);
        double const solid = granules.mass[row] / granules.count[row] / (math::pi / 6 * d * d * d);
        double const g = math::norm(solver_.settings().gravity);
        if (g > 0 && solid > seen.density[row])
            beta *= law::drag::filtered_factor(
                {.solid_fraction = phi,
                 .width = std::cbrt(grid_.open_volume[cell]),
                 .terminal_velocity = law::drag::terminal_velocity(d, solid, seen.density[row], mu),
                 .diameter = d,
                 .gravity = g,
                 .parcel_ratio = std::cbrt(granules.count[row])});
    }
    seen.voidage[row] = model_b_ ? eps : 1;
    beta /= seen.voidage[row];
    seen.drag_coefficient[row] = beta;
    double const mass = granules.mass[row] + (adds_mass_ ? seen.added_mass[row] : 0);
    seen.drag[row] = solids_.frozen ? beta : beta / (1 + dt * beta / mass);
}

void Exchange::find_heat(particle::Store const& granules, double dt, Seen& seen) const
{
    auto const& settings = solver_.settings();
    std::visit(
        [&](auto const& heat_law) {
            for (std::size_t row = 0; row < granules.owned; ++row) {
                double const t = seen.temperature[row], w = seen.vapour_fraction[row];
                double const mu = viscosity(t);
                double const conductivity = settings.conductivity ? *settings.conductivity : air::conductivity(t);
                double const diffusivity =
                    settings.diffusivity ? *settings.diffusivity : air::diffusivity(t, settings.pressure);
                double const prandtl = mu * air::heat_capacity(w) / conductivity;
                double const schmidt = mu / (seen.density[row] * diffusivity);
                double const phi = seen.solids_fraction[row], re = seen.reynolds[row];
                double const nusselt = heat_law({.solid_fraction = phi, .reynolds = re, .prandtl = prandtl});
                seen.sherwood[row] = heat_law({.solid_fraction = phi, .reynolds = re, .prandtl = schmidt});
                double const transfer =
                    granules.count[row] * nusselt * conductivity * math::pi * granules.diameter[row];
                double const capacity = heat_capacity(granules, row);
                seen.heat[row] = capacity / dt * -std::expm1(-dt * transfer / capacity);
            }
        },
        laws_.heat);
}

void Exchange::find_lift(particle::Store const& granules, std::size_t row, Seen& seen) const
{
    law::force::Motion const motion{.slip = seen.velocity[row] - granules.velocity[row],
                                    .vorticity = seen.vorticity[row],
                                    .spin = granules.spin[row],
                                    .diameter = granules.diameter[row],
                                    .density = seen.density[row],
                                    .viscosity = viscosity(seen.temperature[row])};
    double const share = granules.count[row] / seen.voidage[row];
    if (lifts_)
        seen.lift[row] = share * (law::force::on_granule(laws_.shear_lift, motion) +
                                  law::force::on_granule(laws_.spin_lift, motion));
    if (turns_) {
        // The torque is along the lag of spin: its coefficient is what remains.
        Vec3 const lag = motion.spin_lag();
        double const lag2 = math::norm2(lag);
        seen.turning[row] =
            lag2 > 0 ? granules.count[row] * math::dot(law::force::on_granule(laws_.torque, motion), lag) / lag2 : 0;
    }
}

void Exchange::find_added_mass(particle::Store const& granules, std::size_t row, Seen& seen)
{
    double const d = granules.diameter[row], displaced = seen.density[row] * math::pi / 6 * d * d * d;
    double const share = granules.count[row] / seen.voidage[row];
    seen.added_mass[row] =
        share * displaced * law::force::virtual_mass(laws_.virtual_mass, {seen.solids_fraction[row]});
    if (!laws_.history) return;
    double const c = law::force::basset_coefficient(d, seen.density[row], viscosity(seen.temperature[row]));
    Vec3 const known = histories_->known(granules.id[row], seen.velocity[row] - granules.velocity[row]);
    seen.history[row] = share * c * known;
    seen.added_mass[row] += share * c * histories_->newest();
}

void Exchange::share(particle::Store& granules, gas::State const& state, double dt, Seen& seen, gas::Sources& sources,
                     std::uint32_t step)
{
    auto velocity = solver_.cell_velocity(state);
    Field temperature = state.temperature, vapour = state.vapour_fraction, density = state.density;
    Field voidage = state.voidage;
    Field* gathered[] = {&velocity[0], &velocity[1], &velocity[2], &temperature, &vapour, &density, &voidage};
    mapping_.prepare(gathered);
    if (cells_.empty()) cells_ = mapping_.make_bundle();
    mapping_.bundle({&velocity[0], &velocity[1], &velocity[2], &temperature, &vapour, &density, &voidage, nullptr},
                    cells_);

    std::size_t const rows = granules.owned;
    resize_all(rows, seen.velocity, seen.own_velocity, seen.temperature, seen.vapour_fraction, seen.density,
               seen.solids_fraction, seen.slip, seen.reynolds, seen.sherwood, seen.drag, seen.heat,
               seen.drag_coefficient, seen.voidage);
    auto const stencils = mapping_.stencils();
    auto const order = mapping_.order();
    for (std::size_t const row : order) {
        auto const [u, v, w, t, y, rho, eps, none] = mapping_.gather(stencils[row], cells_);
        seen.velocity[row] = {u, v, w};
        seen.own_velocity[row] = granules.velocity[row];
        seen.temperature[row] = t;
        seen.vapour_fraction[row] = y;
        seen.density[row] = rho;
        seen.solids_fraction[row] = 1 - std::clamp(eps, densest, 1.0);
        seen.voidage[row] = model_b_ ? 1 - seen.solids_fraction[row] : 1;
    }

    if (disperses_) find_fluctuations(granules, state, dt, step, seen);
    bool const radiates = laws_.emissivity > 0;
    if (lifts_ || turns_ || radiates || laws_.polydisperse) {
        if (more_.empty()) more_ = mapping_.make_bundle();
        std::array<Field, 3> curl;
        if (lifts_ || turns_) curl = solver_.cell_vorticity(state);
        Field sauter, mean_temperature;
        std::vector<Field*> prepared;
        for (auto& component : curl)
            if (!component.empty()) prepared.push_back(&component);
        if (laws_.polydisperse) sauter = sauter_diameter(granules);
        if (radiates) {
            mean_temperature = grid_.make_field();
            Field solids = grid_.make_field();
            for (std::size_t const row : order) {
                double const d = granules.diameter[row], volume = granules.count[row] * d * d * d;
                mapping_.spread(stencils[row], volume * granules.temperature[row], mean_temperature);
                mapping_.spread(stencils[row], volume, solids);
            }
            Field* sums[] = {&mean_temperature, &solids};
            mapping_.finish(sums);
            for (Index c = 0; c < solids.size(); ++c)
                mean_temperature[c] = solids[c] > 0 ? mean_temperature[c] / solids[c] : state.temperature[c];
        }
        mapping_.prepare(prepared);
        auto const or_none = [](Field const& field) { return field.empty() ? nullptr : &field; };
        mapping_.bundle({or_none(curl[0]), or_none(curl[1]), or_none(curl[2]), or_none(sauter),
                         or_none(mean_temperature), nullptr, nullptr, nullptr},
                        more_);
        seen.vorticity.resize(lifts_ || turns_ ? rows : 0);
        seen.lift.resize(lifts_ ? rows : 0);
        seen.turning.resize(turns_ ? rows : 0);
        seen.radiation.resize(radiates ? rows : 0);
    }
    if (adds_mass_) {
        seen.added_mass.resize(rows);
        seen.history.resize(laws_.history ? rows : 0);
        if (laws_.history) histories_->set_step(dt);
        for (std::size_t const row : order) find_added_mass(granules, row, seen);
    }
    for (std::size_t const row : order) {
        std::array<double, 8> more{};
        if (!more_.empty()) more = mapping_.gather(stencils[row], more_);
        find_drag(granules, row, dt, seen, laws_.polydisperse ? more[3] : 0);
        if (lifts_ || turns_) {
            seen.vorticity[row] = {more[0], more[1], more[2]};
            find_lift(granules, row, seen);
        }
        if (radiates) {
            double const d = granules.diameter[row];
            double const around = law::heat::surroundings(seen.solids_fraction[row], seen.temperature[row], more[4]);
            auto const heat = law::heat::radiation(laws_.emissivity, granules.count[row] * math::pi * d * d, around,
                                                   granules.temperature[row]);
            // Eased by what the granule warms meanwhile.
            seen.radiation[row] = heat.heat / (1 - dt * heat.slope / heat_capacity(granules, row));
        }
    }
    find_heat(granules, dt, seen);

    Bundle& to = cells_;
    std::fill(to.begin(), to.end(), std::array<double, 8>{});
    if (!more_.empty()) std::fill(more_.begin(), more_.end(), std::array<double, 8>{});
    for (std::size_t const row : order) {
        // Drag towards u + u' is drag towards u of a granule at v - u'.
        Vec3 const own = disperses_ ? granules.velocity[row] - seen.fluctuation[row] : granules.velocity[row];
        Vec3 const momentum = seen.drag[row] * own;
        Vec3 force = debt(granules, row) / -dt;
        if (lifts_) force -= seen.lift[row];
        mapping_.spread(stencils[row],
                        {seen.drag[row], momentum.x, momentum.y, momentum.z, force.x, force.y, force.z, seen.heat[row]},
                        to);
        double heat_value = seen.heat[row] * (granules.temperature[row] - math::zero_celsius);
        if (radiates) heat_value -= seen.radiation[row];
        mapping_.spread(stencils[row], heat_value, sources.heat_value);
        if (turns_) {
            Vec3 const couple = granules.spin_impulse[row] / -dt;
            mapping_.spread(stencils[row], {couple.x, couple.y, couple.z, 0, 0, 0, 0, 0}, more_);
        }
    }
    mapping_.unbundle(
        to, {&sources.drag_coefficient, &sources.drag_momentum[0], &sources.drag_momentum[1], &sources.drag_momentum[2],
             &sources.force[0], &sources.force[1], &sources.force[2], &sources.heat_coefficient});
    if (turns_)
        mapping_.unbundle(more_, {&sources.couple[0], &sources.couple[1], &sources.couple[2], nullptr, nullptr, nullptr,
                                  nullptr, nullptr});
}

double Exchange::deliver(particle::Store& granules, gas::State const& state, double dt, Seen const& seen,
                         gas::Sources const& sources)
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
    Field temperature = solver_.exchanged_temperature();
    Field* gathered[] = {&velocity[0], &velocity[1], &velocity[2], &gradient[0],
                         &gradient[1], &gradient[2], &temperature};
    mapping_.prepare(gathered);
    mapping_.bundle(
        {&velocity[0], &velocity[1], &velocity[2], &gradient[0], &gradient[1], &gradient[2], &temperature, nullptr},
        cells_);
    std::array<Field, 3> acceleration;
    if (adds_mass_) {
        acceleration = solver_.cell_acceleration(state);
        Field* more[] = {&acceleration[0], &acceleration[1], &acceleration[2]};
        mapping_.prepare(more);
    }

    auto const stencils = mapping_.stencils();
    Vec3 const gravity = solver_.settings().gravity;
    for (std::size_t const row : mapping_.order()) {
        auto const [u, v, w, sx, sy, sz, t, none] = mapping_.gather(stencils[row], cells_);
        Vec3 const slope{sx, sy, sz};
        Vec3 gas{u, v, w};
        if (disperses_) gas += seen.fluctuation[row];
        double const d = granules.diameter[row], volume = granules.count[row] * math::pi / 6 * d * d * d;
        double const added = adds_mass_ ? seen.added_mass[row] : 0;
        granules.gas_velocity[row] = gas;
        granules.drag_rate[row] = seen.drag_coefficient[row] / (granules.mass[row] + added);
        Vec3 force = model_b_ ? -seen.density[row] * volume * gravity : -volume * slope;
        Vec3 const force_of_drag = seen.drag[row] * (gas - seen.own_velocity[row]);
        Vec3 impulse = -dt * force_of_drag;  // the engine adds what really happens
        if (lifts_) force += seen.lift[row];
        if (adds_mass_) {
            Vec3 carried = added * mapping_.gather(stencils[row], acceleration);
            if (laws_.history) carried += seen.history[row];
            force += carried;
            // What of it the gas loses shows when the granule's velocity is known (see debt).
            impulse += dt * carried + added * granules.velocity[row];
            granules.added_mass[row] = added;
        }
        if (turns_) {
            granules.gas_spin[row] = 0.5 * seen.vorticity[row];
            granules.spin_rate[row] =
                seen.turning[row] / (0.4 * granules.mass[row] * granules.radius[row] * granules.radius[row]);
            granules.spin_impulse[row] = {};
        }
        granules.gas_force[row] = force;
        granules.drag_impulse[row] = impulse;
        for (std::size_t k = 0; k < 3; ++k) told[3 + k] += force_of_drag[k];
        double heat = seen.heat[row] * (t - granules.temperature[row]);
        if (laws_.emissivity > 0) heat += seen.radiation[row];
        granules.enthalpy[row] += dt * heat;
        granules.temperature[row] = math::zero_celsius + granules.enthalpy[row] / heat_capacity(granules, row);
    }
    comm_.sum(told);
    double mismatch = 0;
    for (std::size_t k = 0; k < 3; ++k) mismatch = std::max(mismatch, std::abs(told[k] + told[3 + k]));
    return told[6] > 0 ? mismatch / told[6] : 0;
}
}
