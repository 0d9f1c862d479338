#include "granum/geometry/shape.hpp"

#include "granum/geometry/axis.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
//! Nearest to a point, or to a point of an edge; `otherwise` is the normal where the centre is that very point.
Nearest nearest_point(Vec3 const& point, Vec3 const& centre, Vec3 const& otherwise, Feature feature)
{
    Vec3 const apart = centre - point;
    double const distance = norm(apart);
    return {point, distance > 0 ? apart / distance : otherwise, distance, feature};
}
}

std::vector<Shape> box_inside(Vec3 const& lower, Vec3 const& upper)
{
    std::vector<Shape> out;
    for (std::size_t d = 0; d < 3; ++d) {
        Vec3 normal;
        normal[d] = 1;
        out.push_back(Plane{lower, normal});
        out.push_back(Plane{upper, -normal});
    }
    return out;
}

Nearest nearest(Plane const& plane, Vec3 const& centre)
{
    double const distance = dot(centre - plane.point, plane.normal);
    return {centre - distance * plane.normal, plane.normal, distance, Feature::face};
}

Nearest nearest(Frustum const& frustum, Vec3 const& centre)
{
    // In the half plane through the axis and the centre the flank is a straight segment.
    auto const [along, away, outward] = around(frustum.base, frustum.axis, centre);
    double const rise = frustum.length, spread = frustum.top_radius - frustum.base_radius;
    double const length = std::sqrt(rise * rise + spread * spread);
    double const on = (along * rise + (away - frustum.base_radius) * spread) / length;  // m along the segment
    if (on >= 0 && on <= length) {
        Vec3 inward = (-rise / length) * outward + (spread / length) * frustum.axis;
        double distance = (along * spread - (away - frustum.base_radius) * rise) / length;
        bool const turn = frustum.side == Side::outside || (frustum.side == Side::both && distance < 0);
        if (turn) inward = -inward, distance = -distance;
        return {centre - distance * inward, inward, distance, Feature::face};
    }
    double const end = on < 0 ? 0 : rise, radius = on < 0 ? frustum.base_radius : frustum.top_radius;
    return nearest_point(frustum.base + end * frustum.axis + radius * outward, centre, -outward,
                         radius > 0 ? Feature::edge : Feature::vertex);
}

Nearest nearest(Disc const& disc, Vec3 const& centre)
{
    auto const [along, away, outward] = around(disc.centre, disc.normal, centre);
    if (away <= disc.radius && away >= disc.hole) {
        Vec3 const normal = along < 0 ? -disc.normal : disc.normal;
        return {centre - along * disc.normal, normal, std::abs(along), Feature::face};
    }
    double const radius = away > disc.radius ? disc.radius : disc.hole;
    return nearest_point(disc.centre + radius * outward, centre, disc.normal, Feature::edge);
}

Nearest nearest(Sphere const& sphere, Vec3 const& centre)
{
    Vec3 const apart = centre - sphere.centre;
    double const away = norm(apart);
    Vec3 const outward = away > 0 ? apart / away : Vec3{0, 0, 1};
    bool const inwards = sphere.side == Side::inside || (sphere.side == Side::both && away < sphere.radius);
    double const distance = inwards ? sphere.radius - away : away - sphere.radius;
    return {sphere.centre + sphere.radius * outward, inwards ? -outward : outward, distance, Feature::face};
}

Nearest nearest(Triangle const& triangle, Vec3 const& normal, Vec3 const& centre)
{
    // Over an edge, if the centre lies outside of it; of several such edges the nearest point counts.
    Nearest best{{}, normal, -1, Feature::face};
    double best2 = 0;
    bool outside = false;
    for (std::size_t k = 0; k < 3; ++k) {
        Vec3 const &a = triangle[k], edge = triangle[(k + 1) % 3] - a, apart = centre - a;
        if (dot(cross(normal, edge), apart) >= 0) continue;
        double const part = std::clamp(dot(apart, edge) / norm2(edge), 0.0, 1.0);
        Vec3 const point = part < 1 ? a + part * edge : triangle[(k + 1) % 3];
        double const distance2 = norm2(centre - point);
        if (outside && distance2 >= best2) continue;
        outside = true;
        best2 = distance2;
        best.point = point;
        best.feature = part > 0 && part < 1 ? Feature::edge : Feature::vertex;
    }
    if (outside) return nearest_point(best.point, centre, normal, best.feature);
    double const height = dot(centre - triangle[0], normal);
    return {centre - height * normal, height < 0 ? -normal : normal, std::abs(height), Feature::face};
}

Vec3 triangle_normal(Triangle const& triangle)
{
    Vec3 const twice = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    double const size = norm(twice);
    return size > 0 ? twice / size : Vec3{};
}
}
