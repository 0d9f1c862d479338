// What every law of heat and mass transfer between granules and gas is given.
//
// The laws return the Nusselt number h d / k. With the Schmidt number in the place of the Prandtl number the same laws
// give the Sherwood number k_c d / D.
#pragma once

#include <algorithm>
#include <cmath>

namespace granum::law::heat
{
struct Flow
{
    double solid_fraction;  //!< volume of granules over volume
    double reynolds;        //!< of the superficial slip
    double prandtl;         //!< or the Schmidt number

    //! Voidage within [0.35, 1]: a mapped packing may overshoot where no law was ever fitted.
    double eps() const { return 1 - std::clamp(solid_fraction, 0.0, 0.65); }
    double re() const { return std::max(reynolds, 0.0); }
};
}
