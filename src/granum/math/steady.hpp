// When a series that settles has settled, and how well its mean is known from then on.
#pragma once

#include <cstddef>
#include <span>

namespace granum::math
{
struct Steady
{
    std::size_t start = 0;  //!< first value of the steady part
    double mean = 0;        //!< from there on
    double error = 0;       //!< standard error of that mean, correlation from value to value included
    bool settled = false;   //!< the steady part begins before the middle of the series
};

//! The steady part: what is left out is chosen so that the mean of the rest is known best (marginal standard error
//! rule; White, Simulation 69 (1997) 323, recalled), at most half. Fewer than 8 values: nothing is left out and nothing
//! has settled.
Steady steady_part(std::span<double const> series);

//! Standard error of the mean of a correlated series, from means of blocks of the smallest size b with b^3 > 2 n
//! (error(b) / error(1))^4 (recalled: Lee et al., Phys. Rev. E 83 (2011) 066706); where there is none, of the largest
//! that leaves 8 blocks. 0 for fewer than two values.
double error_of_mean(std::span<double const> series);
}
