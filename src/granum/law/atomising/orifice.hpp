// Compressed air through the mouth of a two-fluid nozzle: isentropic up to the narrowest place, where it is no faster
// than sound, and from there to the pressure of the chamber.
//
// Textbook gas dynamics of an ideal gas of constant heat capacity. Of what goes on behind a choked mouth only the
// momentum is kept: mass flow times the velocity there and the pressure that is left times its area.
#pragma once

#include "granum/math/constants.hpp"

#include <cmath>

namespace granum::law::atomising
{
struct Orifice
{
    double pressure;                               //!< Pa, absolute, of the air at rest before the mouth
    double temperature;                            //!< K, of the air at rest
    double ambient;                                //!< Pa, absolute, behind the mouth; below `pressure`
    double area;                                   //!< m2 of the mouth
    double discharge = 0.8;                        //!< share of the area that the stream fills (recalled)
    double exponent = 1.4, gas_constant = 287.05;  //!< of air: ratio of heat capacities; J/kg/K

    //! Pressure at the mouth over that before it at which the air is as fast as sound: 0.5283 for air.
    double critical_ratio() const { return std::pow(2 / (exponent + 1), exponent / (exponent - 1)); }
    bool choked() const { return ambient < critical_ratio() * pressure; }
    double mouth_pressure() const { return choked() ? critical_ratio() * pressure : ambient; }  //!< Pa

    //! Mach number at the mouth, 1 where it is choked.
    double mach() const
    {
        if (choked()) return 1;
        return std::sqrt(2 / (exponent - 1) * (std::pow(pressure / ambient, (exponent - 1) / exponent) - 1));
    }
    double mouth_temperature() const { return temperature / (1 + 0.5 * (exponent - 1) * mach() * mach()); }  //!< K
    //! m/s at the mouth.
    double velocity() const { return mach() * std::sqrt(exponent * gas_constant * mouth_temperature()); }
    //! kg/s.
    double mass_flow() const
    {
        return discharge * area * velocity() * mouth_pressure() / (gas_constant * mouth_temperature());
    }
    //! N: momentum of the jet once it is at the pressure of the chamber.
    double thrust() const { return mass_flow() * velocity() + (mouth_pressure() - ambient) * discharge * area; }
};
}
