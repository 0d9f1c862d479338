// Who may touch whom until the list is made anew: a search over a grid of cells as wide as the reach.
#pragma once

#include "granum/dem/contact_store.hpp"

#include <array>

namespace granum::dem
{
class NeighbourSearch
{
  public:
    //! Rows of the owned granules, cell by cell, so that neighbours in space are neighbours in memory.
    //! `reach` is the largest distance of two centres in the list, m.
    std::vector<std::uint32_t> sorted_rows(particle::Store const& granules, double reach);

    //! All pairs of rows with at least one owned whose surfaces are closer than `skin` (m), oriented from the lower to
    //! the higher id. Two images of one granule are no pair.
    void pairs(particle::Store const& granules, double reach, double skin, std::vector<PairRows>& out);

  private:
    void fill_cells(particle::Store const& granules, std::size_t rows, double reach);

    std::array<int, 3> cells_{1, 1, 1};
    std::vector<std::uint32_t> cell_of_, start_, rows_;  // rows_[start_[c] .. start_[c+1]) lie in cell c
};
}
