// The wall of a region as bodies that granules touch.
#pragma once

#include "granum/geometry/body.hpp"
#include "granum/geometry/region.hpp"

namespace granum::geometry
{
//! The surface of a solid as shapes, exact. `open_inside`: granules are in it, otherwise around it. Where they are in a
//! convex solid its shapes are one-sided, elsewhere thin.
std::vector<Shape> surface_shapes(Solid const& solid, bool open_inside);

//! One body of exact shapes for each solid that stands alone: that bounds everywhere and is farther than the resolution
//! (m) from all others. What is left is drawn as one mesh of triangles, named after its first solid (see triangulate).
std::vector<Body> wall_bodies(Region const& region, double resolution);
}
