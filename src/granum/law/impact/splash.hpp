// The numbers that tell what a droplet does when it strikes a granule, and how much of it splashes off.
//
// Source of the limit: Mundo, Sommerfeld and Tropea, Int. J. Multiphase Flow 21 (1995) 151 (recalled, unverified). How
// much splashes off and into how many droplets varies widely; share and number are recalled, unverified defaults.
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

struct Splash
{
    double limit = 57.7;  //!< of K
    double least = 0.2,
           range = 0.6;   //!< share of the mass that splashes off: least + range times a uniform number; below 1
    double droplets = 4;  //!< into which it parts

    //! Share of the droplet's mass that splashes off, with `uniform` drawn from 0 to 1.
    double share(double mundo, double uniform) const { return mundo > limit ? least + range * uniform : 0; }
};
}
