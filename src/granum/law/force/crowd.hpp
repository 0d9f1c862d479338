// What the laws of virtual mass are given.
//
// They return C of the force C rho V (Du/Dt - dv/dt) on a granule of volume V. The part with dv/dt is moved to the
// other side of its equation of motion: it then accelerates as if its mass were m + C rho V.
#pragma once

#include <algorithm>

namespace granum::law::force
{
struct Crowd
{
    double solid_fraction;  //!< volume of granules over volume

    //! phi within [0, 0.65]: a mapped packing may overshoot where no law was ever meant to hold.
    double phi() const { return std::clamp(solid_fraction, 0.0, 0.65); }
};
}
