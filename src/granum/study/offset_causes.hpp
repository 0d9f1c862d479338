// What offsets between a plant and its simulation mean, by the balances of water and enthalpy.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace granum::study
{
//! Ours less the plant's, where it does not agree; nothing where it does or was not logged.
struct Offsets
{
    std::optional<double> inlet_temperature, spray_rate;  //!< K, kg/s: what the case was told
    std::optional<double> outlet_temperature, outlet_humidity, bed_temperature, pressure_drop, bed_moisture;
};

//! What the run knows of its own steady state.
struct RunState
{
    double dry_flow = 0;             //!< kg/s of dry gas
    double temperature = 0;          //!< K of the run's outlet, steady
    double humidity = 0;             //!< kg/kg there
    double area = 0;                 //!< m2: weight of the bed over its pressure
    bool water_accumulates = false;  //!< the run's bed still becomes wetter
};

//! Sentences, the most certain first. Empty where all offsets are.
std::vector<std::string> likely_causes(Offsets const& offsets, RunState const& run);
}
