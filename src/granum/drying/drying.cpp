#include "granum/drying/drying.hpp"

#include "granum/law/droplet/evaporation.hpp"
#include "granum/law/wetting/footprint.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::drying
{
namespace air = material;

namespace
{
constexpr double unlimited = 1e30;  // solubility of what does not crystallise at once
}

double Drying::coverage(std::vector<Deposit> const& deposits, double count, double diameter)
{
    double area = 0;
    for (auto const& deposit : deposits) area += deposit.weight * math::pi * deposit.base_radius * deposit.base_radius;
    return std::min(1.0, area / (count * math::pi * diameter * diameter));
}

Drying::Limits Drying::limits(Deposit const& deposit, law::deposit::Film film, double saturation, double sherwood,
                              double diameter, double relative_humidity, double gas_over_surface) const
{
    Liquid const& liquid = settings_.liquid;
    double const moisture = deposit.water / deposit.solute;
    // What may be above saturation has the activity of what is dissolved in it.
    double const dissolved = deposit.solute - deposit.weight * deposit.crystals.mass;
    bool const limited = std::holds_alternative<law::deposit::AtSaturation>(settings_.crystallisation);
    law::deposit::Stage const stage{
        .activity =
            limited || liquid.solubility == 0
                ? law::droplet::water_activity(moisture, liquid.solubility, liquid.molar_mass, liquid.dissociation)
                : law::droplet::water_activity(deposit.water / dissolved, unlimited, liquid.molar_mass,
                                               liquid.dissociation),
        .moisture = moisture,
        .equilibrium = settings_.equilibrium_moisture,
        .relative_humidity = relative_humidity,
        .gas_over_surface = gas_over_surface};
    auto const drive = std::visit([&](auto const& law) { return law(stage); }, settings_.stages);
    film.surface_fraction = law::vapour::mass_fraction(drive.activity * saturation);
    // The contact line is pinned: the cap flattens as it loses volume.
    double const volume =
        (deposit.water / air::water_density + deposit.solute / liquid.solids_density) / deposit.weight;
    double const angle = law::wetting::pinned_angle(volume, deposit.base_radius);
    double const area = law::wetting::cap_area(deposit.base_radius, angle);
    return {.cap = drive.factor * law::deposit::cap_rate(deposit.base_radius, angle, film),
            .layer = drive.factor * law::deposit::boundary_layer_rate(sherwood, diameter, area, film),
            .film = drive.factor *
                    law::deposit::boundary_layer_rate(sherwood, diameter, math::pi * diameter * diameter, film)};
}

void Drying::evaporation_rates(std::vector<Deposit> const& open, Surroundings const& seen, std::size_t row,
                               double temperature, double diameter, double count, Rates& rates) const
{
    double const saturation = air::saturation_pressure(temperature) / settings_.pressure;
    law::deposit::Film const film =
        law::deposit::film(temperature, 1.0, seen.temperature[row], seen.vapour_fraction[row], settings_.pressure);
    double const humidity =
        air::relative_humidity(seen.temperature[row], air::loading(seen.vapour_fraction[row]), settings_.pressure);
    bool const one_film = coverage(open, count, diameter) >= settings_.film_coverage;
    auto& limit = rates.limit;
    limit.clear();
    double sum = 0, area = 0;
    for (auto const& deposit : open) {
        limit.push_back(limits(deposit, film, saturation, seen.sherwood[row], diameter, humidity,
                               seen.temperature[row] / temperature));
        sum += deposit.weight * limit.back().cap;
        area += deposit.weight * deposit.base_radius * deposit.base_radius;
    }
    double const full =
        law::deposit::boundary_layer_rate(seen.sherwood[row], diameter, math::pi * diameter * diameter, film);
    rates.cap.resize(open.size());
    for (std::size_t k = 0; k < open.size(); ++k)
        // Of one film each deposit has its share by area.
        rates.cap[k] =
            one_film ? limit[k].film * count * open[k].base_radius * open[k].base_radius / area
                     : std::visit([&](auto const& law) { return law(limit[k].cap, sum / count, limit[k].layer, full); },
                                  settings_.combine);
}

Drying::Change Drying::evaporate(Deposit const& deposit, double rate, double dt) const
{
    double const dry = dry_water(deposit.solute), leaving = deposit.weight * rate * dt;
    if (deposit.water - leaving > dry) return {.water = leaving};
    // One that arrives as dry as that still meets the gas for a moment, so that its means are not 0 / 0.
    return {.lasts = leaving > 0 ? std::clamp((deposit.water - dry) / leaving, 1e-9, 1.0) : 1,
            .water = std::max(0.0, deposit.water - settings_.equilibrium_moisture * deposit.solute),
            .ends = true};
}

Drying::Change Drying::solidify(Deposit const& deposit, double sherwood, double diameter, double gas, double granule,
                                double dt) const
{
    Liquid const& liquid = settings_.liquid;
    double const angle =
        law::wetting::pinned_angle(deposit.solute / liquid.solids_density / deposit.weight, deposit.base_radius);
    double const film = 0.5 * (gas + liquid.melting_point);
    double const density = air::density(settings_.pressure, film, 0);
    double const schmidt = air::viscosity(film) / (density * air::diffusivity(film, settings_.pressure));
    double const prandtl = air::viscosity(film) * air::heat_capacity(0) / air::conductivity(film);
    // Heat like vapour: the number of one is that of the other times the cube root of Pr / Sc.
    double const transfer = sherwood * std::cbrt(prandtl / schmidt) * air::conductivity(film) / diameter;
    law::deposit::MeltCap const cap{.base_radius = deposit.base_radius,
                                    .area = law::wetting::cap_area(deposit.base_radius, angle),
                                    .heat_transfer = transfer,
                                    .conductivity = liquid.conductivity,
                                    .above_gas = liquid.melting_point - gas,
                                    .above_granule = liquid.melting_point - granule};
    double const power =
        deposit.weight * std::visit([&](auto const& law) { return law(cap); }, settings_.solidification);
    double const leaving = std::max(0.0, power) * dt;
    if (deposit.heat > leaving) return {.heat = leaving};
    return {
        .lasts = leaving > 0 ? std::clamp(deposit.heat / leaving, 1e-9, 1.0) : 1, .heat = deposit.heat, .ends = true};
}

Event Drying::finish(Deposit const& deposit, double count, double diameter, double mass, double layer) const
{
    Event event = deposit.record;
    double const time = event.drying_time = deposit.time;
    event.solids = deposit.solute;
    event.footprint = deposit.base_radius;
    event.granule_diameter = diameter;
    event.per_granule = deposit.weight / count;
    event.weight = deposit.weight;
    event.mean_gas_temperature = deposit.gas_temperature / time;
    event.mean_gas_humidity = deposit.gas_humidity / time;
    event.mean_drying_potential = deposit.drying_potential / time;
    event.mean_granule_temperature = deposit.granule_temperature / time;
    event.mean_slip = deposit.slip / time;
    event.wet_contacts = deposit.contacts;
    event.wet_impulse = deposit.impulse;
    double const landed = (deposit.water_at_impact + deposit.solute) / deposit.weight / settings_.liquid.density;
    if (deposit.contacts > 0) {
        // Of equal granules: J = (1 + e) m / 2 times the speed of approach.
        double const speed = deposit.impulse / deposit.contacts / ((1 + settings_.restitution) * mass);
        double const density = mass / (math::pi / 6 * diameter * diameter * diameter);
        event.viscous_stokes = law::wetting::viscous_stokes(density, 0.5 * diameter, speed, settings_.viscosity);
    }
    event.critical_stokes = law::wetting::critical_stokes(
        settings_.restitution,
        law::wetting::cap_height(deposit.base_radius, law::wetting::pinned_angle(landed, deposit.base_radius)),
        settings_.roughness);
    // Without the trace, which leaves at once at the end.
    double const foot = math::pi * deposit.base_radius * deposit.base_radius;
    event.mean_flux =
        std::max(deposit.water_at_impact - dry_water(deposit.solute), 0.0) / (deposit.weight * foot * time);
    auto const& crystals = deposit.crystals;
    event.supersaturation = crystals.supersaturation;
    event.crystals = crystals.count;
    if (auto const* law = std::get_if<law::deposit::NucleationGrowth>(&settings_.crystallisation);
        law && crystals.count > 0)
        event.crystal_size = std::cbrt(deposit.solute / deposit.weight /
                                       (settings_.liquid.solids_density * law->shape * crystals.count));
    event.porosity = settings_.porosity(event.mean_drying_potential, event.drying_time, event.moisture_at_impact);
    if (settings_.pores.share > 0) {
        auto const& liquid = settings_.liquid;
        double const one = deposit.solute / deposit.weight / (liquid.solids_density * (1 - event.porosity));
        double const penetration = law::wetting::penetration_time(landed, settings_.pores);
        event.imbibed = law::wetting::bare(layer, one / foot) * law::wetting::entered(time, penetration);
    }
    return event;
}

double Drying::equilibrium(double granule_temperature, double gas_temperature, double vapour_fraction) const
{
    double const humidity = air::relative_humidity(gas_temperature, air::loading(vapour_fraction), settings_.pressure) *
                            air::saturation_pressure(gas_temperature) / air::saturation_pressure(granule_temperature);
    return std::visit([&](auto const& law) { return law(humidity); }, settings_.sorption);
}

void Drying::advance(particle::Store& granules, Deposits& deposits, Surroundings const& seen, double dt, double now,
                     std::vector<double>& evaporated, std::vector<Event>& events) const
{
    Liquid const& liquid = settings_.liquid;
    auto const* const crystals =
        liquid.solubility > 0 ? std::get_if<law::deposit::NucleationGrowth>(&settings_.crystallisation) : nullptr;
    bool const sorbs = !std::holds_alternative<law::vapour::NoSorption>(settings_.sorption);
    double const share = -std::expm1(-dt / settings_.sorption_time);
    evaporated.assign(granules.owned, 0.0);
    Rates rates;
    for (std::size_t row = 0; row < granules.owned; ++row) {
        auto& open = deposits.on(granules.id[row]);
        double const temperature = granules.temperature[row], diameter = granules.diameter[row];
        if (sorbs) {
            double const held = equilibrium(temperature, seen.temperature[row], seen.vapour_fraction[row]);
            double const out = (granules.absorbed[row] - held * granules.core_mass[row]) * share;
            granules.absorbed[row] -= out, granules.water[row] -= out, evaporated[row] += out;
            granules.enthalpy[row] -= out * air::vapour_enthalpy(temperature);
            if (open.empty()) resize_granule(granules, row);
        }
        if (open.empty()) continue;
        double const count = granules.count[row];
        double const layer = granules.layer_volume[row] / (count * math::pi * diameter * diameter);
        if (!liquid.melt()) evaporation_rates(open, seen, row, temperature, diameter, count, rates);
        double lost = 0, dried_solids = 0, dried_volume = 0;
        std::size_t kept = 0;
        for (std::size_t k = 0; k < open.size(); ++k) {
            Deposit& deposit = open[k];
            Change const change =
                liquid.melt() ? solidify(deposit, seen.sherwood[row], diameter, seen.temperature[row], temperature, dt)
                              : evaporate(deposit, rates.cap[k], dt);
            double const h = change.lasts * dt;
            deposit.time += h;
            deposit.gas_temperature += h * seen.temperature[row];
            deposit.gas_humidity += h * air::loading(seen.vapour_fraction[row]);
            deposit.drying_potential += h * seen.drying_potential[row];
            deposit.granule_temperature += h * temperature;
            deposit.slip += h * seen.slip[row];
            if (!liquid.melt()) {
                double const foot = math::pi * deposit.base_radius * deposit.base_radius;
                deposit.record.max_flux = std::max(deposit.record.max_flux, rates.cap[k] / foot);
                if (liquid.solubility > 0 && deposit.water * liquid.solubility > deposit.solute)
                    deposit.record.constant_rate_time += h;
            }
            deposit.water -= change.water;
            deposit.heat -= change.heat;
            lost += change.water;
            granules.enthalpy[row] += change.heat;
            if (crystals && !change.ends)
                crystals->advance(deposit.crystals,
                                  {.water = deposit.water / deposit.weight,
                                   .solids = deposit.solute / deposit.weight,
                                   .foot = math::pi * deposit.base_radius * deposit.base_radius,
                                   .solubility = liquid.solubility,
                                   .solids_density = liquid.solids_density},
                                  h);
            if (!change.ends) {
                if (kept != k) open[kept] = deposit;
                ++kept;
                continue;
            }
            Event event = finish(deposit, count, diameter, granules.mass[row] / count, layer);
            event.granule = static_cast<double>(granules.id[row]);
            event.t_dry_end = now - dt + h;
            dried_solids += deposit.solute;
            dried_volume += deposit.solute * (1 - event.imbibed) / (liquid.solids_density * (1 - event.porosity));
            events.push_back(event);
        }
        open.resize(kept);
        granules.water[row] -= lost;
        if (open.empty() && settings_.equilibrium_moisture == 0 &&
            std::abs(granules.water[row] - granules.absorbed[row]) < 1e-15 * granules.core_mass[row]) {
            // Only rounding is left; it stays in the ledger as evaporated.
            lost += granules.water[row] - granules.absorbed[row];
            granules.water[row] = granules.absorbed[row];
        }
        evaporated[row] += lost;
        granules.enthalpy[row] -= lost * air::vapour_enthalpy(temperature);
        granules.solute[row] -= dried_solids;
        granules.layer_mass[row] += dried_solids;
        granules.layer_volume[row] += dried_volume;
        resize_granule(granules, row);
    }
}

void resize_granule(particle::Store& granules, std::size_t row)
{
    granules.mass[row] =
        granules.core_mass[row] + granules.layer_mass[row] + granules.water[row] + granules.solute[row];
    double const count = granules.count[row];
    double const core = granules.core_diameter[row];
    granules.diameter[row] = std::cbrt(core * core * core + 6 * granules.layer_volume[row] / (math::pi * count));
    granules.radius[row] = 0.5 * granules.diameter[row] * std::cbrt(count);
}
}
