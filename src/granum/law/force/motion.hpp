// What the laws of lift and of rotational drag are given: one granule in the gas around it.
#pragma once

#include "granum/math/vec3.hpp"

namespace granum::law::force
{
struct Motion
{
    math::Vec3 slip;       //!< u - v, of the gas between the granules (not superficial) against the granule, m/s
    math::Vec3 vorticity;  //!< curl of u, 1/s
    math::Vec3 spin;       //!< of the granule, rad/s
    double diameter;       //!< of the real granule, m
    double density;        //!< of the gas, kg/m3
    double viscosity;      //!< of the gas, Pa s

    //! How much faster the gas turns than the granule, rad/s.
    math::Vec3 spin_lag() const { return 0.5 * vorticity - spin; }
    //! Reynolds number of the slip.
    double reynolds() const { return density * math::norm(slip) * diameter / viscosity; }
    //! Reynolds number of a rate of turning (1/s).
    double turning_reynolds(double rate) const { return density * rate * diameter * diameter / viscosity; }
};
}
