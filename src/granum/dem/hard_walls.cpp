#include "granum/dem/hard_walls.hpp"

#include "granum/base/error.hpp"

#include "granum/math/first_fall.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace granum::dem
{
using geometry::ConeWall;
using geometry::Plane;
using math::never;

namespace
{
//! The end of a section needs no test of its own where it lies on a plane, or where the next section continues it
//! straight or bending inwards: whoever could touch the end touches a face first.
bool end_is_hidden(ConeWall const& section, double r, double z, std::vector<geometry::Wall> const& walls)
{
    double const same = 1e-9 * (section.z1 - section.z0);
    for (auto const& wall : walls) {
        if (auto const* plane = std::get_if<Plane>(&wall.surface)) {
            bool const level = std::abs(std::abs(plane->normal.z) - 1) < 1e-12;
            if (level && std::abs(z - plane->point.z) < same) return true;
        } else if (auto const* other = std::get_if<ConeWall>(&wall.surface)) {
            bool const below = z == section.z1 && std::abs(other->z0 - z) < same && std::abs(other->r0 - r) < same;
            bool const above = z == section.z0 && std::abs(other->z1 - z) < same && std::abs(other->r1 - r) < same;
            if (!below && !above) continue;
            ConeWall const& low = below ? section : *other;
            ConeWall const& high = below ? *other : section;
            // The radius grows less above than below: the room is convex there.
            if ((high.r1 - high.r0) * (low.z1 - low.z0) <= (low.r1 - low.r0) * (high.z1 - high.z0)) return true;
        }
    }
    return false;
}

//! Q^2 - x^2 - y^2 along the path, with Q the radius that the centre may have at its height.
std::array<double, 5> room(ConeWall const& wall, Vec3 const& x, Vec3 const& v, Vec3 const& a, double radius)
{
    double const dr = wall.r1 - wall.r0, dz = wall.z1 - wall.z0, slope = dr / dz;
    double const q0 = wall.r0 + (x.z - wall.z0) * slope - radius * std::sqrt(1 + slope * slope);
    double const q1 = slope * v.z, q2 = 0.5 * slope * a.z;
    auto const squared = [](double c0, double c1, double c2, double sign, std::array<double, 5>& sum) {
        sum[0] += sign * c0 * c0;
        sum[1] += sign * 2 * c0 * c1;
        sum[2] += sign * (c1 * c1 + 2 * c0 * c2);
        sum[3] += sign * 2 * c1 * c2;
        sum[4] += sign * c2 * c2;
    };
    std::array<double, 5> out{};
    squared(q0, q1, q2, 1, out);
    squared(x.x, v.x, 0.5 * a.x, -1, out);
    squared(x.y, v.y, 0.5 * a.y, -1, out);
    return out;
}
}

HardWalls::HardWalls(std::vector<geometry::Body> const& bodies)
{
    for (std::size_t number = 0; number < bodies.size(); ++number) {
        auto const& body = bodies[number];
        bool known = body.motions.empty();
        for (auto const& shape : body.shapes) {
            auto const* const flank = std::get_if<geometry::Frustum>(&shape);
            if (auto const* const plane = std::get_if<Plane>(&shape))
                walls_.push_back({*plane, body.material});
            else if (flank && flank->side == geometry::Side::inside && flank->axis == Vec3{0, 0, 1} &&
                     flank->base.x == 0 && flank->base.y == 0)
                walls_.push_back(
                    {ConeWall{flank->base.z, flank->base_radius, flank->base.z + flank->length, flank->top_radius},
                     body.material});
            else
                known = false;
        }
        base::require(
            known,
            "wall {} is nothing that hard spheres can meet: they know planes and the insides of cylinders and "
            "cones about the z axis, at rest",
            body.name);
        body_.resize(walls_.size(), number);
    }
    for (auto const& wall : walls_) {
        auto const* section = std::get_if<ConeWall>(&wall.surface);
        rim_.push_back(section && !(end_is_hidden(*section, section->r0, section->z0, walls_) &&
                                    end_is_hidden(*section, section->r1, section->z1, walls_)));
        curved_ = curved_ || !std::holds_alternative<Plane>(wall.surface);
    }
}

double HardWalls::meeting(std::size_t wall, Vec3 const& x, Vec3 const& v, Vec3 const& a, double radius,
                          double longest) const
{
    auto const& surface = walls_[wall].surface;
    if (auto const* plane = std::get_if<Plane>(&surface)) {
        auto const& n = plane->normal;
        double const time = math::first_fall(dot(x - plane->point, n) - radius, dot(v, n), 0.5 * dot(a, n));
        return time <= longest ? time : never;
    }
    double const travel = longest * (norm(v) + 0.5 * longest * norm(a));
    if (travel == 0 || !geometry::touch(surface, x, radius + travel)) return never;
    if (auto const* section = std::get_if<ConeWall>(&surface); section && !rim_[wall]) {
        double const time = math::first_fall(room(*section, x, v, a, radius), longest);
        if (time == never) return never;
        auto const then = geometry::touch(surface, x + time * (v + (0.5 * time) * a), 2 * radius);
        if (then && !then->edge) return time;
        // It met the surface beyond the ends of the section; it may still come to the section itself.
    }
    return step_towards(wall, x, v, a, radius, longest);
}

double HardWalls::step_towards(std::size_t wall, Vec3 const& x, Vec3 const& v, Vec3 const& a, double radius,
                               double longest) const
{
    double const acceleration = norm(a), fastest = norm(v) + longest * acceleration;
    double const far = radius + longest * fastest;
    double time = 0;
    for (int step = 0; step < 100'000 && time <= longest; ++step) {
        Vec3 const at = x + time * (v + (0.5 * time) * a), moving = v + time * a;
        auto const touch = geometry::touch(walls_[wall].surface, at, far);
        if (!touch) return never;
        double const gap = touch->distance - radius, opening = dot(moving, touch->normal);
        if (gap <= 1e-11 * radius && opening < 0) return time;
        double safe = gap > 0 ? gap / fastest : 0;
        // While it moves away, nothing can turn it round faster than its acceleration and the bend of the wall do.
        double const turning = acceleration + curvature(wall, at, *touch) * fastest * fastest;
        if (opening > 0) safe = std::max(safe, turning > 0 ? opening / turning : longest);
        // Nor can the gap close faster than by its present rate and twice that: what grazes the wall gets on.
        if (gap > 0 && opening <= 0)
            safe = std::max(safe, 2 * gap / (std::sqrt(opening * opening + 4 * turning * gap) - opening));
        time += std::max(safe, 1e-12 * longest);
    }
    return never;
}

double HardWalls::curvature(std::size_t wall, Vec3 const& x, geometry::Touch const& touch) const
{
    if (touch.edge || !std::holds_alternative<ConeWall>(walls_[wall].surface)) return 0;
    double const axis_distance = std::sqrt(x.x * x.x + x.y * x.y);
    return axis_distance > 0 ? -(touch.normal.x * x.x + touch.normal.y * x.y) / (axis_distance * axis_distance) : 0;
}
}
