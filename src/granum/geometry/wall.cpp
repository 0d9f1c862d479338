#include "granum/geometry/wall.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
std::optional<Touch> touch_one(Plane const& plane, Vec3 const& centre, double reach)
{
    double const distance = dot(centre - plane.point, plane.normal);
    if (distance >= reach) return std::nullopt;
    return Touch{distance, plane.normal};
}

std::optional<Touch> touch_one(ConeWall const& wall, Vec3 const& centre, double reach)
{
    // In the half plane through the axis and the centre the wall is a straight segment from (r0, z0) to (r1, z1).
    double const axis_distance = std::sqrt(centre.x * centre.x + centre.y * centre.y);
    double const dr = wall.r1 - wall.r0, dz = wall.z1 - wall.z0, length2 = dr * dr + dz * dz;
    double const along = ((axis_distance - wall.r0) * dr + (centre.z - wall.z0) * dz) / length2;
    Vec3 const outward =
        axis_distance > 0 ? Vec3{centre.x / axis_distance, centre.y / axis_distance, 0} : Vec3{1, 0, 0};
    if (along >= 0 && along < 1) {  // where two sections meet, the upper one has the face
        double const length = std::sqrt(length2);
        // Positive inside: the side of the segment that faces the axis.
        double const distance = ((wall.r0 - axis_distance) * dz + (centre.z - wall.z0) * dr) / length;
        if (distance >= reach) return std::nullopt;
        return Touch{distance, (-dz / length) * outward + Vec3{0, 0, dr / length}};
    }
    double const r_end = along < 0 ? wall.r0 : wall.r1, z_end = along < 0 ? wall.z0 : wall.z1;
    double const r_off = axis_distance - r_end, z_off = centre.z - z_end;
    double const distance = std::sqrt(r_off * r_off + z_off * z_off);
    if (distance >= reach || distance == 0) return std::nullopt;
    return Touch{distance, (r_off / distance) * outward + Vec3{0, 0, z_off / distance}, true};
}
}

std::optional<Touch> touch(Surface const& surface, Vec3 const& centre, double reach)
{
    return std::visit([&](auto const& shape) { return touch_one(shape, centre, reach); }, surface);
}
}
