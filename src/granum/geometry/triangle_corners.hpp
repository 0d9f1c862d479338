// Which corners of triangles are the same point, and which triangles meet at an edge.
#pragma once

#include "granum/geometry/shape.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace granum::geometry
{
//! A mesh by its points. Corners that lie together are one point.
struct Corners
{
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> of;  //!< points of each triangle, in its order

    Triangle triangle(std::size_t k) const { return {points[of[k][0]], points[of[k][1]], points[of[k][2]]}; }
};

//! Corners nearer to each other than `together` (m) become one; 0: only equal ones.
Corners join_corners(std::span<Triangle const> triangles, double together);

//! An edge with the triangles that meet there.
struct Edge
{
    std::uint32_t from, to;      //!< points, from < to
    std::uint32_t first, count;  //!< its part of Edges::uses
};

struct EdgeUse
{
    std::uint32_t triangle;
    std::uint8_t side;  //!< of the triangle: from its corner `side` to the next
    bool forward;       //!< goes from the lower to the higher point
};

struct Edges
{
    std::vector<Edge> edges;
    std::vector<EdgeUse> uses;

    std::span<EdgeUse const> at(Edge const& edge) const { return std::span(uses).subspan(edge.first, edge.count); }
};

//! All edges in the order of their points. Sides from a point to itself are none.
Edges find_edges(Corners const& corners);
}
