// Which triangles of a mesh are near a point: a tree of boxes.
#pragma once

#include "granum/geometry/shape.hpp"

#include <cstdint>
#include <vector>

namespace granum::geometry
{
class TriangleTree
{
  public:
    explicit TriangleTree(std::vector<Triangle> const& triangles);

    //! Calls found(number of the triangle) for all whose boxes are within `reach` (m) of the point, in an order that
    //! only the mesh and the point decide.
    template <class Found>
    void near(Vec3 const& point, double reach, Found&& found) const
    {
        std::uint32_t waiting[64];
        std::size_t count = 0;
        if (!nodes_.empty()) waiting[count++] = 0;
        while (count > 0) {
            Node const& node = nodes_[waiting[--count]];
            if (distance2(node, point) > reach * reach) continue;
            if (node.size == 0) {
                waiting[count++] = node.first;
                waiting[count++] = node.first + 1;
            } else {
                for (std::uint32_t k = node.first; k < node.first + node.size; ++k) found(order_[k]);
            }
        }
    }

  private:
    struct Node
    {
        Vec3 lower, upper;
        std::uint32_t first = 0;  // of its triangles in order_, or of its two children in nodes_
        std::uint32_t size = 0;   // triangles; 0: has children
    };

    static double distance2(Node const& node, Vec3 const& point)
    {
        double sum = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            double const below = node.lower[d] - point[d], above = point[d] - node.upper[d];
            double const off = below > 0 ? below : above > 0 ? above : 0;
            sum += off * off;
        }
        return sum;
    }

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};
}
