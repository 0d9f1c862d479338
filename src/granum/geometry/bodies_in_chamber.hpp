// Chambers of solids, and chambers in which bodies stand.
#pragma once

#include "granum/geometry/chamber.hpp"
#include "granum/geometry/region.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace granum::geometry
{
//! The chamber that is open where the region is, plate and outlet at its lowest and highest places. The region must
//! have bounds.
Chamber chamber_of(Region region);

//! The chamber without what the bodies fill. Their numbers in its region follow those of what was there; in a box or a
//! body of revolution the chamber itself is number 0.
Chamber with_bodies(Chamber chamber, std::vector<Region> const& bodies);

//! How deep a place lies in a body, m, below 0 outside; at most the true distance in magnitude.
using Depth = std::function<double(Vec3 const&)>;

//! A place that is deeper than `least` (m) in both bodies, looked for in the box of the bounds; nothing where there is
//! none, or where it is so narrow that some ten thousand looks do not show it.
std::optional<Vec3> common_place(Depth const& one, Depth const& other, Bounds const& box, double least);
}
