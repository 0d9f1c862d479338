// What of an axis-aligned cell and of its faces is open in a region.
//
// A box is halved in all directions until the wall in it is one plane or two, as far as the distance at its middle, at
// the middles of its eight parts and in its corners tells; then the rest is exact. See doc/theory/geometry.md.
#pragma once

#include "granum/geometry/region.hpp"

namespace granum::geometry
{
struct OpenPart
{
    double volume = 0;  //!< m3
    Vec3 centroid;      //!< of the open part, m; the middle of the cell where nothing is open
};

//! Open volume of the box [low, high], m3.
double open_volume(Region const& region, Vec3 const& low, Vec3 const& high);
//! The same with its centroid.
OpenPart open_part(Region const& region, Vec3 const& low, Vec3 const& high);

//! The cells on both sides of a face: how far they reach from it along its normal, m; 0: there is none.
struct Beside
{
    double below = 0, above = 0;
};

//! Open area, m2, of the face of [low, high] with normal `direction`, at low[direction]. It depends on the face and on
//! the extents of the two cells only, so that both find the same.
//!
//! A face that lies on a wall is closed. With cells on both sides, a part of the face counts as closed unless a line
//! leads from the middle of the one cell through it to that of the other without leaving the region and the two cells:
//! walls thinner than a cell do not leak. With a cell on one side only, the face is an end of the grid: what is open
//! for that cell is open, also where a wall lies on the face itself, because a plate or an outlet may be there.
double open_area(Region const& region, int direction, Vec3 const& low, Vec3 const& high, Beside const& beside = {});
}
