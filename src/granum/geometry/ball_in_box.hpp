// How much of a ball lies in a box: for the share of a region that granules fill.
#pragma once

#include "granum/math/vec3.hpp"

namespace granum::geometry
{
//! Volume, m3, of the part of the ball of `radius` (m) about `centre` that lies in the box from `lower` to `upper` (m).
//! Exact where the ball is cut by faces of one direction, to 5e-5 of the ball where edges or corners cut it.
//! Archimedes' area of slices: a circle cut by a rectangle in closed form, integrated along z.
double ball_in_box(math::Vec3 const& centre, double radius, math::Vec3 const& lower, math::Vec3 const& upper);
}
