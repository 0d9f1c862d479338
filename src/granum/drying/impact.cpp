#include "granum/drying/impact.hpp"

#include "granum/drying/drying.hpp"
#include "granum/law/impact/splash.hpp"
#include "granum/law/wetting/footprint.hpp"
#include "granum/material/moist_air.hpp"

namespace granum::drying
{
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
    fresh.base_radius = droplet.crust ? 0.5 * droplet.diameter
                                      : law::wetting::footprint_radius(droplet.diameter, droplet.contact_angle,
                                                                       impact.weber(), impact.reynolds());

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
    record.crust = droplet.crust;
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
    open.push_back(fresh);
    resize_granule(granules, row);
}
}
