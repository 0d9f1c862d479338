// Drops of water for tests of their drying.
#pragma once

#include "granum/material/moist_air.hpp"
#include "granum/math/constants.hpp"
#include "granum/spray/flight.hpp"

#include <cmath>

namespace granum::scene
{
//! Water, but for a trace of solids that gives a droplet an age to end at.
inline spray::FlightSettings water()
{
    spray::FlightSettings settings;
    settings.liquid.solids_fraction = 1e-9;
    settings.liquid.density = material::water_density;
    settings.gravity = {};
    return settings;
}

inline spray::Droplet drop_of(double diameter, double temperature, spray::FlightSettings const& settings)
{
    double const mass = settings.liquid.density * math::pi / 6 * std::pow(diameter, 3);
    double const solids = settings.liquid.solids_fraction;
    return {.weight = 1, .water = (1 - solids) * mass, .solute = solids * mass, .temperature = temperature};
}
}
