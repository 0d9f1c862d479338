// Triangle meshes that tests of walls share.
#pragma once

#include "granum/geometry/shape.hpp"
#include "granum/math/constants.hpp"

#include <cmath>
#include <random>
#include <vector>

namespace granum::scene
{
using geometry::Mesh;
using geometry::Triangle;
using math::Vec3;

//! The rectangle origin + u [0, 1] + v [0, 1] in 2 nu nv triangles, its inner corners moved within the plane by chance.
inline Mesh jittered_sheet(Vec3 const& origin, Vec3 const& u, Vec3 const& v, int nu, int nv, unsigned seed = 1)
{
    std::mt19937 random(seed);
    auto const jitter = [&] { return 0.7 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
    std::vector<Vec3> corner;
    for (int j = 0; j <= nv; ++j)
        for (int i = 0; i <= nu; ++i) {
            double const a = i + (i > 0 && i < nu ? jitter() : 0), b = j + (j > 0 && j < nv ? jitter() : 0);
            corner.push_back(origin + (a / nu) * u + (b / nv) * v);
        }
    Mesh out;
    auto const at = [&](int i, int j) { return corner[static_cast<std::size_t>(j * (nu + 1) + i)]; };
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) {
            Vec3 const p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
            if (random() % 2 == 0)
                out.triangles.insert(out.triangles.end(), {Triangle{p, q, r}, Triangle{p, r, s}});
            else
                out.triangles.insert(out.triangles.end(), {Triangle{p, q, s}, Triangle{q, r, s}});
        }
    return out;
}

//! The surface of an axis-aligned box, two triangles a side.
inline Mesh box_mesh(Vec3 const& lower, Vec3 const& upper)
{
    Vec3 const size = upper - lower;
    Mesh out;
    for (std::size_t d = 0; d < 3; ++d) {
        Vec3 u, v, w;
        u[(d + 1) % 3] = size[(d + 1) % 3], v[(d + 2) % 3] = size[(d + 2) % 3], w[d] = size[d];
        for (bool const far : {false, true}) {
            auto const side = far ? jittered_sheet(lower + w, u, v, 1, 1) : jittered_sheet(lower, v, u, 1, 1);
            out.triangles.insert(out.triangles.end(), side.triangles.begin(), side.triangles.end());
        }
    }
    return out;
}

//! The flank of a cylinder about z from z0 to z1: `around` strips, their corners on the circle.
inline Mesh cylinder_mesh(double radius, double z0, double z1, int around)
{
    Mesh out;
    auto const at = [&](int k, double z) {
        double const angle = 2 * math::pi * (k % around) / around;
        return Vec3{radius * std::cos(angle), radius * std::sin(angle), z};
    };
    for (int k = 0; k < around; ++k) {
        out.triangles.push_back({at(k, z0), at(k + 1, z0), at(k + 1, z1)});
        out.triangles.push_back({at(k, z0), at(k + 1, z1), at(k, z1)});
    }
    return out;
}
}
