// How far cells are from the walls that hold the gas: from the nearest of all wall points, one for each piece of wall
// in a cell, whichever rank has it. The points are sorted into a tree, so that a cell looks at few of them.
#include "granum/gas/inside.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace granum::gas
{
namespace
{
constexpr std::size_t few = 8;  // points that need no further sorting

std::size_t split_of(std::size_t depth)
{
    return depth % 3;
}

//! Halves the points by their middle along x, y, z in turn.
void sort_points(std::span<Vec3> points, std::size_t depth)
{
    if (points.size() <= few) return;
    std::size_t const d = split_of(depth), middle = points.size() / 2;
    std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(middle), points.end(),
                     [d](Vec3 const& one, Vec3 const& other) { return one[d] < other[d]; });
    sort_points(points.first(middle), depth + 1);
    sort_points(points.subspan(middle + 1), depth + 1);
}

//! Lowers `nearest`, the square of a distance, to that of the nearest point.
void look(std::span<Vec3 const> points, std::size_t depth, Vec3 const& x, double& nearest)
{
    if (points.size() <= few) {
        for (Vec3 const& point : points) nearest = std::min(nearest, math::norm2(point - x));
        return;
    }
    std::size_t const d = split_of(depth), middle = points.size() / 2;
    nearest = std::min(nearest, math::norm2(points[middle] - x));
    double const beyond = x[d] - points[middle][d];
    auto const below = points.first(middle), above = points.subspan(middle + 1);
    look(beyond < 0 ? below : above, depth + 1, x, nearest);
    if (beyond * beyond < nearest) look(beyond < 0 ? above : below, depth + 1, x, nearest);
}
}

Field Solver::Inside::wall_distance() const
{
    Field centre[3] = {grid.make_field(), grid.make_field(), grid.make_field()};
    grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
        Vec3 const x = grid.centre(i, j, k);
        for (std::size_t d = 0; d < 3; ++d) centre[d][c] = x[d];
    });
    std::vector<Vec3> mine;
    for (auto const& piece : wall_pieces) {
        if (settings.walls[piece.wall].slip) continue;
        Vec3 point{centre[0][piece.cell], centre[1][piece.cell], centre[2][piece.cell]};
        point[piece.e] += piece.upper ? piece.distance : -piece.distance;
        mine.push_back(point);
    }
    auto bytes = comm.gather(std::as_bytes(std::span<Vec3 const>(mine)));
    comm.broadcast(bytes);
    std::vector<Vec3> points(bytes.size() / sizeof(Vec3));
    if (!bytes.empty()) std::memcpy(points.data(), bytes.data(), bytes.size());
    sort_points(points, 0);

    std::vector<Vec3> images{{}};  // of a cell, over ends that repeat themselves
    for (std::size_t d = 0; d < 3; ++d) {
        if (!grid.periodic[d]) continue;
        double const length = grid.lines[d].back() - grid.lines[d].front();
        for (std::size_t n = images.size(); n-- > 0;)
            for (double const way : {-length, length}) {
                images.push_back(images[n]);
                images.back()[d] += way;
            }
    }
    Field distance = grid.make_field(std::numeric_limits<double>::infinity());
    for (auto const& run : cells)
        for (Index c = run.first; c < run.end; ++c) {
            double nearest = std::numeric_limits<double>::infinity();
            for (Vec3 const& image : images)
                look(points, 0, Vec3{centre[0][c], centre[1][c], centre[2][c]} + image, nearest);
            distance[c] = std::sqrt(nearest);
        }
    refresh({&distance});
    return distance;
}
}
