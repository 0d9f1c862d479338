// The population balance of granules that grow by a layer, are fed, born as nuclei, discharged and join each other:
//
//     dn/dt + d(G n)/dd = nuclei + feed - k(d) n + births and deaths by agglomeration
//
// Finite volumes with Koren's limiter, third order in time. Every granule grows alike (G = 2 V' / A, the layer in
// proportion to surface) or by a factor of its diameter; G is scaled so that the classes together gain exactly the
// volume that is sprayed. What two granules make together is shared by the two classes whose mean volumes lie around
// it, so that number and volume are right (fixed pivots). Sources: B. Koren, A robust upwind discretization method
// (1993, recalled); growth: Mörl, Heinrich and others; S. Kumar, D. Ramkrishna, Chem. Eng. Sci. 51 (1996) 1311
// (recalled).
#pragma once

#include "granum/population/classes.hpp"

#include <functional>

namespace granum::population
{
//! What the classes gain and lose; rates per second.
struct Rates
{
    double layer = 0;  //!< m3/s of layer that comes down on all granules, pores included
    //! G(d) over that of a layer in proportion to surface, 1: size does not matter.
    std::function<double(double)> growth = [](double) { return 1.0; };
    double nuclei = 0, nuclei_diameter = 0;  //!< 1/s, m
    double feed = 0, feed_diameter = 0;      //!< 1/s, m
    //! k(d), 1/s, with which a granule leaves.
    std::function<double(double)> discharge = [](double) { return 0.0; };
    //! Rate, 1/s, at which each pair of granules of these diameters becomes one; none: they stay apart.
    std::function<double(double, double)> agglomeration;
    double hold_up = 0;  //!< m3; above 0: discharge is scaled so that as much leaves as comes
};

//! What has passed meanwhile.
struct Passed
{
    double grown = 0, born = 0, fed = 0, discharged = 0;  //!< m3
    double number_discharged = 0;
};

//! Advances the classes by `dt`, in as many steps as the fastest growth asks for. Throws base::NumericsError where
//! granules grow beyond the last class or a number is not finite.
Passed advance(Classes& classes, Rates const& rates, double dt);

//! Growth of all by one speed G, m/s, so that the mean diameter rises by exactly G dt: for comparison with exact
//! answers.
void advance_by_speed(Classes& classes, double speed, double dt);
}
