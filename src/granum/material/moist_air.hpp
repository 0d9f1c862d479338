// Moist air as an ideal gas: equation of state, heat, transport properties, saturation (0 to 120 degC, near 1 bar).
//
// Two measures of humidity: Y, kg water per kg dry air, and w = Y / (1 + Y), kg water per kg moist air.
// Enthalpies are zero for dry air and liquid water at 0 degC. Transport fits are standard ones, recalled and
// unverified.
#pragma once

#include "granum/math/constants.hpp"

#include <cmath>

namespace granum::material
{
inline constexpr double molar_mass_air = 28.966e-3;       //!< kg/mol
inline constexpr double molar_mass_water = 18.015e-3;     //!< kg/mol
inline constexpr double molar_ratio = 0.621945;           //!< water over dry air
inline constexpr double heat_capacity_air = 1006;         //!< J/kg/K
inline constexpr double heat_capacity_vapour = 1860;      //!< J/kg/K
inline constexpr double heat_capacity_water = 4186;       //!< J/kg/K, liquid
inline constexpr double evaporation_enthalpy_0 = 2501e3;  //!< J/kg at 0 degC
inline constexpr double water_density = 998;              //!< kg/m3

inline double loading(double vapour_fraction)
{
    return vapour_fraction / (1 - vapour_fraction);
}
inline double fraction(double humidity)
{
    return humidity / (1 + humidity);
}

//! kg/mol of moist air.
inline double molar_mass(double vapour_fraction)
{
    return 1 / ((1 - vapour_fraction) / molar_mass_air + vapour_fraction / molar_mass_water);
}

//! kg/m3 at `pressure` Pa and `temperature` K.
inline double density(double pressure, double temperature, double vapour_fraction)
{
    return pressure * molar_mass(vapour_fraction) / (math::gas_constant * temperature);
}

//! J/kg/K of moist air.
inline double heat_capacity(double vapour_fraction)
{
    return (1 - vapour_fraction) * heat_capacity_air + vapour_fraction * heat_capacity_vapour;
}

//! J/kg of moist air.
inline double enthalpy(double temperature, double vapour_fraction)
{
    return heat_capacity(vapour_fraction) * (temperature - math::zero_celsius) +
           vapour_fraction * evaporation_enthalpy_0;
}

//! K of moist air with `enthalpy` J/kg.
inline double temperature(double enthalpy, double vapour_fraction)
{
    return math::zero_celsius + (enthalpy - vapour_fraction * evaporation_enthalpy_0) / heat_capacity(vapour_fraction);
}

//! J/kg of water vapour; of liquid water; heat of evaporation.
inline double vapour_enthalpy(double temperature)
{
    return evaporation_enthalpy_0 + heat_capacity_vapour * (temperature - math::zero_celsius);
}
inline double water_enthalpy(double temperature)
{
    return heat_capacity_water * (temperature - math::zero_celsius);
}
inline double evaporation_enthalpy(double temperature)
{
    return vapour_enthalpy(temperature) - water_enthalpy(temperature);
}

//! Pa s (Sutherland).
inline double viscosity(double temperature)
{
    return 1.458e-6 * temperature * std::sqrt(temperature) / (temperature + 110.4);
}
//! W/m/K.
inline double conductivity(double temperature)
{
    return 0.0241 + 7.2e-5 * (temperature - math::zero_celsius);
}
//! m2/s of water vapour in air.
inline double diffusivity(double temperature, double pressure)
{
    return 2.5e-5 * std::pow(temperature / 298.15, 1.81) * (math::standard_pressure / pressure);
}

//! Pa over water (273.16 to 473.15 K) or ice (173 to 273.16 K). Source: Hyland and Wexler, as in ASHRAE Fundamentals.
double saturation_pressure(double temperature);
//! Y of saturated air, kg/kg dry. Infinite where the saturation pressure reaches `pressure`.
double saturation_humidity(double temperature, double pressure);
//! Relative humidity of air with loading Y.
double relative_humidity(double temperature, double humidity, double pressure);
//! K at which air with loading Y > 0 begins to condense.
double dew_point(double humidity, double pressure);

//! Thermodynamic wet bulb (adiabatic saturation): temperature K and loading kg/kg dry.
struct WetBulb
{
    double temperature, humidity;
};
WetBulb wet_bulb(double temperature, double humidity, double pressure);
}
