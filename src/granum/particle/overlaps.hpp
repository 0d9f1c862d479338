// Overlaps of spheres as they were placed: whether a start is one that contacts can bear.
#pragma once

#include "granum/math/vec3.hpp"

#include <span>

namespace granum::particle
{
struct Overlaps
{
    long pairs = 0;                     //!< that overlap
    double deepest = 0;                 //!< overlap over the radius of the smaller partner
    std::size_t first = 0, second = 0;  //!< of the deepest pair
};

//! Walks all pairs of neighbours in a grid as wide as the largest sphere. Periodic images are not looked at.
//! @param centres m
//! @param radii m, one for each centre
Overlaps overlaps(std::span<math::Vec3 const> centres, std::span<double const> radii);
}
