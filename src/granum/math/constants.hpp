// Numbers of nature that more than one room needs.
#pragma once

namespace granum::math
{
inline constexpr double pi = 3.14159265358979323846;
inline constexpr double standard_gravity = 9.81;       //!< m/s2; the default of a case, which may override it
inline constexpr double zero_celsius = 273.15;         //!< K
inline constexpr double standard_pressure = 101325.0;  //!< Pa
inline constexpr double gas_constant = 8.314462618;    //!< J/mol/K
}
