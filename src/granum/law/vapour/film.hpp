// The thin film of air through which water leaves a wet surface, with its properties by the one-third rule.
//
// Droplets in flight and deposits on granules dry through the same film; the rule weights the state at the surface with
// two thirds and that of the gas with one third (Hubbard, Denny and Mills 1975, recalled).
#pragma once

#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::vapour
{
struct Film
{
    double density;           //!< kg/m3 of the air in the film
    double diffusivity;       //!< m2/s of vapour in the film
    double surface_fraction;  //!< kg vapour per kg moist air at the surface
    double gas_fraction;      //!< the same far from it
    double temperature;       //!< K of the film
    double vapour_fraction;   //!< kg/kg in the film

    //! Stefan's driving force ln((1 - w_gas) / (1 - w_surface)): positive where water leaves.
    double driving() const { return std::log1p(-gas_fraction) - std::log1p(-surface_fraction); }
};

//! kg vapour per kg moist air of a molar fraction, held at 0.999, where the driving force is large but finite.
inline double mass_fraction(double molar_fraction)
{
    double const molar = std::min(molar_fraction, 0.999);
    double const water = molar * material::molar_mass_water;
    return water / (water + (1 - molar) * material::molar_mass_air);
}

//! kg vapour per kg moist air over a liquid of `water_activity` at `temperature` K.
inline double surface_fraction(double temperature, double water_activity, double pressure)
{
    return mass_fraction(water_activity * material::saturation_pressure(temperature) / pressure);
}

//! Film between a surface at `surface_temperature` K and air at `air_temperature` K with `vapour_fraction` kg/kg.
inline Film film(double surface_temperature, double water_activity, double air_temperature, double vapour_fraction,
                 double pressure)
{
    double const surface = surface_fraction(surface_temperature, water_activity, pressure);
    double const temperature = surface_temperature + (air_temperature - surface_temperature) / 3;
    double const between = surface + (vapour_fraction - surface) / 3;
    return {material::density(pressure, temperature, between),
            material::diffusivity(temperature, pressure),
            surface,
            vapour_fraction,
            temperature,
            between};
}
}
