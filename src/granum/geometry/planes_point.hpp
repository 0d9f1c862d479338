// The point where planes meet, as far as they decide it.
#pragma once

#include "granum/math/vec3.hpp"

#include <span>

namespace granum::geometry
{
using math::Vec3;

struct TangentPlane
{
    Vec3 point, normal;  //!< m, unit
};

//! The point of least squared distance to all planes that is nearest to `start`, moved from there in at most `most`
//! directions (3: a corner, 2: an edge, 1: a face). Directions in which the planes are less than about 25 degrees apart
//! do not count: there they are one curved surface.
Vec3 planes_point(std::span<TangentPlane const> planes, Vec3 const& start, int most);
}
