// Turbulence as a row of eddies, each with one velocity for its life.
//
// Droplets gather where k is small, whatever the true flow does: a law for homogeneous turbulence, or for droplets that
// do not follow the gas. The velocity of an eddy scales with the local k, so that none is carried into gas that is at
// rest.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/dispersion/turbulence.hpp"

namespace granum::law::dispersion
{
//! Each component of u' is drawn from a normal distribution of variance 2k/3 and kept for the eddy's time,
//! min(k / epsilon, 0.09^(3/4) k^(3/2) / (epsilon |u - v|)), rounded to whole steps.
struct DiscreteWalk
{
    static constexpr base::Card card{.name = "discrete-walk",
                                     .title = "Discrete random walk",
                                     .source =
                                         "Gosman, Ioannides, J. Energy 7 (1983) 482 (recalled; the eddy's time "
                                         "compared with OpenFOAM, which draws one "
                                         "magnitude in a random direction instead)",
                                     .valid = "homogeneous turbulence; steps shorter than the eddy's time"};

    //! The life of an eddy, s.
    static double eddy_time(Turbulence const& gas)
    {
        double const turnover = gas.turnover();
        // Time to cross the eddy, 0.1643 k^1.5 / (epsilon |u - v|), against its turnover: the shorter one.
        double const crossing = 0.16431676725154984 * std::sqrt(std::max(gas.energy, 0.0));
        return gas.slip > crossing ? turnover * crossing / gas.slip : turnover;
    }

    //! u' of the gas that the droplet sees for the coming `step` s, m/s. `normals` are three independent standard
    //! normal numbers, used where a new eddy begins.
    math::Vec3 operator()(Eddy& eddy, Turbulence const& gas, double step, math::Vec3 const& normals) const
    {
        if (eddy.left < 0.5 * step) eddy = {normals, eddy_time(gas)};
        eddy.left -= step;
        return gas.deviation() * eddy.fluctuation;
    }
};
}
