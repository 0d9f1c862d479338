// What half spaces leave of a rectangle and of a box.
#pragma once

#include "granum/math/vec3.hpp"

#include <array>
#include <span>

namespace granum::geometry
{
using math::Vec3;

//! offset + slope_u u + slope_v v, with u and v counted from the middle of a rectangle.
struct Line
{
    double offset, slope_u, slope_v;
};

//! A part of a rectangle: its area and the first moments about the rectangle's middle.
struct PlanePart
{
    double area = 0, moment_u = 0, moment_v = 0;
};

//! Where every line (four at most) is above 0. Exact.
PlanePart rectangle_part(double half_u, double half_v, std::span<Line const> lines);

//! offset + slope . x, with x counted from the middle of a box. The slope is unit.
struct Linear
{
    double offset;
    Vec3 slope;

    double at(Vec3 const& x) const { return offset + dot(slope, x); }
};

//! A part of a box: its volume and the first moment about the box's middle.
struct SpacePart
{
    double volume = 0;
    Vec3 moment;

    SpacePart& operator+=(SpacePart const& other)
    {
        volume += other.volume;
        moment += other.moment;
        return *this;
    }
};

//! Where `plane` is above 0. Exact.
SpacePart box_part(Vec3 const& half, Linear const& plane);
//! Where both are above 0. Exact.
SpacePart box_part(Vec3 const& half, Linear const& one, Linear const& two);
}
