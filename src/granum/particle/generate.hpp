// Initial packings: centres of spheres in a chamber, without overlaps.
#pragma once

#include "granum/geometry/chamber.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace granum::particle
{
//! `count` centres of spheres of `radius` (m) filled from the plate up: a hexagonal arrangement at 0.40 solids, each
//! sphere moved at random as far as its neighbours allow. A function of the seed. Throws NumericsError where the
//! chamber is too small.
std::vector<math::Vec3> random_loose(geometry::Chamber const& chamber, double radius, long count, std::uint32_t seed);

//! Hexagonal arrangement with `spacing` (m, at least two radii) between neighbours, each moved at random by up to
//! `noise` (0 to 1) of what its neighbours allow.
std::vector<math::Vec3> lattice(geometry::Chamber const& chamber, double radius, double spacing, long count,
                                double noise = 0, std::uint32_t seed = 0);

//! Where spheres may be placed.
struct Region
{
    math::Vec3 lower, upper;                                               //!< corners of a box around it, m
    std::function<bool(math::Vec3 const& centre, double radius)> allowed;  //!< clear of walls
};

//! Centres of spheres of these radii (m; any order, any ratio) that do not overlap: the largest first, each at a random
//! place of the lowest part of the region where all of them make 0.30 solids; that part grows where one finds no room.
//! A function of the seed. Throws NumericsError where the region is too small.
std::vector<math::Vec3> random_places(Region const& region, std::span<double const> radii, std::uint32_t seed);
}
