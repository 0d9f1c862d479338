#include "granum/grid/grid.hpp"

#include <algorithm>

namespace granum::grid
{
Shape::Shape(std::array<int, 3> const& cells) : n(cells)
{
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return n[a] > n[b]; });
    std::ptrdiff_t stride = 1;
    for (std::size_t const d : order) {
        strides[d] = stride;
        stride *= n[d] + 2;
    }
    origin = static_cast<Index>(strides[0] + strides[1] + strides[2]);
}
}
