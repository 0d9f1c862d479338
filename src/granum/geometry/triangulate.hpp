// The wall of a region as a triangle mesh, for granules.
#pragma once

#include "granum/geometry/region.hpp"
#include "granum/geometry/shape.hpp"

namespace granum::geometry
{
//! Triangles of about `resolution` (m) over the whole boundary of the region, normals to the open. Edges and corners of
//! the wall are kept where its sides make more than about 25 degrees; corners of the mesh lie on the wall to 1e-3 of
//! the resolution. Every edge of the mesh belongs to as many triangles in one direction as in the other: it has no
//! hole.
//!
//! Dual contouring with one point for each piece of wall in a cube. Sources: Ju, Losasso, Schaefer and Warren, ACM
//! Trans. Graph. 21 (2002) 339; Nielson, IEEE Visualization 2004, 489 (both recalled).
//!
//! Throws base::CaseError for a region without bounds, and where a wall is thinner than the resolution: it would be
//! missed.
Mesh triangulate(Region const& region, double resolution);
}
