// What every drag law is given, and the limits within which it is evaluated.
//
// One convention for all laws: the drag proper on one sphere (model A, without the pressure gradient) is
//   3 pi mu d eps (u - v) F(phi, Re),   Re = rho eps |u - v| d / mu,   eps = 1 - phi,
// so F is the force over the Stokes force at the same superficial slip.
#pragma once

#include <algorithm>

namespace granum::law::drag
{
struct Flow
{
    double solid_fraction;  //!< phi, volume of granules over volume
    double reynolds;        //!< of the superficial slip

    //! phi within [0, 0.65]: a mapped packing may overshoot where no law was ever fitted.
    double phi() const { return std::clamp(solid_fraction, 0.0, 0.65); }
    double eps() const { return 1 - phi(); }
    double re() const { return std::max(reynolds, 0.0); }
};
}
