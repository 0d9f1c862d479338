#include "granum/geometry/region_walls.hpp"

#include "granum/geometry/closed_mesh.hpp"
#include "granum/geometry/lattice.hpp"
#include "granum/geometry/triangulate.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
using MeshPointer = std::shared_ptr<ClosedMesh const>;

std::vector<Shape> shapes_of(Box const& box, bool open_inside)
{
    if (open_inside) return box_inside(box.lower, box.upper);
    Mesh mesh;
    for (std::size_t d = 0; d < 3; ++d)
        for (bool const far : {false, true}) {
            std::size_t const u = (d + 1) % 3, v = (d + 2) % 3;
            Vec3 a = box.lower;
            if (far) a[d] = box.upper[d];
            Vec3 b = a, c = a, e = a;
            b[u] = c[u] = box.upper[u], c[v] = e[v] = box.upper[v];
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, e}});
        }
    return {mesh};
}

std::vector<Shape> shapes_of(Ball const& ball, bool open_inside)
{
    return {Sphere{ball.centre, ball.radius, open_inside ? Side::inside : Side::outside}};
}

std::vector<Shape> shapes_of(HalfSpace const& half, bool open_inside)
{
    return {Plane{half.point, open_inside ? -half.normal : half.normal}};
}

std::vector<Shape> shapes_of(MeshPointer const& mesh, bool)
{
    return {Mesh{mesh->triangles()}};
}

//! The outline, mirrored at the axis, has no reentrant corner.
bool convex(std::vector<ProfilePoint> const& outline)
{
    for (std::size_t k = 0; k < outline.size(); ++k) {
        auto const &a = outline[k], &b = outline[(k + 1) % outline.size()], &c = outline[(k + 2) % outline.size()];
        double const turn =
            (b.radius - a.radius) * (c.height - b.height) - (b.height - a.height) * (c.radius - b.radius);
        if (turn < 0) return false;
        // Downwards the surface faces the axis.
        if (b.height < a.height && (a.radius > 0 || b.radius > 0)) return false;
    }
    return true;
}

std::vector<Shape> shapes_of(Revolution const& body, bool open_inside)
{
    auto const& outline = body.outline();
    bool const one_sided = open_inside && convex(outline);
    std::vector<Shape> out;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        auto from = outline[k], to = outline[(k + 1) % outline.size()];
        if (from.radius == 0 && to.radius == 0) continue;
        Vec3 const at = body.base() + from.height * body.axis();
        if (from.height == to.height && one_sided) {
            out.push_back(Plane{at, from.radius < to.radius ? body.axis() : -body.axis()});
        } else if (from.height == to.height) {
            out.push_back(Disc{at, body.axis(), std::max(from.radius, to.radius), std::min(from.radius, to.radius)});
        } else {
            if (from.height > to.height) std::swap(from, to);
            out.push_back(Frustum{body.base() + from.height * body.axis(), body.axis(), to.height - from.height,
                                  from.radius, to.radius, one_sided ? Side::inside : Side::both});
        }
    }
    return out;
}

//! Whether the others leave free all that is near the solid's surface.
bool stands_alone(Region const& region, std::size_t solid, double resolution)
{
    if (!region.bounds_everywhere(solid)) return false;
    auto const rest = region.without({solid});
    if (!rest) return true;
    if (std::holds_alternative<HalfSpace>(region.solid(solid))) return false;
    Region const own(region.name(solid), region.solid(solid));
    Lattice const lattice(own, resolution);
    return std::all_of(lattice.near_cubes().begin(), lattice.near_cubes().end(), [&](Spot const& cube) {
        return rest->at(lattice.place(cube, {0.5, 0.5, 0.5}), resolution).distance > resolution;
    });
}

Mesh drawn(Region const& region, double resolution)
{
    if (finite(region.lower()) && finite(region.upper())) return triangulate(region, resolution);
    // Solids in endless space have the same surface as the space that they fill.
    Mesh mesh = triangulate(~region, resolution);
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    return mesh;
}
}

std::vector<Shape> surface_shapes(Solid const& solid, bool open_inside)
{
    return std::visit([&](auto const& one) { return shapes_of(one, open_inside); }, solid);
}

std::vector<Body> wall_bodies(Region const& region, double resolution)
{
    std::vector<Body> out;
    std::vector<std::size_t> alone;
    for (std::size_t solid = 0; solid < region.solids(); ++solid) {
        if (!stands_alone(region, solid, resolution)) continue;
        alone.push_back(solid);
        out.push_back(
            {.name = region.name(solid), .shapes = surface_shapes(region.solid(solid), region.open_inside(solid))});
    }
    auto const rest = region.without(alone);
    if (!rest) return out;
    std::size_t first = 0;
    while (std::find(alone.begin(), alone.end(), first) != alone.end()) ++first;
    out.push_back({.name = region.name(first), .shapes = {drawn(*rest, resolution)}});
    return out;
}
}
