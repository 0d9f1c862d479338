// Which triangles of a mesh are near a point or a box: a tree of boxes.
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

    //! Calls look(number of the triangle) for the triangles whose boxes are nearer to the point than the root of
    //! `best2` (m2), near boxes first; look lowers best2 when it has found something nearer.
    template <class Look>
    void nearest(Vec3 const& point, double& best2, Look&& look) const
    {
        struct
        {
            std::uint32_t node;
            double distance2;
        } waiting[64];
        std::size_t count = 0;
        if (!nodes_.empty()) waiting[count++] = {0, distance2(nodes_[0], point)};
        while (count > 0) {
            auto const [at, away2] = waiting[--count];
            if (away2 >= best2) continue;
            Node const& node = nodes_[at];
            if (node.size > 0) {
                for (std::uint32_t k = node.first; k < node.first + node.size; ++k) look(order_[k]);
                continue;
            }
            double const one2 = distance2(nodes_[node.first], point), two2 = distance2(nodes_[node.first + 1], point);
            std::uint32_t const nearer = two2 < one2 ? 1 : 0;
            waiting[count++] = {node.first + 1 - nearer, nearer == 0 ? two2 : one2};
            waiting[count++] = {node.first + nearer, nearer == 0 ? one2 : two2};
        }
    }

    //! Calls found(number of the triangle) for all in leaves whose boxes meet the box from `lower` to `upper`.
    template <class Found>
    void meeting(Vec3 const& lower, Vec3 const& upper, Found&& found) const
    {
        std::uint32_t waiting[64];
        std::size_t count = 0;
        if (!nodes_.empty()) waiting[count++] = 0;
        while (count > 0) {
            Node const& node = nodes_[waiting[--count]];
            bool apart = false;
            for (std::size_t d = 0; d < 3; ++d) apart = apart || node.lower[d] > upper[d] || node.upper[d] < lower[d];
            if (apart) continue;
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
