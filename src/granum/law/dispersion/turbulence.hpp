// What the laws of turbulent dispersion are given, and what they remember of a droplet or granule.
#pragma once

#include "granum/math/vec3.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::law::dispersion
{
//! The gas's turbulence where the droplet is now.
struct Turbulence
{
    double energy;             //!< k, m2/s2
    double dissipation;        //!< epsilon, m2/s3
    math::Vec3 gradient = {};  //!< of k, m/s2
    double slip = 0;           //!< |u - v| of the mean gas against the droplet, m/s

    //! Standard deviation of each component of the gas's velocity, m/s.
    double deviation() const { return std::sqrt(2.0 / 3 * std::max(energy, 0.0)); }
    //! Gradient of the standard deviation, 1/s; nothing where there is no turbulence.
    math::Vec3 deviation_gradient() const
    {
        double const sigma = deviation();
        return sigma > 0 ? gradient / (3 * sigma) : math::Vec3{};
    }
    //! k / epsilon, s.
    double turnover() const
    {
        if (energy <= 0) return 0;
        return dissipation > 0 ? energy / dissipation : std::numeric_limits<double>::infinity();
    }
};

//! What one droplet carries on. All zeros at its birth, or standard normal numbers in `fluctuation`, which start
//! Langevin's law as if the droplet had been in the gas for long.
struct Eddy
{
    math::Vec3 fluctuation;  //!< u' over the standard deviation
    double left = 0;         //!< time that the present eddy has to live, s; of the random walk only
};
}
