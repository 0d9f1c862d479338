// Initial packings: centres of equal spheres in a chamber, without overlaps.
#pragma once

#include "granum/geometry/chamber.hpp"

#include <cstdint>
#include <vector>

namespace granum::particle
{
//! `count` centres of spheres of `radius` (m) filled from the plate up: a hexagonal arrangement at 0.40 solids, each
//! sphere moved at random as far as its neighbours allow. A function of the seed. Throws NumericsError where the
//! chamber is too small.
std::vector<math::Vec3> random_loose(geometry::Chamber const& chamber, double radius, long count, std::uint32_t seed);

//! As above without disorder: hexagonal arrangement with `spacing` (m, at least two radii) between neighbours.
std::vector<math::Vec3> lattice(geometry::Chamber const& chamber, double radius, double spacing, long count);
}
