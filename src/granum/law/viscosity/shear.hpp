// What the laws of viscosity are given: how fast the fluid shears, and the numbers of the fluid.
#pragma once

#include <cmath>

namespace granum::law::viscosity
{
struct Shear
{
    double rate;          //!< sqrt(2 S:S) of the symmetric velocity gradient S, 1/s
    double at_rest;       //!< viscosity at vanishing rate, Pa s
    double infinite = 0;  //!< viscosity at infinite rate, Pa s
    double time = 0;      //!< of relaxation, s: its inverse is the rate at which thinning begins
    double exponent = 1;  //!< n of the power law between: stress ~ rate^n; 1 is Newtonian, below 1 thins
};
}
