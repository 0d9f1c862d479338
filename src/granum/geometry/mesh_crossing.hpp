// Facets of a mesh that cross each other or lie on each other.
#pragma once

#include "granum/geometry/triangle_corners.hpp"

#include <cstddef>

namespace granum::geometry
{
struct FacetPairs
{
    std::size_t count = 0;
    std::size_t one = 0, other = 0;  //!< of the first pair
    Vec3 at;                         //!< where these two meet, m
};

struct Crossings
{
    FacetPairs crossing;    //!< each goes through the other
    FacetPairs on_another;  //!< in one plane with a part in common
};

//! Facets that only touch, in a corner or along an edge, do not count. `size` is that of the mesh, m: what is within
//! 1e-7 of it counts as touching. Pairs with equal corners are left out.
Crossings find_crossings(Corners const& corners, double size);
}
