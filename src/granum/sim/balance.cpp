#include "granum/sim/balance.hpp"

#include "granum/base/error.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/sim/opening_area.hpp"

#include <algorithm>

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

//! `solids`, J/K per kg of dry air: heat capacity of what leaves with the air's temperature beside it.
double temperature_of(double enthalpy, double humidity, double solids = 0)
{
    return math::zero_celsius + (enthalpy - humidity * material::evaporation_enthalpy_0) /
                                    (material::heat_capacity_air + humidity * material::heat_capacity_vapour + solids);
}
}

double open_area(Case const& data, OpeningCase const& opening)
{
    if (opening.round) return math::pi * (opening.outer * opening.outer - opening.inner * opening.inner);
    auto const& chamber = data.chamber;
    std::size_t const e = (opening.direction + 1) % 3, f = (opening.direction + 2) % 3;
    Vec3 low = chamber.lower(), high = chamber.upper();
    if (!opening.rectangle && opening.direction == 2)
        return chamber.area(opening.upper ? chamber.top() : chamber.bottom());
    if (!opening.rectangle && chamber.region) return opening_area(data, opening).free;
    if (opening.rectangle)
        for (std::size_t const d : {e, f}) {
            low[d] = std::max(low[d], opening.rectangle->lower[d]);
            high[d] = std::min(high[d], opening.rectangle->upper[d]);
        }
    return std::max(0.0, high[e] - low[e]) * std::max(0.0, high[f] - low[f]);
}

double moist_mass_flow(Case const& data, InletCase const& inlet)
{
    if (inlet.velocity <= 0) return inlet.dry_mass_flow * (1 + inlet.humidity);
    auto const& gas = data.gas;
    double const vapour = material::fraction(inlet.humidity);
    double const carrier = gas.molar_mass.value_or(material::molar_mass_air);
    double const water = gas.vapour_molar_mass.value_or(material::molar_mass_water);
    double const tracer = gas.tracer ? gas.tracer->molar_mass.value_or(carrier) : carrier;
    double const moles = (1 - vapour - inlet.tracer) / carrier + vapour / water + inlet.tracer / tracer;
    double const density = gas.density.value_or(gas.pressure / (math::gas_constant * inlet.temperature * moles));
    return density * inlet.velocity * open_area(data, inlet.at);
}

double dry_inlet_flow(Case const& data)
{
    double sum = 0;
    for (auto const& inlet : data.gas.inlets) sum += moist_mass_flow(data, inlet) / (1 + inlet.humidity);
    return sum;
}

Balance balance(Case const& data)
{
    double dry = 0, humidity = 0, heat = 0;
    for (auto const& inlet : data.gas.inlets) {
        double const flow = moist_mass_flow(data, inlet) / (1 + inlet.humidity);
        dry += flow;
        humidity += flow * inlet.humidity;
        heat += flow * enthalpy_per_dry(inlet.temperature, inlet.humidity);
    }
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
    double feed = out.water_rate / dry * material::water_enthalpy(data.spray.temperature), solids = 0;
    if (auto const& spray = data.spray; spray.melting_point > 0) {
        // All of a melt stays, as solid as warm as the bed.
        solids = spray.rate / dry * data.granules.heat_capacity;
        feed += solids * (spray.temperature - math::zero_celsius) + spray.rate / dry * spray.fusion_heat;
    }
    out.outlet_temperature = temperature_of(heat / dry + feed, out.outlet_humidity, solids);
    out.outlet_relative_humidity =
        material::relative_humidity(out.outlet_temperature, out.outlet_humidity, data.gas.pressure);
    double const capacity = wet.humidity - out.inlet_humidity;
    out.eta = capacity > 0 ? (wet.humidity - out.outlet_humidity) / capacity : 0;
    return out;
}
}
