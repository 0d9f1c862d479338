// The axis-aligned box around something.
#pragma once

#include "granum/math/vec3.hpp"

#include <limits>

namespace granum::geometry
{
using math::Vec3;

//! Corners, m; infinite where what it holds is. As made it is empty and holds nothing.
struct Bounds
{
    static constexpr double big = std::numeric_limits<double>::max();
    Vec3 lower{big, big, big}, upper{-big, -big, -big};

    void widen(Vec3 const& low, Vec3 const& high);
    void widen(Vec3 const& point) { widen(point, point); }
    //! By the circle of `radius` about `centre` across `normal` (unit).
    void widen_by_circle(Vec3 const& centre, Vec3 const& normal, double radius);
    double size() const;                    //!< length of the diagonal, m
    double distance(Vec3 const& x) const;   //!< 0 inside, m
    bool holds(Bounds const& other) const;  //!< all of the other box
};

Bounds overlap(Bounds const& a, Bounds const& b);
}
