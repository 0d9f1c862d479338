// The wall within a small box or rectangle as one plane, or as two: an edge, a thin sheet, a slot.
#pragma once

#include "granum/geometry/clip.hpp"
#include "granum/geometry/region.hpp"

#include <optional>
#include <span>

namespace granum::geometry
{
//! The distance at a place, which is counted from the middle of the box or rectangle.
struct Sample
{
    Vec3 at;          //!< m
    double distance;  //!< m
    Vec3 normal;

    Linear plane() const { return {distance - dot(normal, at), normal}; }
};

inline Sample sample(Region const& region, Vec3 const& middle, Vec3 const& at)
{
    auto const wall = region.at(middle + at);
    return {at, wall.distance, wall.normal};
}

struct WallModel
{
    enum class Kind
    {
        one,    //!< open where `first` is above 0
        both,   //!< where both are: a slot, or a corner that points away from the open
        either  //!< where one is: a sheet, or a corner that points into the open
    } kind = Kind::one;
    Linear first, second{};

    double at(Vec3 const& x) const
    {
        double const a = first.at(x);
        if (kind == Kind::one) return a;
        double const b = second.at(x);
        return kind == Kind::both ? std::min(a, b) : std::max(a, b);
    }
};

//! How well a model must meet the samples, m.
struct Tolerance
{
    double inside;   //!< those around the middle
    double corners;  //!< those in the corners, where only another wall is looked for
};

//! For a box whose shortest edge is `edge` (m).
inline Tolerance tolerance_for(double edge)
{
    return {6e-3 * edge, 0.04 * edge};
}

//! The model that all samples agree with, or nothing. The first sample is that of the middle, the others those of the
//! middles of its parts. The corners of the box (of the rectangle, where one half is 0) are looked at as well.
std::optional<WallModel> fit(Region const& region, Vec3 const& middle, Vec3 const& half,
                             std::span<Sample const> samples, Tolerance const& tolerance);
}
