// Where a point lies seen from an axis: along it, away from it, and in which direction away.
#pragma once

#include "granum/math/vec3.hpp"

#include <cmath>

namespace granum::geometry
{
using math::Vec3;

//! Any unit vector across `n`: across the coordinate that n has least of.
inline Vec3 across(Vec3 const& n)
{
    double const x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    Vec3 const least = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    Vec3 const side = cross(n, least);
    return side / norm(side);
}

struct AroundAxis
{
    double along, away;  //!< m
    Vec3 outward;        //!< unit
};

//! `axis` is unit. A point of the axis itself is given any direction away from it.
inline AroundAxis around(Vec3 const& base, Vec3 const& axis, Vec3 const& x)
{
    Vec3 const apart = x - base;
    double const along = dot(apart, axis);
    Vec3 const radial = apart - along * axis;
    double const away = norm(radial);
    return {along, away, away > 0 ? radial / away : across(axis)};
}
}
