// How far a point is from the surface of a solid, and the way there.
#pragma once

#include "granum/math/vec3.hpp"

namespace granum::geometry
{
using math::Vec3;

struct SurfaceDistance
{
    double distance;  //!< m, negative inside the solid
    Vec3 normal;      //!< unit, the direction in which the distance grows fastest; on the surface it points outside
};
}
