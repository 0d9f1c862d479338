#include "granum/geometry/mesh_bodies.hpp"

#include "granum/geometry/bounds.hpp"
#include "granum/math/constants.hpp"

#include <cmath>
#include <numeric>

namespace granum::geometry
{
namespace
{
//! Solid angle of a triangle seen from x. Source: van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125
//! (recalled).
double solid_angle(Triangle const& triangle, Vec3 const& x)
{
    Vec3 const a = triangle[0] - x, b = triangle[1] - x, c = triangle[2] - x;
    double const la = norm(a), lb = norm(b), lc = norm(c);
    return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}
}

MeshBodies find_bodies(Corners const& corners, Edges const& edges)
{
    std::vector<std::uint32_t> root(corners.of.size());
    std::iota(root.begin(), root.end(), 0u);
    auto const find = [&](std::uint32_t k) {
        while (root[k] != k) k = root[k] = root[root[k]];
        return k;
    };
    for (auto const& edge : edges.edges)
        for (auto const& use : edges.at(edge)) {
            std::uint32_t const a = find(edges.at(edge)[0].triangle), b = find(use.triangle);
            root[std::max(a, b)] = std::min(a, b);
        }
    MeshBodies out;
    std::vector<Bounds> boxes;
    std::vector<std::uint32_t> number(corners.of.size());
    Vec3 const origin = corners.points.empty() ? Vec3{} : corners.points[0];
    for (std::uint32_t k = 0; k < corners.of.size(); ++k) {
        std::uint32_t const top = find(k);
        if (top == k) {
            number[k] = static_cast<std::uint32_t>(out.bodies.size());
            out.bodies.push_back({.first = k});
            boxes.emplace_back();
        }
        out.of.push_back(number[top]);
        auto& body = out.bodies[number[top]];
        auto const [a, b, c] = corners.triangle(k);
        ++body.facets;
        body.volume += dot(a - origin, cross(b - origin, c - origin)) / 6;
        body.area += 0.5 * norm(cross(b - a, c - a));
        for (auto const& corner : {a, b, c}) boxes[number[top]].widen(corner);
    }
    for (std::uint32_t inner = 0; inner < out.bodies.size(); ++inner)
        for (std::uint32_t outer = 0; outer < out.bodies.size(); ++outer) {
            if (outer == inner || !boxes[outer].holds(boxes[inner])) continue;
            Vec3 const& x = corners.points[corners.of[out.bodies[inner].first][0]];
            double turns = 0;
            for (std::size_t k = 0; k < corners.of.size(); ++k)
                if (out.of[k] == outer) turns += solid_angle(corners.triangle(k), x) / (4 * math::pi);
            if (std::abs(turns) < 0.5) continue;
            ++out.bodies[inner].depth;
            out.bodies[inner].around = outer;
        }
    return out;
}
}
