// The state of the process at time zero: gas and moisture as the balance says they must end up.
#include "granum/base/error.hpp"
#include "granum/base/exact_sum.hpp"
#include "granum/drying/impact.hpp"
#include "granum/law/droplet/size.hpp"
#include "granum/law/impact/splash.hpp"
#include "granum/law/wetting/footprint.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>
#include <cmath>

namespace granum::sim
{
namespace air = material;

namespace
{
//! How the water of one deposit falls while it dries under fixed conditions.
struct DryingCurve
{
    std::vector<double> time{0}, water{1};  //!< s, fraction of the water at impact

    double duration() const { return time.back(); }
    double at(double share) const  //!< share of the duration, 0 to 1
    {
        double const t = share * duration();
        auto const next = std::upper_bound(time.begin(), time.end(), t);
        if (next == time.end()) return water.back();
        auto const i = static_cast<std::size_t>(next - time.begin());
        double const part = (t - time[i - 1]) / (time[i] - time[i - 1]);
        return water[i - 1] + part * (water[i] - water[i - 1]);
    }
};
}

void Simulation::make_gas()
{
    auto const& gas = case_.gas;
    if (!gas.inlets.empty() && dry_inlet_flow(case_) > 0) {
        balance_ = balance(case_);
        wet_bulb_ = std::make_unique<material::WetBulbTable>(gas.pressure);
    }
    solver_ = std::make_unique<gas::Solver>(gas_settings(case_), grid_, comm_);
    gas_.turbulent = law::turbulence::transports(solver_->settings().turbulence.model);
    mapping_ = std::make_unique<coupling::Mapping>(grid_, comm_, smoothing(case_), mapping_scheme(case_));
    exchange_ = std::make_unique<coupling::Exchange>(
        exchange_laws(case_), *solver_, grid_, comm_, *mapping_,
        coupling::Solids{.heat_capacity = case_.granules.heat_capacity, .frozen = case_.granules.frozen},
        histories_.get());
    conduction_ = std::make_unique<coupling::Conduction>(conduction(case_, comm_));
}

void Simulation::start_gas()
{
    auto const& gas = case_.gas;
    FlowCase const& inlet = case_.phases.empty() || gas.inlets.empty() ? gas.inlet : gas.inlets.front();
    bool const flows = !gas.inlets.empty();
    bool const steady = flows && case_.start.quasi_steady;
    double const temperature = case_.start.gas_temperature ? *case_.start.gas_temperature
                               : steady                    ? balance_.outlet_temperature
                                                           : inlet.temperature;
    double const vapour = air::fraction(steady ? balance_.outlet_humidity : inlet.humidity);
    // Of granules that bring none along.
    double const bed = (case_.start.bed_temperature ? *case_.start.bed_temperature
                        : steady                    ? balance_.outlet_temperature
                                                    : temperature) +
                       case_.start.temperature_offset;

    if (drying_ && case_.drying.sorption != "none")
        for (std::size_t row = 0; row < granules_.owned; ++row) {
            double const held = case_.drying.absorbed.value_or(drying_->equilibrium(bed, bed, vapour));
            granules_.water[row] = granules_.absorbed[row] = held * granules_.core_mass[row];
            drying::resize_granule(granules_, row);
        }

    std::array<base::ExactSum, 2> all{};  // heat capacity of the granules and their heat above the gas
    for (std::size_t row = 0; row < granules_.owned; ++row) {
        double& own = granules_.temperature[row];
        if (!(own > 0)) own = bed;
        double const capacity = exchange_->heat_capacity(granules_, row);
        granules_.enthalpy[row] = capacity * (own - math::zero_celsius);
        all[0].add(capacity), all[1].add(capacity * (own - temperature));
    }
    comm_.sum(all);
    settling_.end = flows && case_.start.settling > 0 ? -1 : 0;
    Vec3 velocity = gas.initial_velocity;
    if (flows && velocity == Vec3{}) {
        double const density = gas.density ? *gas.density : air::density(gas.pressure, temperature, vapour);
        double const area = case_.chamber.volume() / case_.chamber.height();
        for (auto const& one : solver_->settings().inlets)
            if (one.at.direction == 2) velocity.z += (one.at.upper ? -1 : 1) * one.mass_flow / (density * area);
    }
    mapping_->locate(granules_);
    auto const voidage = exchange_->voidage(granules_);
    auto temperatures = grid_.make_field(temperature);
    if (double const capacity = all[0].value(); !case_.start.gas_temperature && capacity > 0) {
        // Gas between granules has their temperature: of another one it would have it within a millisecond, and would
        // burst out of the bed as it expands.
        double const warmer = all[1].value() / capacity;
        double const solids = case_.granules.density * case_.granules.heat_capacity;
        double const free = material::heat_capacity_air * air::density(gas.pressure, temperature, vapour);
        grid::for_each_cell(grid_, [&](int, int, int, grid::Index c) {
            double const share = (1 - voidage[c]) * solids / ((1 - voidage[c]) * solids + voidage[c] * free);
            temperatures[c] += share * warmer;
        });
    }
    gas_ = solver_->start(voidage, temperatures, vapour, velocity);
}

void Simulation::start_deposits()
{
    // What is wet in the steady state: deposits of every age up to their drying time, born at the rate of the spray,
    // spread evenly over a well-mixed bed at the balance's temperature and humidity.
    auto const& spray = case_.spray;
    auto const& liquid = flight_.liquid;
    auto const& batch = case_.granules;
    double const pressure = case_.gas.pressure;
    double const temperature = balance_.outlet_temperature;
    double const vapour = air::fraction(balance_.outlet_humidity);
    double const real = batch.mass / (batch.density * math::pi / 6 * std::pow(batch.diameter, 3));
    if (!(real > 0) || !(spray.rate > 0) || liquid.melt()) return;  // a melt is solid at once

    auto const film = law::deposit::film(temperature, 1.0, temperature, vapour, pressure);
    double const viscosity = air::viscosity(temperature), density = air::density(pressure, temperature, vapour);
    double flow = 0;
    for (auto const& inlet : solver_->settings().inlets) flow += inlet.mass_flow;
    double const speed = flow / (density * case_.chamber.area(case_.chamber.bottom()));
    double const schmidt = viscosity / (density * air::diffusivity(temperature, pressure));
    double const sherwood = std::visit(
        [&](auto const& law) {
            return law(
                {.solid_fraction = 0.4, .reynolds = density * speed * batch.diameter / viscosity, .prandtl = schmidt});
        },
        exchange_->laws().heat);
    double const full =
        law::deposit::boundary_layer_rate(sherwood, batch.diameter, math::pi * batch.diameter * batch.diameter, film);
    // Caps share their boundary layers: in the steady state sum / (1 + sum / full) is what the spray brings.
    double const share = balance_.water_rate / real;  // kg/s per granule
    double const sum = share / std::max(0.05, 1 - share / full);

    // One deposit of the median droplet; the others dry in times proportional to the square of their diameter.
    auto const& nozzle = nozzles_.front();
    double const median = nozzle.median_diameter();
    double const settled = batch.mass / (batch.density * 0.6 * case_.chamber.area(case_.chamber.bottom()));
    Vec3 const surface = nozzle.position + std::max(0.02, nozzle.position.z - 1.5 * settled) * nozzle.direction;
    law::impact::Impact const impact{spray.density, spray.viscosity, spray.surface_tension,
                                     2.0 / 3 * std::max(3.0, nozzle.jet_speed(surface, density)), median};
    double const mass = spray.density * math::pi / 6 * median * median * median;
    drying::Deposit deposit;
    deposit.weight = 1;
    deposit.water = deposit.water_at_impact = mass * (1 - spray.solids_fraction);
    deposit.solute = mass * spray.solids_fraction;
    deposit.base_radius =
        law::wetting::footprint_radius(median, spray.contact_angle, impact.weber(), impact.reynolds());
    double const saturation = air::saturation_pressure(temperature) / pressure;
    double const dry = drying_->dry_water(deposit.solute);
    double const humidity = air::relative_humidity(temperature, balance_.outlet_humidity, pressure);
    DryingCurve curve;
    while (deposit.water > dry && curve.time.size() < 100000) {
        deposit.crystals.mass =
            std::max(0.0, deposit.solute - deposit.water * spray.solubility);  // as in the steady state
        auto const limit = drying_->limits(deposit, film, saturation, sherwood, batch.diameter, humidity, 1);
        double const rate = std::visit([&](auto const& law) { return law(limit.cap, sum, limit.layer, full); },
                                       drying_->settings().combine);
        base::require(rate > 0, "deposits cannot dry at the balance's outlet state ({:.2f} K, {:.5f} kg/kg)",
                      temperature, balance_.outlet_humidity);
        double const h = std::min(0.01 * deposit.water_at_impact, deposit.water - 0.5 * dry) / rate;
        deposit.water = std::max(deposit.water - rate * h, 0.0);
        curve.time.push_back(curve.time.back() + h);
        curve.water.push_back(deposit.water / deposit.water_at_impact);
    }

    std::vector<long> row_of(static_cast<std::size_t>(batch.parcels), -1);
    for (std::size_t row = 0; row < granules_.owned; ++row) row_of[granules_.id[row]] = static_cast<long>(row);
    double const per_second = spray.parcels_per_second;
    double const longest = curve.duration() * std::pow(nozzle.largest_diameter() / median, 2);
    for (std::uint64_t n = 0; static_cast<double>(n) < longest * per_second; ++n) {
        base::Random random(case_.seed, base::Purpose::deposit, n, 0);
        double const size = nozzle.diameter(random) / median, duration = curve.duration() * size * size;
        double const age = (static_cast<double>(n) + 0.5) / per_second;
        auto const id = static_cast<std::size_t>(random.uniform() * static_cast<double>(batch.parcels));
        long const found = row_of[id];
        if (age >= duration || found < 0) continue;
        auto const row = static_cast<std::size_t>(found);
        double const one = mass * size * size * size;
        drying::Deposit old;
        old.weight = spray.rate / per_second / one;
        old.water_at_impact = old.weight * one * (1 - spray.solids_fraction);
        old.water = old.water_at_impact * curve.at(age / duration);
        old.solute = old.weight * one * spray.solids_fraction;
        old.base_radius = deposit.base_radius * size;
        old.time = age;
        double const potential = local_drying_potential(temperature, vapour);
        old.gas_temperature = old.granule_temperature = age * temperature;
        old.gas_humidity = age * balance_.outlet_humidity;
        old.drying_potential = age * potential;
        old.slip = age * speed;
        // What its water cannot hold is crystalline already.
        old.crystals.mass = std::max(0.0, old.solute - old.water * spray.solubility) / old.weight;
        old.record.initial = 1;
        old.record.t_deposit = -age;
        old.record.droplet_diameter = median * size;
        old.record.moisture_at_impact = liquid.feed_moisture();
        old.record.gas_temperature = old.record.granule_temperature = old.record.droplet_temperature = temperature;
        old.record.gas_humidity = balance_.outlet_humidity;
        old.record.drying_potential = potential;
        granules_.water[row] += old.water;
        granules_.solute[row] += old.solute;
        deposits_->on(id).push_back(old);
        drying::resize_granule(granules_, row);
    }
    for (std::size_t row = 0; row < granules_.owned; ++row)
        granules_.enthalpy[row] =
            exchange_->heat_capacity(granules_, row) * (granules_.temperature[row] - math::zero_celsius);
    engine_->changed(granules_);
}
}
