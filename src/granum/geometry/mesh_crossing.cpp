#include "granum/geometry/mesh_crossing.hpp"

#include "granum/geometry/bounds.hpp"
#include "granum/geometry/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace granum::geometry
{
namespace
{
using Three = std::array<double, 3>;

//! Heights of the corners of `triangle` over the plane of the other; those within `touching` are 0.
Three heights(Triangle const& triangle, Triangle const& plane, Vec3 const& normal, double touching)
{
    Three out{};
    for (std::size_t c = 0; c < 3; ++c) {
        double const height = dot(triangle[c] - plane[0], normal);
        out[c] = std::abs(height) <= touching ? 0 : height;
    }
    return out;
}

bool on_both_sides(Three const& heights)
{
    return *std::min_element(heights.begin(), heights.end()) < 0 &&
           *std::max_element(heights.begin(), heights.end()) > 0;
}

//! Where a triangle goes through the plane of another, in order along a line.
struct Stretch
{
    double from = Bounds::big, to = -Bounds::big;  // of the line, m
    Vec3 first, last;
};

Stretch stretch(Triangle const& triangle, Three const& heights, Vec3 const& origin, Vec3 const& line)
{
    Stretch out;
    auto const take = [&](Vec3 const& x) {
        double const along = dot(x - origin, line);
        if (along < out.from) out.from = along, out.first = x;
        if (along > out.to) out.to = along, out.last = x;
    };
    for (std::size_t c = 0; c < 3; ++c) {
        std::size_t const next = (c + 1) % 3;
        double const a = heights[c], b = heights[next];
        if (a == 0) take(triangle[c]);
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) take(triangle[c] + (a / (a - b)) * (triangle[next] - triangle[c]));
    }
    return out;
}

struct Polygon
{
    std::array<Vec3, 9> at;
    std::size_t size = 0;
};

//! Area and middle of what two triangles of one plane have in common.
struct Common
{
    double area = 0;
    Vec3 middle;
};

Common common(Triangle const& one, Triangle const& other, Vec3 const& normal, Vec3 const& other_normal)
{
    Polygon polygon{{one[0], one[1], one[2]}, 3};
    for (std::size_t side = 0; side < 3; ++side) {
        Vec3 const from = other[side], inwards = cross(other_normal, other[(side + 1) % 3] - from);
        Polygon cut;
        for (std::size_t k = 0; k < polygon.size; ++k) {
            Vec3 const &a = polygon.at[k], &b = polygon.at[(k + 1) % polygon.size];
            double const at_a = dot(a - from, inwards), at_b = dot(b - from, inwards);
            if (at_a > 0) cut.at[cut.size++] = a;
            if ((at_a > 0) != (at_b > 0)) cut.at[cut.size++] = a + (at_a / (at_a - at_b)) * (b - a);
        }
        polygon = cut;
    }
    Common out;
    for (std::size_t k = 0; k < polygon.size; ++k) out.middle += polygon.at[k] / static_cast<double>(polygon.size);
    for (std::size_t k = 1; k + 1 < polygon.size; ++k)
        out.area += 0.5 * dot(cross(polygon.at[k] - polygon.at[0], polygon.at[k + 1] - polygon.at[0]), normal);
    return out;
}

double longest_side(Triangle const& t)
{
    return std::sqrt(std::max({norm2(t[1] - t[0]), norm2(t[2] - t[1]), norm2(t[0] - t[2])}));
}

void note(FacetPairs& pairs, std::size_t one, std::size_t other, Vec3 const& at)
{
    if (pairs.count++ == 0) pairs.one = one, pairs.other = other, pairs.at = at;
}
}

Crossings find_crossings(Corners const& corners, double size)
{
    std::vector<Triangle> triangles;
    std::vector<Vec3> normals;
    for (std::size_t k = 0; k < corners.of.size(); ++k) {
        triangles.push_back(corners.triangle(k));
        normals.push_back(triangle_normal(triangles.back()));
    }
    double const touching = 1e-7 * size, least = 1e-6 * size;  // m, of a height and of a length
    Crossings out;
    TriangleTree const tree(triangles);
    std::vector<std::uint32_t> near;
    for (std::uint32_t one = 0; one < triangles.size(); ++one) {
        Bounds box;
        for (auto const& corner : triangles[one]) box.widen(corner);
        near.clear();
        tree.meeting(box.lower, box.upper, [&](std::uint32_t other) {
            if (other > one) near.push_back(other);
        });
        std::sort(near.begin(), near.end());
        for (std::uint32_t const other : near) {
            int shared = 0;
            for (std::uint32_t const a : corners.of[one])
                for (std::uint32_t const b : corners.of[other]) shared += a == b;
            if (shared >= 3) continue;
            auto const &t = triangles[one], &u = triangles[other];
            Three const over_u = heights(t, u, normals[other], touching),
                        over_t = heights(u, t, normals[one], touching);
            if (over_u == Three{} && over_t == Three{}) {
                auto const [area, middle] = common(t, u, normals[one], normals[other]);
                if (area > least * std::max(longest_side(t), longest_side(u))) note(out.on_another, one, other, middle);
                continue;
            }
            if (shared == 2 || !on_both_sides(over_u) || !on_both_sides(over_t)) continue;
            Vec3 line = cross(normals[one], normals[other]);
            line = line / norm(line);
            auto const a = stretch(t, over_u, t[0], line), b = stretch(u, over_t, t[0], line);
            Vec3 const low = a.from > b.from ? a.first : b.first, high = a.to < b.to ? a.last : b.last;
            if (dot(high - low, line) > least) note(out.crossing, one, other, 0.5 * (low + high));
        }
    }
    return out;
}
}
