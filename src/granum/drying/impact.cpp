#include "granum/drying/impact.hpp"

#include "granum/drying/drying.hpp"
#include "granum/law/impact/splash.hpp"
#include "granum/law/wetting/footprint.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::drying
{
namespace
{
//! Of equal caps a part of that number.
Deposit part_of(Deposit whole, double share)
{
    for (double Deposit::*amount :
         {&Deposit::weight, &Deposit::water, &Deposit::solute, &Deposit::water_at_impact, &Deposit::heat})
        whole.*amount *= share;
    return whole;
}

//! Droplets of `fresh` fall on the caps of a deposit, drawn by area: several on each, or one on each of a part of them,
//! whose others stay as they are.
void join(std::vector<Deposit>& open, Deposit const& fresh, double draw, Arrival const& droplet)
{
    double area = 0;
    for (auto const& one : open) area += one.weight * one.base_radius * one.base_radius;
    std::size_t k = 0;
    for (double left = draw * area; k + 1 < open.size(); ++k)
        if ((left -= open[k].weight * open[k].base_radius * open[k].base_radius) < 0) break;
    double const caps = std::min(fresh.weight, open[k].weight);
    Deposit const below = part_of(open[k], caps / open[k].weight);
    Deposit both = fresh;
    both.weight = caps;
    both.water += below.water, both.solute += below.solute, both.water_at_impact += below.water;
    both.heat += below.heat;
    both.crystals = below.crystals;
    // The wider of both contact lines, or that of a cap at rest of both.
    double const volume = (both.water + both.solute) / caps / droplet.density;
    both.base_radius =
        std::max({below.base_radius, fresh.base_radius,
                  law::wetting::cap_base_radius(std::cbrt(6 / math::pi * volume), droplet.contact_angle)});
    both.record.merged = below.record.merged + fresh.weight / caps;
    both.record.initial = below.record.initial * below.solute / both.solute;
    double const rest = open[k].weight - caps;
    if (rest > 1e-12 * open[k].weight)
        open[k] = part_of(open[k], rest / open[k].weight), open.push_back(both);
    else
        open[k] = both;
}
}

void deposit(particle::Store& granules, std::size_t row, Deposits& deposits, Arrival const& droplet, Local const& local,
             double now)
{
    auto& open = deposits.on(granules.id[row]);
    double const speed = math::norm(droplet.velocity - granules.velocity[row]);
    law::impact::Impact const impact{droplet.density, droplet.viscosity, droplet.surface_tension,
                                     speed * std::sqrt(1 - droplet.sine * droplet.sine), droplet.diameter};
    Deposit fresh;
    fresh.weight = droplet.weight;
    fresh.water = fresh.water_at_impact = droplet.weight * droplet.water;
    fresh.solute = droplet.weight * droplet.solute;
    fresh.heat = droplet.heat;
    double const left = droplet.diameter * std::cbrt(1 - droplet.splashed);
    fresh.base_radius =
        droplet.dry ? 0.5 * droplet.diameter
                    : law::wetting::footprint_radius(left, droplet.contact_angle, impact.weber(), impact.reynolds());

    double const dry = granules.core_mass[row] + granules.layer_mass[row] + granules.solute[row];
    Event& record = fresh.record;
    record.t_deposit = now;
    record.x = droplet.position.x, record.y = droplet.position.y, record.z = droplet.position.z;
    record.droplet_diameter = droplet.diameter;
    record.moisture_at_impact = droplet.water / droplet.solute;
    record.droplet_temperature = droplet.temperature;
    record.age = droplet.age;
    record.path = droplet.path;
    record.normal_speed = impact.speed;
    record.tangential_speed = speed * droplet.sine;
    record.weber = impact.weber();
    record.reynolds = impact.reynolds();
    record.ohnesorge = impact.ohnesorge();
    record.mundo = impact.mundo();
    record.splashed = droplet.splashed;
    record.dry = droplet.dry;
    record.gas_temperature = local.gas_temperature;
    record.gas_humidity = local.gas_humidity;
    record.relative_humidity = material::relative_humidity(local.gas_temperature, local.gas_humidity, local.pressure);
    record.drying_potential = local.drying_potential;
    record.granule_temperature = granules.temperature[row];
    record.granule_moisture = granules.water[row] / dry;
    record.coverage = Drying::coverage(open, granules.count[row], granules.diameter[row]);
    record.solids_fraction = local.solids_fraction;
    record.slip = local.slip;

    double const added = fresh.water + fresh.solute;
    granules.velocity[row] =
        (granules.mass[row] * granules.velocity[row] + added * droplet.velocity) / (granules.mass[row] + added);
    granules.water[row] += fresh.water;
    granules.solute[row] += fresh.solute;
    granules.enthalpy[row] += droplet.enthalpy;
    if (droplet.draw < record.coverage)
        join(open, fresh, droplet.draw / record.coverage, droplet);
    else
        open.push_back(fresh);
    resize_granule(granules, row);
}
}
