#include "granum/study/offset_causes.hpp"

#include "granum/material/moist_air.hpp"
#include "granum/math/constants.hpp"

#include <fmt/format.h>

#include <cmath>

namespace granum::study
{
namespace
{
namespace air = material;

//! Enthalpy of moist air per dry air, J/kg.
double per_dry(double temperature, double humidity)
{
    return air::enthalpy(temperature, humidity / (1 + humidity)) * (1 + humidity);
}

char const* more(double difference)
{
    return difference > 0 ? "more" : "less";
}
}

std::vector<std::string> likely_causes(Offsets const& o, RunState const& run)
{
    std::vector<std::string> out;
    if (o.inlet_temperature)
        out.push_back(fmt::format(
            "The case lets air in that is {:.2g} K {} than the plant's: set gas.temperature to what was logged before "
            "reading anything else.",
            std::abs(*o.inlet_temperature), *o.inlet_temperature > 0 ? "warmer" : "colder"));
    if (o.spray_rate)
        out.push_back(fmt::format("The case sprays {:.2g} g/min {} than the plant: set spray.rate to what was logged.",
                                  6e4 * std::abs(*o.spray_rate), more(*o.spray_rate)));
    if (o.outlet_humidity) {
        double const water = run.dry_flow * *o.outlet_humidity;
        out.push_back(fmt::format(
            "{:.3g} g/min {} water leaves with the run's air. {}", 6e4 * std::abs(water), more(water),
            water > 0 ? "In the plant less is sprayed than its pump says, water stays in the bed or on filters, or air "
                        "that was not counted dilutes the outlet (more flow than stated, leaks at the filter)."
            : run.water_accumulates
                ? "The run's bed still becomes wetter: let it run longer."
                : "In the plant more water evaporates than the case sprays: pump rate, solids of the "
                  "liquid, humidity of the inlet air, or less flow of air than stated."));
    }
    if (o.outlet_temperature && run.dry_flow > 0) {
        double const humidity = run.humidity - o.outlet_humidity.value_or(0);
        double const plant = run.temperature - *o.outlet_temperature;
        // What the plant's water takes is no loss: only enthalpy that is missing is.
        double const heat = run.dry_flow * (per_dry(run.temperature, run.humidity) - per_dry(plant, humidity));
        double const water = o.outlet_humidity.value_or(0) * run.dry_flow;
        if (heat > 0)
            out.push_back(
                fmt::format("The plant's air leaves with {:.3g} W less enthalpy{}: heat lost through walls and piping. "
                            "gas.heat_loss lets the run lose it: {:.2g} W/K, with surroundings of 20 degC, over the "
                            "area of the walls.",
                            heat, water != 0 ? " (water taken into account)" : "",
                            heat / std::max(1.0, run.temperature - (math::zero_celsius + 20))));
        else
            out.push_back(fmt::format(
                "The plant's air leaves with {:.3g} W more enthalpy than the run's: a warmer or larger flow of air "
                "than "
                "stated, less or warmer atomising air, less spray, or a heat loss in the case that the plant does not "
                "have.",
                -heat));
    } else if (o.bed_temperature) {
        out.push_back(
            "Bed and outlet differ: the plant's product sensor may stand in the spray, lean on a cold wall or lose "
            "heat "
            "along its stem; in the run the outlet lags the bed by the time the freeboard needs to be flushed.");
    }
    if (o.pressure_drop)
        out.push_back(fmt::format(
            "The run's bed costs {:.3g} Pa {} pressure: {:.2g} kg of granules. {}", std::abs(*o.pressure_drop),
            more(*o.pressure_drop), std::abs(*o.pressure_drop) * run.area / 9.81,
            *o.pressure_drop < 0 ? "The plant's reading may hold the plate and filters too: take off what it shows for "
                                   "the empty chamber."
                                 : "Granules may cling to the filter or lie in dead corners, or the plant's bed is "
                                   "lighter than the case's."));
    if (o.bed_moisture)
        out.push_back(
            "Moisture differs: the run counts liquid in deposits that have not dried; a laboratory's loss on drying "
            "counts water within cores and crystals too.");
    return out;
}
}
