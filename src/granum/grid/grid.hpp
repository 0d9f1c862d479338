// The gas cells of a rank: a box of cells, cut by walls, with one layer of ghosts all around.
//
// Indices (i, j, k) are local: 0 .. n-1 are owned, -1 and n are ghosts. A face field stores, at the index of a cell,
// the face on the cell's lower side: u[0](i, j, k) lies between cells (i-1, j, k) and (i, j, k). Where a wall cuts a
// cell, `open_volume` and `open_area` keep what is left of it and of its faces.
//
// The direction with most cells lies contiguous in memory, so that loops along it are long.
#pragma once

#include "granum/grid/axis.hpp"
#include "granum/grid/layout.hpp"
#include "granum/math/vec3.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace granum::grid
{
using math::Vec3;
using Index = std::size_t;

using Field = std::vector<double>;       //!< one value per cell, ghosts included
using FaceField = std::array<Field, 3>;  //!< one value per lower face, by direction

class Halo;

//! Place of cells in memory.
struct Shape
{
    std::array<int, 3> n{1, 1, 1};              //!< owned cells
    std::array<std::size_t, 3> order{0, 1, 2};  //!< directions, that contiguous in memory first
    std::array<std::ptrdiff_t, 3> strides{1, 3, 9};
    Index origin = 13;  //!< of cell (0, 0, 0)

    Shape() = default;
    explicit Shape(std::array<int, 3> const& cells);
    Index size() const
    {
        return static_cast<Index>(n[0] + 2) * static_cast<Index>(n[1] + 2) * static_cast<Index>(n[2] + 2);
    }
    Index at(int i, int j, int k) const
    {
        return static_cast<Index>(static_cast<std::ptrdiff_t>(origin) + i * strides[0] + j * strides[1] +
                                  k * strides[2]);
    }
    Index at(std::array<int, 3> const& cell) const { return at(cell[0], cell[1], cell[2]); }
};

struct Grid : Shape
{
    std::array<int, 3> global{1, 1, 1};  //!< cells of the whole domain
    std::array<int, 3> shift{};          //!< global number of the local cell (0, 0, 0)
    std::array<bool, 3> periodic{};      //!< by direction
    std::array<Axis, 3> axes;
    Lines lines;  //!< of the whole domain

    Field open_volume;    //!< m3 of gas and granules per cell, 0 behind walls (ghosts filled)
    FaceField open_area;  //!< m2 per lower face; ends of the domain are as open as the cell there

    std::shared_ptr<Halo const> halo;

    Index next(Index at, std::size_t d) const { return at + static_cast<Index>(strides[d]); }
    Index before(Index at, std::size_t d) const { return at - static_cast<Index>(strides[d]); }
    double volume(int i, int j, int k) const { return axes[0].width(i) * axes[1].width(j) * axes[2].width(k); }
    //! Of the full face across `d`, m2.
    double area(std::size_t d, std::array<int, 3> const& cell) const
    {
        std::size_t const e = (d + 1) % 3, f = (d + 2) % 3;
        return axes[e].width(cell[e]) * axes[f].width(cell[f]);
    }
    Vec3 centre(int i, int j, int k) const { return {axes[0].centre(i), axes[1].centre(j), axes[2].centre(k)}; }
    bool open(Index cell) const { return open_volume[cell] > 0; }
    //! Whether cell 0 (upper: n-1) along d is the domain's last one, with an end behind it.
    bool at_end(std::size_t d, bool upper) const
    {
        return !periodic[d] && (upper ? shift[d] + n[d] == global[d] : shift[d] == 0);
    }
    Field make_field(double value = 0) const { return Field(size(), value); }
    FaceField make_face_field(double value = 0) const
    {
        return {Field(size(), value), Field(size(), value), Field(size(), value)};
    }
};

//! Calls visit(i, j, k, cell) for every cell from `low` to `high` (both included), in the order of memory.
template <class Visitor>
void for_each_cell(Shape const& shape, std::array<int, 3> const& low, std::array<int, 3> const& high, Visitor&& visit)
{
    auto const [a, b, c] = shape.order;
    std::array<int, 3> at{};
    for (at[c] = low[c]; at[c] <= high[c]; ++at[c])
        for (at[b] = low[b]; at[b] <= high[b]; ++at[b])
            for (at[a] = low[a]; at[a] <= high[a]; ++at[a]) visit(at[0], at[1], at[2], shape.at(at));
}

//! Calls visit(i, j, k, cell) for every owned cell.
template <class Visitor>
void for_each_cell(Shape const& shape, Visitor&& visit)
{
    for_each_cell(shape, {0, 0, 0}, {shape.n[0] - 1, shape.n[1] - 1, shape.n[2] - 1}, visit);
}

//! Cells or faces that lie one behind the other in memory.
struct Run
{
    Index first, end;
};

//! Runs of owned cells for which wanted(i, j, k, cell).
template <class Wanted>
std::vector<Run> runs(Shape const& shape, Wanted&& wanted)
{
    std::vector<Run> out;
    std::size_t const along = shape.order[0];
    for_each_cell(shape, [&](int i, int j, int k, Index cell) {
        if (!wanted(i, j, k, cell)) return;
        std::array<int, 3> const at{i, j, k};
        if (!out.empty() && out.back().end == cell && at[along] > 0)
            out.back().end = cell + 1;
        else
            out.push_back({cell, cell + 1});
    });
    return out;
}
}
