// Heat that a grey granule takes by radiation from what it sees around it. Below some 150 degC it is small beside the
// transfer to the gas.
#pragma once

namespace granum::law::heat
{
inline constexpr double stefan_boltzmann = 5.670374e-8;  //!< W/m2/K4

//! A heat flow that depends on the granule's temperature, as a line through the present one.
struct LinearHeat
{
    double heat;   //!< into the granule, W
    double slope;  //!< its change per kelvin of the granule, W/K
};

//! Temperature, K, that a granule sees in a bed: gas and neighbours by their shares of the volume. Source: Zhou, Yu,
//! Zulli, AIChE J. 55 (2009) 868 (recalled; the rule compared with MFIX).
inline double surroundings(double solid_fraction, double gas_temperature, double mean_granule_temperature)
{
    return (1 - solid_fraction) * gas_temperature + solid_fraction * mean_granule_temperature;
}

//! sigma e A (T_s^4 - T^4) for the emissivity e and the area A (m2) of real granules, and its derivative by T.
inline LinearHeat radiation(double emissivity, double area, double surroundings_temperature, double temperature)
{
    double const scale = stefan_boltzmann * emissivity * area;
    double const there2 = surroundings_temperature * surroundings_temperature, here2 = temperature * temperature;
    return {
        scale * (there2 + here2) * (surroundings_temperature + temperature) * (surroundings_temperature - temperature),
        -4 * scale * here2 * temperature};
}
}
