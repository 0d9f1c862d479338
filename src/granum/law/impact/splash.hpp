// The numbers that tell what a droplet does when it strikes a granule, and the limit above which it splashes.
//
// Source of the limit: Mundo, Sommerfeld and Tropea, Int. J. Multiphase Flow 21 (1995) 151 (recalled, unverified).
#pragma once

#include <cmath>

namespace granum::law::impact
{
//! A droplet at the moment of impact.
struct Impact
{
    double density;          //!< kg/m3 of the liquid
    double viscosity;        //!< Pa s
    double surface_tension;  //!< N/m
    double speed;            //!< m/s normal to the surface
    double diameter;         //!< m

    double weber() const { return density * speed * speed * diameter / surface_tension; }
    double reynolds() const { return density * speed * diameter / viscosity; }
    double ohnesorge() const { return viscosity / std::sqrt(density * surface_tension * diameter); }
    //! K = Oh Re^1.25 = We^0.5 Re^0.25.
    double mundo() const { return std::sqrt(weber()) * std::pow(reynolds(), 0.25); }
};

inline constexpr double splash_limit = 57.7;  //!< of K

inline bool splashes(Impact const& impact)
{
    return impact.mundo() > splash_limit;
}
}
