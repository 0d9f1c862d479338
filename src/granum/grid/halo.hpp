// Ghost cells: filled from the rank (or the periodic side) that owns them, or folded back into it.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"

#include <initializer_list>
#include <span>

namespace granum::grid
{
//! Who sends which cells to whom. Ranks may have any boxes of cells, and a box may be empty: it then has ghosts only.
class Halo
{
  public:
    struct Side
    {
        int rank;
        std::vector<std::uint32_t> mine, ghosts;  //!< cells sent; ghosts filled
    };

    Halo(Layout const& layout, Shape const& shape, int rank, par::Communicator const& comm);

    void refresh(std::span<Field* const> fields) const;
    void fold(std::span<Field* const> fields) const;

    Layout const& layout() const { return layout_; }
    std::vector<Side> const& sides() const { return sides_; }  //!< other ranks
    //! @{ Ghosts that are cells of this rank over periodic faces, and these cells.
    std::vector<std::uint32_t> const& images() const { return images_; }
    std::vector<std::uint32_t> const& originals() const { return originals_; }
    //! @}

  private:
    Layout layout_;
    par::Communicator comm_;
    std::vector<Side> sides_;
    std::vector<std::uint32_t> images_, originals_;
    mutable std::vector<std::vector<double>> out_, in_;
};

//! Overwrites the ghosts of each field with the values of their owners: other ranks, or cells at the other side of a
//! periodic domain. Ghosts beyond other ends belong to the rank whose cells are there. Edges and corners included.
//! Collective.
void refresh(Grid const& grid, std::span<Field* const> fields);
void refresh(Grid const& grid, std::initializer_list<Field*> fields);

//! Adds what lies in ghosts to the cells they are copies of and zeroes the ghosts: the adjoint of `refresh`.
//! Collective.
void fold(Grid const& grid, std::span<Field* const> fields);
}
