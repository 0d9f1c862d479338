#include "granum/sim/balance.hpp"

#include "granum/base/error.hpp"
#include "granum/material/moist_air.hpp"

namespace granum::sim
{
namespace
{
//! J per kg of dry air with its vapour.
double enthalpy_per_dry(double temperature, double humidity)
{
    return material::heat_capacity_air * (temperature - math::zero_celsius) +
           humidity * material::vapour_enthalpy(temperature);
}

double temperature_of(double enthalpy, double humidity)
{
    return math::zero_celsius + (enthalpy - humidity * material::evaporation_enthalpy_0) /
                                    (material::heat_capacity_air + humidity * material::heat_capacity_vapour);
}
}

double dry_inlet_flow(Case const& data)
{
    InletCase const& inlet = data.gas.inlet;
    if (inlet.dry_mass_flow > 0 || inlet.velocity <= 0) return inlet.dry_mass_flow;
    double const vapour = material::fraction(inlet.humidity);
    double const density = data.gas.density.value_or(material::density(data.gas.pressure, inlet.temperature, vapour));
    return density * (1 - vapour) * inlet.velocity * data.chamber.area(0);
}

Balance balance(Case const& data)
{
    double dry = dry_inlet_flow(data);
    double humidity = dry * data.gas.inlet.humidity;
    double heat = dry * enthalpy_per_dry(data.gas.inlet.temperature, data.gas.inlet.humidity);
    for (auto const& nozzle : data.spray.nozzles) {
        dry += nozzle.air_mass_flow;
        humidity += nozzle.air_mass_flow * nozzle.air_humidity;
        heat += nozzle.air_mass_flow * enthalpy_per_dry(nozzle.air_temperature, nozzle.air_humidity);
    }
    base::require(dry > 0, "a balance needs air: no dry air flows into the apparatus");

    Balance out;
    out.dry_mass_flow = dry;
    out.water_rate = data.spray.present ? data.spray.rate * (1 - data.spray.solids_fraction) : 0;
    out.inlet_humidity = humidity / dry;
    out.inlet_temperature = temperature_of(heat / dry, out.inlet_humidity);
    auto const wet = material::wet_bulb(out.inlet_temperature, out.inlet_humidity, data.gas.pressure);
    out.wet_bulb = wet.temperature;
    out.wet_bulb_humidity = wet.humidity;
    out.outlet_humidity = out.inlet_humidity + out.water_rate / dry;
    double const feed = out.water_rate / dry * material::water_enthalpy(data.spray.temperature);
    out.outlet_temperature = temperature_of(heat / dry + feed, out.outlet_humidity);
    out.outlet_relative_humidity =
        material::relative_humidity(out.outlet_temperature, out.outlet_humidity, data.gas.pressure);
    double const capacity = wet.humidity - out.inlet_humidity;
    out.eta = capacity > 0 ? (wet.humidity - out.outlet_humidity) / capacity : 0;
    return out;
}
}
