#include "granum/geometry/triangle_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace granum::geometry
{
namespace
{
constexpr std::uint32_t leaf = 4;  // triangles at most

// Three times the middle of a triangle.
Vec3 middle(Triangle const& triangle)
{
    return triangle[0] + triangle[1] + triangle[2];
}
}

TriangleTree::TriangleTree(std::vector<Triangle> const& triangles) : order_(triangles.size())
{
    std::iota(order_.begin(), order_.end(), 0u);
    if (triangles.empty()) return;
    nodes_.push_back({{}, {}, 0, static_cast<std::uint32_t>(triangles.size())});
    // Halving by count keeps the tree below 32 levels, so that a search never has more than 64 nodes waiting.
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        Node node = nodes_[n];
        constexpr double big = std::numeric_limits<double>::max();
        node.lower = {big, big, big}, node.upper = {-big, -big, -big};
        Vec3 least = node.lower, most = node.upper;
        auto const begin = order_.begin() + node.first, end = begin + node.size;
        for (auto at = begin; at != end; ++at) {
            Vec3 const centre = middle(triangles[*at]);
            for (std::size_t d = 0; d < 3; ++d) {
                for (auto const& corner : triangles[*at]) {
                    node.lower[d] = std::min(node.lower[d], corner[d]);
                    node.upper[d] = std::max(node.upper[d], corner[d]);
                }
                least[d] = std::min(least[d], centre[d]);
                most[d] = std::max(most[d], centre[d]);
            }
        }
        if (node.size > leaf) {
            Vec3 const wide = most - least;
            std::size_t const d = wide.x >= wide.y && wide.x >= wide.z ? 0 : wide.y >= wide.z ? 1 : 2;
            std::uint32_t const half = node.size / 2;
            std::nth_element(begin, begin + half, end, [&](std::uint32_t a, std::uint32_t b) {
                double const at_a = middle(triangles[a])[d], at_b = middle(triangles[b])[d];
                return at_a < at_b || (at_a == at_b && a < b);
            });
            auto const children = static_cast<std::uint32_t>(nodes_.size());
            nodes_.push_back({{}, {}, node.first, half});
            nodes_.push_back({{}, {}, node.first + half, node.size - half});
            node.first = children;
            node.size = 0;
        }
        nodes_[n] = node;
    }
}
}
