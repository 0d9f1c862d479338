#include "granum/sim/simulation.hpp"

#include "granum/base/error.hpp"
#include "granum/drying/impact.hpp"
#include "granum/gas/traffic.hpp"
#include "granum/grid/build.hpp"
#include "granum/particle/rows.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/opening_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

namespace granum::sim
{
namespace air = material;
using grid::Index;

namespace
{
// A look at the balance costs about as much as two rebuilds of the neighbour list.
constexpr int rebuilds_between_balances = 30;
}

Simulation::~Simulation() = default;

Simulation::Simulation(Case data, par::Communicator const& comm, io::Checkpoint const* saved)
    : case_(std::move(data)), comm_(comm)
{
    auto settings = granule_settings(case_);
    if (case_.contact.hard()) {
        base::require(comm.size() == 1, "hard spheres run on one rank; there are {}", comm.size());
        auto hard = std::make_unique<HardMover>(settings, hard_options(case_));
        hard_ = hard.get();
        mover_ = std::move(hard);
    }
    if (case_.gas.present)
        lines_ = gas_lines(case_);
    else
        settings.balance_every = rebuilds_between_balances;
    granule_dt_ = granule_step(case_);

    auto const state = saved ? read(*saved) : nullptr;
    if (saved)
        take_granules(*state);
    else
        place_granules();
    if (!hard_) {
        engine_ = std::make_unique<dem::Engine>(std::move(settings), *partition_, comm_);
        mover_ = std::make_unique<SoftMover>(engine_);
    }
    if (case_.spray.present) {
        deposits_ = std::make_unique<drying::Deposits>(static_cast<std::size_t>(case_.granules.first_free));
        engine_->attach(*deposits_);
    }
    if (case_.gas.forces.history > 0) {
        histories_ = std::make_unique<coupling::Histories>(static_cast<std::size_t>(case_.gas.forces.history));
        engine_->attach(*histories_);
    }
    if (saved) {
        take_contacts(*state);
    } else {
        mover_->prepare(granules_);
        if (case_.granules.start == "settled" || case_.granules.start == "poured") settle_between_still_walls();
        auto& watch = mover_->watch();  // from here on it watches the run
        watch.largest_overlap = 0, watch.warned_overlaps = 0;
        watch.dissipated = watch.wall_work = {};
        // What they met as they fell is not of this process.
        for (auto* column :
             {&granules_.collisions, &granules_.collision_speed, &granules_.collision_wear, &granules_.wall_collisions,
              &granules_.wall_collision_speed, &granules_.wall_collision_wear})
            std::fill(column->values.begin(), column->values.end(), 0.0);
    }
    follow(case_, nominal_, 0);
    if (case_.spray.present) drying_ = std::make_unique<drying::Drying>(drying_settings(case_));
    if (case_.gas.present) {
        if (!saved && comm_.size() > 1) share_space(partition(granules_.position.values));
        grid_ = grid::build(grid::openness(case_.chamber), lines_, grid::layout(*partition_, lines_), comm_);
        if (case_.chamber.region) check_openings(case_, grid_, comm_);
        make_gas();
        if (!saved) start_gas();
    }
    if (case_.spray.present) {
        nozzles_ = nozzles(case_);
        flight_ = flight_settings(case_);
        find_nozzle_cells();
        if (case_.start.quasi_steady && !saved) start_deposits();
    }
    if (saved) {
        take_process(*state);
        audit();
        return;
    }
    auto stock = stocks();
    comm_.sum(stock);
    ledgers_.solids.start = stock[0], ledgers_.water.start = stock[1], ledgers_.energy.start = stock[2];
    // The first steps are measured against a hundredth of a second of what the process moves.
    double sprayed = nominal_.spray_rate;
    for (auto const& phase : case_.phases) sprayed = std::max(sprayed, phase.spray_rate.value_or(0));
    ledgers_.solids.reference = 0.01 * sprayed * case_.spray.solids_fraction;
    ledgers_.water.reference = 0.01 * (sprayed + balance_.dry_mass_flow * balance_.outlet_humidity);
    ledgers_.energy.reference = std::max(1e-3 * std::abs(stock[2]), 1e-9);
    audit();
}

double Simulation::local_drying_potential(double temperature, double vapour_fraction) const
{
    double const span = balance_.wet_bulb_humidity - balance_.inlet_humidity;
    return wet_bulb_ ? wet_bulb_->drying_potential(temperature, air::loading(vapour_fraction), span) : 0;
}

void Simulation::step(double longest)
{
    double wanted = longest;
    if (has_gas()) {
        wanted = std::min(wanted, case_.time.gas_step ? *case_.time.gas_step
                                                      : std::min(solver_->courant_step(gas_, 1.0), 50 * granule_dt_));
    } else {
        wanted = std::min(wanted, (hard_ ? 1 : 20) * granule_dt_);
    }
    // Equal steps up to the next goal, equal granule steps within each: goals are met exactly.
    double const dt = longest < 1e300 ? longest / std::ceil(longest / wanted * (1 - 1e-9)) : wanted;
    int const substeps = std::max(1, static_cast<int>(std::ceil(dt / granule_dt_ * (1 - 1e-9))));

    if (has_gas()) {
        balance_work(substeps);
        gas_step(dt);
    }
    mover_->advance(granules_, dt / substeps, substeps);
    if (hard_) granule_dt_ = hard_->next_step(granules_, dt, granule_dt_);

    granule_steps_ += substeps * comm_.sum(static_cast<long>(granules_.owned));
    time_ += dt;
    ++steps_;
    if (!has_gas()) let_out();
    feed_all(time_);
    audit();
}

void Simulation::follow_programme(double time)
{
    if (!follow(case_, nominal_, time)) return;
    if (dry_inlet_flow(case_) > 0) balance_ = balance(case_);
    for (std::size_t k = 0; k < case_.gas.inlets.size(); ++k) {
        auto const& now = case_.gas.inlets[k];
        auto& inlet = solver_->inlet(k);
        inlet.mass_flow = moist_mass_flow(case_, now);
        inlet.temperature = now.temperature;
        inlet.vapour_fraction = air::fraction(now.humidity);
    }
    for (auto& nozzle : nozzles_) nozzle.rate = case_.spray.rate / static_cast<double>(nozzles_.size());
}

void Simulation::gas_step(double dt)
{
    if (!case_.phases.empty()) follow_programme(time_ + 0.5 * dt);
    bool const settling = settling_.end < 0;
    double const bed = settling ? bed_temperature()[1] : 0;
    sources_.clear(grid_);
    grid::Field voidage;
    {
        auto const scope = stopwatch_.time(base::Stage::exchange);
        mapping_->locate(granules_);
        voidage = exchange_->voidage(granules_);
        exchange_->share(granules_, gas_, dt, seen_, sources_, static_cast<std::uint32_t>(steps_));
    }
    if (case_.spray.present) {
        auto const scope = stopwatch_.time(base::Stage::spray_and_drying);
        potential_.resize(granules_.owned);
        for (std::size_t row = 0; row < granules_.owned; ++row)
            potential_[row] = local_drying_potential(seen_.temperature[row], seen_.vapour_fraction[row]);
        take_collisions();
        nozzle_air(dt);
        fly_droplets(dt);
        std::size_t const before = events_.size();
        drying_->advance(granules_, *deposits_,
                         {seen_.temperature, seen_.vapour_fraction, potential_, seen_.slip, seen_.sherwood}, dt,
                         time_ + dt, evaporated_, events_);
        std::stable_sort(events_.begin() + static_cast<std::ptrdiff_t>(before), events_.end(),
                         [](auto const& a, auto const& b) { return a.granule < b.granule; });
        auto const stencils = mapping_->stencils();
        for (std::size_t const row : mapping_->order()) {
            if (evaporated_[row] == 0) continue;
            double const rate = evaporated_[row] / dt;
            mine_.evaporated += evaporated_[row];
            mapping_->spread(stencils[row], rate, sources_.mass);
            mapping_->spread(stencils[row], rate, sources_.vapour);
            mapping_->spread(stencils[row], rate * air::vapour_enthalpy(granules_.temperature[row]), sources_.enthalpy);
        }
    }
    {
        auto const scope = stopwatch_.time(base::Stage::exchange);
        grid::Field* fields[] = {&sources_.drag_coefficient, &sources_.drag_momentum[0],
                                 &sources_.drag_momentum[1], &sources_.drag_momentum[2],
                                 &sources_.force[0],         &sources_.force[1],
                                 &sources_.force[2],         &sources_.mass,
                                 &sources_.vapour,           &sources_.enthalpy,
                                 &sources_.heat_coefficient, &sources_.heat_value};
        mapping_->finish(fields);
        grid::Field* couples[] = {&sources_.couple[0], &sources_.couple[1], &sources_.couple[2]};
        if (exchange_->turns()) mapping_->finish(couples);
    }
    {
        auto const scope = stopwatch_.time(base::Stage::gas);
        last_ = solver_->advance(gas_, sources_, voidage, dt);
        unconverged_ += !last_.pressure_converged;
        double const cells = static_cast<double>(grid_.n[0]) * grid_.n[1] * grid_.n[2];
        gas_work_.cell_steps += cells;
        gas_work_.bytes += cells * gas::bytes_per_cell(last_);
        gas_work_.iterations += cells * last_.pressure_iterations;
        gas_work_.sweeps += cells * last_.sweeps;
        in_[1] += last_.vapour_in, out_[1] += last_.vapour_out;
        in_[2] += last_.enthalpy_in + last_.pressure_work, out_[2] += last_.enthalpy_out + last_.wall_heat;
        heat_.wall_gas += last_.wall_heat;
    }
    {
        auto const scope = stopwatch_.time(base::Stage::exchange);
        double const mismatch = exchange_->deliver(granules_, gas_, dt, seen_, sources_);
        ledgers_.momentum = std::max(ledgers_.momentum, mismatch);
        if (conduction_->passes_heat()) {
            std::vector<double> capacity(granules_.owned);
            for (std::size_t row = 0; row < granules_.owned; ++row)
                capacity[row] = exchange_->heat_capacity(granules_, row);
            auto const passed = conduction_->pass(*engine_, granules_, capacity, dt);
            out_[2] += passed.to_walls();
            heat_.contacts += passed.contacts, heat_.film += passed.film;
            heat_.wall_contacts += passed.wall_contacts, heat_.wall_film += passed.wall_film;
        }
        for (double const gained : seen_.radiation) heat_.radiation -= dt * gained;
    }
    if (settling) settle_bed(bed);
    if (case_.spray.present) engine_->changed(granules_);
}

std::array<double, 3> Simulation::stocks() const
{
    std::array<double, 3> stock{};
    auto const order = granules_.groups.process ? particle::rows_by_identity(granules_) : std::vector<std::uint32_t>{};
    for (std::size_t const row : order) {
        stock[0] += granules_.layer_mass[row] + granules_.solute[row];
        stock[1] += granules_.water[row];
        stock[2] += granules_.enthalpy[row];
        if (deposits_)
            for (auto const& deposit : deposits_->on(granules_.id[row])) stock[2] += deposit.heat;
    }
    for (auto const& droplet : droplets_) {
        stock[0] += droplet.solids();
        stock[1] += droplet.liquid_water();
        stock[2] += droplet.enthalpy(flight_.liquid);
    }
    if (has_gas())
        grid::for_each_cell(grid_, [&](int, int, int, Index cell) {
            stock[1] += gas_.vapour[cell];
            stock[2] += gas_.enthalpy[cell];
        });
    return stock;
}

void Simulation::audit()
{
    std::array<double, 9> sums{};
    auto const stock = stocks();
    for (std::size_t q = 0; q < 3; ++q) sums[q] = stock[q], sums[3 + q] = in_[q], sums[6 + q] = out_[q];
    comm_.sum(sums);
    Ledger* ledgers[] = {&ledgers_.solids, &ledgers_.water, &ledgers_.energy};
    for (std::size_t q = 0; q < 3; ++q) {
        Ledger& ledger = *ledgers[q];
        ledger.now = sums[q], ledger.in = sums[3 + q], ledger.out = sums[6 + q];
        base::require(std::isfinite(ledger.now), "the {} ledger is not finite at {} s, step {}", ledger.name, time_,
                      steps_);
        base::require(
            !ledger.broken() || !case_.gas.present,
            "the {0} ledger leaks at {1:.6g} s: there are {2:.9g} {6}, but start {3:.9g} + in {4:.9g} - out {5:.9g} "
            "do not add up to it (relative error {7:.2g}, the bar is {8:.0g})",
            ledger.name, time_, ledger.now, ledger.start, ledger.in, ledger.out, ledger.unit, ledger.relative_error(),
            ledger.bar);
    }
    base::require(ledgers_.momentum <= 10 * Ledgers::momentum_bar,
                  "momentum is lost between gas and granules at {:.6g} s: relative mismatch {:.2g}", time_,
                  ledgers_.momentum);
}

std::vector<drying::Event> Simulation::take_events()
{
    auto const bytes = comm_.gather(std::as_bytes(std::span(events_)));
    events_.clear();
    std::vector<drying::Event> all(bytes.size() / sizeof(drying::Event));
    if (!bytes.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
    // In the order of time, whichever rank they came from.
    std::stable_sort(all.begin(), all.end(), [](auto const& a, auto const& b) {
        return std::tie(a.t_dry_end, a.granule, a.t_deposit) < std::tie(b.t_dry_end, b.granule, b.t_deposit);
    });
    return all;
}
}
