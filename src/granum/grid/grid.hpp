// The gas cells of a rank: a uniform box of cells, cut by the chamber wall, with one layer of ghosts all around.
//
// Indices (i, j, k) are local: 0 .. n-1 are owned, -1 and n are ghosts. A face field stores, at the index of a cell,
// the face on the cell's lower side: u[0](i, j, k) lies between cells (i-1, j, k) and (i, j, k). Where the chamber wall
// cuts a cell, `open` keeps what is left of its volume and of its faces.
#pragma once

#include "granum/math/vec3.hpp"
#include "granum/par/slabs.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace granum::grid
{
using math::Vec3;
using Index = std::size_t;

using Field = std::vector<double>;       //!< one value per cell, ghosts included
using FaceField = std::array<Field, 3>;  //!< one value per lower face, by direction

struct Grid
{
    std::array<int, 3> n{1, 1, 1};       //!< owned cells of this rank
    std::array<int, 3> global{1, 1, 1};  //!< cells of the whole domain
    int shift = 0;                       //!< global i of local i = 0
    Vec3 origin;                         //!< lower corner of the whole domain, m
    Vec3 spacing{1, 1, 1};               //!< m
    std::array<bool, 3> periodic{};      //!< by direction

    Field open_volume;    //!< m3 of gas and granules per cell, 0 outside the chamber (ghosts filled)
    FaceField open_area;  //!< m2 per lower face

    Index size() const { return static_cast<Index>(n[0] + 2) * (n[1] + 2) * (n[2] + 2); }
    //! Strides of the three directions in a field.
    std::array<std::ptrdiff_t, 3> strides() const { return {1, n[0] + 2, std::ptrdiff_t{n[0] + 2} * (n[1] + 2)}; }
    Index at(int i, int j, int k) const
    {
        return static_cast<Index>(i + 1) +
               static_cast<Index>(n[0] + 2) *
                   (static_cast<Index>(j + 1) + static_cast<Index>(n[1] + 2) * static_cast<Index>(k + 1));
    }
    double volume() const { return spacing.x * spacing.y * spacing.z; }
    double area(int direction) const { return volume() / spacing[static_cast<std::size_t>(direction)]; }
    Vec3 centre(int i, int j, int k) const
    {
        return {origin.x + (i + shift + 0.5) * spacing.x, origin.y + (j + 0.5) * spacing.y,
                origin.z + (k + 0.5) * spacing.z};
    }
    bool open(Index cell) const { return open_volume[cell] > 0; }
    Field make_field(double value = 0) const { return Field(size(), value); }
    FaceField make_face_field(double value = 0) const
    {
        return {Field(size(), value), Field(size(), value), Field(size(), value)};
    }
};

//! Calls visit(i, j, k, cell) for every owned cell, x fastest.
template <class Visitor>
void for_each_cell(Grid const& grid, Visitor&& visit)
{
    for (int k = 0; k < grid.n[2]; ++k)
        for (int j = 0; j < grid.n[1]; ++j)
            for (int i = 0; i < grid.n[0]; ++i) visit(i, j, k, grid.at(i, j, k));
}
}
