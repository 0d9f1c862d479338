#include "granum/geometry/body.hpp"

#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::geometry
{
using math::pi;

namespace
{
//! Of lengths compared with the distance of an axis, and of angles: what a drawing may be off by.
constexpr double drawn_off = 1e-9;

bool same_axis(Vec3 const& point, Vec3 const& axis, Rotation const& rotation)
{
    Vec3 const apart = point - rotation.point;
    Vec3 const off = apart - dot(apart, rotation.axis) * rotation.axis;
    return norm(cross(axis, rotation.axis)) < drawn_off && norm(off) <= drawn_off * (1 + norm(point));
}

bool unmoved_one(Plane const& plane, Rotation const& rotation)
{
    return norm(cross(plane.normal, rotation.axis)) < drawn_off;
}
bool unmoved_one(Frustum const& frustum, Rotation const& rotation)
{
    return same_axis(frustum.base, frustum.axis, rotation);
}
bool unmoved_one(Disc const& disc, Rotation const& rotation)
{
    return same_axis(disc.centre, disc.normal, rotation);
}
bool unmoved_one(Sphere const& sphere, Rotation const& rotation)
{
    return same_axis(sphere.centre, rotation.axis, rotation);
}
bool unmoved_one(Mesh const&, Rotation const&)
{
    return false;
}

std::optional<double> facing(Plane const&, Vec3 const&)
{
    return std::nullopt;
}
std::optional<double> facing(Frustum const&, Vec3 const&)
{
    return std::nullopt;
}
std::optional<double> facing(Disc const& disc, Vec3 const& direction)
{
    return pi * (disc.radius * disc.radius - disc.hole * disc.hole) * std::abs(dot(disc.normal, direction));
}
std::optional<double> facing(Sphere const& sphere, Vec3 const&)
{
    return pi * sphere.radius * sphere.radius;
}
std::optional<double> facing(Mesh const& mesh, Vec3 const& direction)
{
    double along = 0, against = 0;
    for (auto const& [a, b, c] : mesh.triangles) {
        double const area = 0.5 * dot(cross(b - a, c - a), direction);
        (area > 0 ? along : against) += std::abs(area);
    }
    return std::max(along, against);
}

void widen_by(Bounds& box, Plane const&)
{
    constexpr double far = std::numeric_limits<double>::infinity();
    box.widen({-far, -far, -far}, {far, far, far});
}
void widen_by(Bounds& box, Frustum const& frustum)
{
    box.widen_by_circle(frustum.base, frustum.axis, frustum.base_radius);
    box.widen_by_circle(frustum.base + frustum.length * frustum.axis, frustum.axis, frustum.top_radius);
}
void widen_by(Bounds& box, Disc const& disc)
{
    box.widen_by_circle(disc.centre, disc.normal, disc.radius);
}
void widen_by(Bounds& box, Sphere const& sphere)
{
    Vec3 const half{sphere.radius, sphere.radius, sphere.radius};
    box.widen(sphere.centre - half, sphere.centre + half);
}
void widen_by(Bounds& box, Mesh const& mesh)
{
    for (auto const& triangle : mesh.triangles)
        for (auto const& corner : triangle) box.widen(corner);
}
}

bool unmoved(Shape const& shape, Rotation const& rotation)
{
    return std::visit([&](auto const& one) { return unmoved_one(one, rotation); }, shape);
}

std::size_t rotations_in_place(Body const& body)
{
    std::size_t count = 0;
    for (; count < body.motions.size(); ++count) {
        auto const* rotation = std::get_if<Rotation>(&body.motions[count]);
        if (rotation == nullptr) break;
        if (!std::all_of(body.shapes.begin(), body.shapes.end(),
                         [&](Shape const& shape) { return unmoved(shape, *rotation); }))
            break;
    }
    return count;
}

std::optional<double> facing_area(Body const& body, Vec3 const& direction)
{
    double sum = 0;
    for (auto const& shape : body.shapes) {
        auto const area = std::visit([&](auto const& one) { return facing(one, direction); }, shape);
        if (!area) return std::nullopt;
        sum += *area;
    }
    return sum;
}

Bounds bounds(Body const& body)
{
    Bounds box;
    for (auto const& shape : body.shapes) std::visit([&](auto const& one) { widen_by(box, one); }, shape);
    return box;
}
}
