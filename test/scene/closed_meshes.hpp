// Closed triangle meshes with normals that point out, some of them unkind, and a way to tell inside that needs no
// distance: the solid angle.
#pragma once

#include "granum/geometry/chamber.hpp"
#include "granum/geometry/closed_mesh.hpp"
#include "scene/meshes.hpp"

#include <functional>
#include <memory>

namespace granum::scene
{
using Triangles = std::vector<Triangle>;

//! How often the surface goes round x: 1 inside, 0 outside. Sum of solid angles after Van Oosterom and Strackee, IEEE
//! Trans. Biomed. Eng. 30 (1983) 125.
inline double turns_round(Triangles const& triangles, Vec3 const& x)
{
    double sum = 0;
    for (auto const& [p, q, r] : triangles) {
        Vec3 const a = p - x, b = q - x, c = r - x;
        double const la = norm(a), lb = norm(b), lc = norm(c);
        sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (4 * math::pi);
}

inline std::shared_ptr<geometry::ClosedMesh const> closed(Triangles const& triangles)
{
    return std::make_shared<geometry::ClosedMesh const>(geometry::join_corners(triangles, 1e-9));
}

//! The surface of a box, every side in n x n places.
inline Triangles box_surface(Vec3 const& lower, Vec3 const& upper, int n = 1)
{
    Vec3 const size = upper - lower;
    Triangles out;
    for (std::size_t d = 0; d < 3; ++d)
        for (bool const far : {false, true})
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    auto const at = [&](int a, int b) {
                        Vec3 x = lower;
                        x[(d + 1) % 3] += size[(d + 1) % 3] * a / n, x[(d + 2) % 3] += size[(d + 2) % 3] * b / n;
                        x[d] = far ? upper[d] : lower[d];
                        return x;
                    };
                    Triangle one{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                        two{at(i, j), at(i + 1, j + 1), at(i, j + 1)};
                    if (!far) std::swap(one[1], one[2]), std::swap(two[1], two[2]);
                    out.insert(out.end(), {one, two});
                }
    return out;
}

//! What a closed generatrix sweeps: heights z and radii, from the lower to the upper end, both on the axis.
inline Triangles turned_surface(std::vector<geometry::ProfilePoint> const& profile, int around)
{
    Triangles out;
    auto const at = [&](geometry::ProfilePoint const& point, int k) {
        double const angle = 2 * math::pi * (k % around) / around;
        return Vec3{point.radius * std::cos(angle), point.radius * std::sin(angle), point.height};
    };
    for (std::size_t p = 0; p + 1 < profile.size(); ++p)
        for (int k = 0; k < around; ++k) {
            auto const &low = profile[p], &high = profile[p + 1];
            if (low.radius > 0) out.push_back({at(low, k), at(low, k + 1), at(high, k)});
            if (high.radius > 0) out.push_back({at(low, k + 1), at(high, k + 1), at(high, k)});
        }
    return out;
}

//! A sphere about (0, 0, 0) whose radius changes with the direction.
inline Triangles rough_ball(std::function<double(Vec3 const&)> const& radius, int n)
{
    Triangles out;
    auto const at = [&](int i, int j) {
        double const theta = math::pi * j / n, phi = math::pi * (i % (2 * n)) / n;
        Vec3 const to{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)};
        Vec3 const pole{0, 0, j == 0 ? -1.0 : 1.0};
        Vec3 const direction = j == 0 || j == n ? pole : to;
        return radius(direction) * direction;
    };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < 2 * n; ++i) {
            if (j > 0) out.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            if (j < n - 1) out.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return out;
}

inline Triangles ball_surface(Vec3 const& centre, double radius, int n)
{
    auto out = rough_ball([&](Vec3 const&) { return radius; }, n);
    for (auto& triangle : out)
        for (auto& corner : triangle) corner += centre;
    return out;
}

inline Triangles moved(Triangles triangles, Vec3 const& shift)
{
    for (auto& triangle : triangles)
        for (auto& corner : triangle) corner += shift;
    return triangles;
}

inline Triangles turned_round(Triangles triangles)
{
    for (auto& triangle : triangles) std::swap(triangle[1], triangle[2]);
    return triangles;
}

inline Triangles together(Triangles a, Triangles const& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
}
