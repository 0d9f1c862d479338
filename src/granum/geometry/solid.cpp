#include "granum/geometry/solid.hpp"

#include "granum/geometry/closed_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
using MeshPointer = std::shared_ptr<ClosedMesh const>;

SurfaceDistance distance_of(Box const& box, Vec3 const& x)
{
    Vec3 off, sign;
    std::size_t nearest = 0;
    bool outside = false;
    double beyond2 = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        double const above = x[d] - box.upper[d], below = box.lower[d] - x[d];
        sign[d] = above >= below ? 1 : -1;
        off[d] = std::max(above, below);
        if (off[d] > off[nearest]) nearest = d;
        if (off[d] > 0) outside = true, beyond2 += off[d] * off[d];
    }
    Vec3 normal;
    if (!outside) {
        normal[nearest] = sign[nearest];
        return {off[nearest], normal};
    }
    double const distance = std::sqrt(beyond2);
    for (std::size_t d = 0; d < 3; ++d) normal[d] = off[d] > 0 ? sign[d] * off[d] / distance : 0;
    return {distance, normal};
}

SurfaceDistance distance_of(Ball const& ball, Vec3 const& x)
{
    Vec3 const apart = x - ball.centre;
    double const away = norm(apart);
    return {away - ball.radius, away > 0 ? apart / away : Vec3{0, 0, 1}};
}

SurfaceDistance distance_of(HalfSpace const& half, Vec3 const& x)
{
    return {dot(x - half.point, half.normal), half.normal};
}

SurfaceDistance distance_of(Revolution const& body, Vec3 const& x)
{
    return body.distance(x);
}

SurfaceDistance distance_of(MeshPointer const& mesh, Vec3 const& x)
{
    return mesh->distance(x);
}

Bounds bounds_of(Box const& box)
{
    return {box.lower, box.upper};
}

Bounds bounds_of(Ball const& ball)
{
    Vec3 const half{ball.radius, ball.radius, ball.radius};
    return {ball.centre - half, ball.centre + half};
}

Bounds bounds_of(HalfSpace const&)
{
    constexpr double far = std::numeric_limits<double>::infinity();
    return {{-far, -far, -far}, {far, far, far}};
}

Bounds bounds_of(Revolution const& body)
{
    return body.bounds();
}

Bounds bounds_of(MeshPointer const& mesh)
{
    return mesh->bounds();
}

using Fault = std::optional<std::string>;

Fault fault_of(Box const& box)
{
    if (!finite(box.lower) || !finite(box.upper)) return "has a corner that is no number";
    for (std::size_t d = 0; d < 3; ++d)
        if (!(box.lower[d] < box.upper[d])) return "has an upper corner that is not above the lower one";
    return std::nullopt;
}

Fault fault_of(Ball const& ball)
{
    if (!finite(ball.centre) || !std::isfinite(ball.radius)) return "has a measure that is no number";
    if (!(ball.radius > 0)) return "has no radius above 0";
    return std::nullopt;
}

Fault fault_of(HalfSpace const& half)
{
    if (!finite(half.point) || !(std::abs(norm(half.normal) - 1) < 1e-9)) return "has no normal";
    return std::nullopt;
}

Fault fault_of(Revolution const& body)
{
    return body.fault();
}

Fault fault_of(MeshPointer const& mesh)
{
    if (!mesh) return "has no mesh";
    return std::nullopt;
}
}

SurfaceDistance surface_distance(Solid const& solid, Vec3 const& x, double enough)
{
    if (auto const* mesh = std::get_if<MeshPointer>(&solid))
        if (double const rough = (*mesh)->rough_distance(x); std::abs(rough) > enough) return {rough, {0, 0, 1}};
    return std::visit([&](auto const& one) { return distance_of(one, x); }, solid);
}

Bounds bounds(Solid const& solid)
{
    return std::visit([](auto const& one) { return bounds_of(one); }, solid);
}

std::optional<std::string> fault(Solid const& solid)
{
    return std::visit([](auto const& one) { return fault_of(one); }, solid);
}

Solid solid(Chamber const& chamber)
{
    if (chamber.shape == Chamber::Shape::box) return Box{{}, chamber.size};
    return turned(chamber.profile);
}
}
