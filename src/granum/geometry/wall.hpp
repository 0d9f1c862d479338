// Walls that granules touch: planes, cylinders and cones about the z axis.
#pragma once

#include "granum/geometry/shape.hpp"

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

namespace granum::geometry
{
using math::Vec3;

//! Inside of a body of revolution between two heights: a cylinder (equal radii) or a cone.
struct ConeWall
{
    double z0, r0, z1, r1;  //!< m, z0 < z1
};

using Surface = std::variant<Plane, ConeWall>;

struct Wall
{
    Surface surface;
    std::uint32_t material = 0;
};

struct Touch
{
    double distance;    //!< from the centre to the surface, m, positive inside
    Vec3 normal;        //!< unit, from the surface to the centre
    bool edge = false;  //!< the nearest point is an end of a section: a neighbouring section may be nearer
};

//! Nearest point of the wall to a sphere centre, if it lies within `reach`. The nearest point of a section is clamped
//! to its ends and then marked as an edge, so that whoever asks can drop it where the next section is touched as well.
//! A centre behind the wall has a negative distance and keeps the normal that points inside.
std::optional<Touch> touch(Surface const& surface, Vec3 const& centre, double reach);
}
