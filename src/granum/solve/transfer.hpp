// Between a level of the multigrid and the next coarser one, whose cells are pairs of cells along some directions.
#pragma once

#include "granum/solve/level.hpp"

namespace granum::solve
{
using Directions = std::array<bool, 3>;
using Colours = std::span<std::size_t const>;

//! The cells of ranks when cells 2I and 2I + 1 along `paired` directions become one: it goes to the rank of the first.
grid::Layout coarser(grid::Layout const& layout, Directions const& paired);

//! What cells lack is summed over a pair, and a correction is the same for both.
class Transfer
{
  public:
    Transfer(Level const& fine, Directions const& paired);

    Directions const& paired() const { return paired_; }

    //! Links and extras of the coarse level: sums over faces and cells. Across paired directions centres are twice as
    //! far apart, so that links are halved.
    void aggregate(Level const& fine, Level& coarse);
    //! Right side of the coarse level from the residual of some colours. Collective.
    void restrict(Level& fine, Level& coarse, Colours colours);
    //! Adds x of the coarse level to that of the fine cells of some colours. Collective.
    void prolong(Level& coarse, Level& fine, Colours colours);

  private:
    struct Children
    {
        int first, end;  // local indices
    };
    struct Part
    {
        Index place;
        int count, coarse;  // index along the row of the coarse cell that the first belongs to
    };
    Children children(std::size_t d, int coarse) const;
    Part part_of(Level const& fine, std::size_t colour, Index row, int from, int end) const;
    void add_row(Level const& fine, Values const& field, Index first, bool both, float weight, float* row);

    Directions paired_;
    bool split_ = false;           // some pair has cells of two ranks
    std::array<int, 3> offset_{};  // local index of the first child of coarse cell 0
    std::array<int, 3> behind_{};  // local index behind the last child of the last coarse cell
    std::array<std::vector<float>, 5> rows_;
};
}
