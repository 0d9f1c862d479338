// Ghosts of fields that are stored apart by colour (level.hpp), one colour at a time.
#pragma once

#include "granum/base/aligned.hpp"
#include "granum/grid/halo.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace granum::solve
{
using grid::Index;
using Values = base::AlignedVector<float>;  //!< one per cell, ghosts included: those of colour 0, then of colour 1

class Exchange
{
  public:
    //! Of a field whose cell at c of `shape` has colour c % 2 and stands at c / 2, behind `half` places for colour 1.
    //! Collective.
    Exchange(grid::Layout const& layout, grid::Shape const& shape, Index half, int rank, par::Communicator const& comm);

    //! Fills the ghosts that are copies of cells of one colour. Collective.
    void refresh(Values& field, std::size_t colour) const;
    //! Fills all ghosts of all fields. Collective.
    void refresh(std::initializer_list<Values*> fields) const;

  private:
    using Places = std::vector<std::uint32_t>;
    struct Side
    {
        int rank;
        std::array<Places, 2> mine, ghosts;  // by colour
    };

    void refresh(std::span<Values* const> fields, std::span<std::size_t const> colours) const;

    par::Communicator comm_;
    std::vector<Side> sides_;
    std::array<Places, 2> images_, originals_;
    mutable std::vector<std::vector<double>> out_, in_;
};
}
