// The outline of a region in a cut across y, for pictures.
#pragma once

#include "granum/geometry/region.hpp"

#include <array>
#include <vector>

namespace granum::geometry
{
//! Pieces of the wall in the plane at `y` (m): two corners (x, z), m, then a pair that is no number, for each. A
//! horizontal line crosses them as often as it goes in and out of the open region. `squares` of them along the longer
//! side of the cut; of what is smaller than such a square the pieces may tell nothing.
std::vector<std::array<double, 2>> cut_outline(Region const& region, double y, int squares = 240);
}
