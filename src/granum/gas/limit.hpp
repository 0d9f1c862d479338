// Flux-corrected transport: implicit upwind differences give a solution without new extremes at any step, and what they
// smear is taken back as far as that makes no new extremes either. What one node gives the other takes: the sum stays.
//
// Source: Zalesak, J. Comput. Phys. 31 (1979) 335, the limiter. That smooth extremes may move by half of their second
// difference is ours: without it they are clipped in every step.
#pragma once

#include "granum/grid/grid.hpp"

#include <array>
#include <vector>

namespace granum::gas
{
struct Limit
{
    using Field = grid::Field;
    using Index = grid::Index;
    using Run = grid::Run;

    explicit Limit(grid::Grid const& grid);

    //! Fluxes to add, by direction of the link, from the lower node to the upper.
    std::array<Field, 3> added;

    void clear();  //!< no fluxes

    //! Scales `added` so that no node of `nodes` gets beyond its neighbours before the step and in the upwind solution
    //! `x`, and beyond [least, most] unless the upwind solution is. `earlier`: before the step; `room`: what a node
    //! takes up per unit of x; `coupled`: 1 for links that there are; `bounding`: 1 for these and for those to what
    //! enters, which x and earlier hold outside. Ghosts of x, earlier and links are filled; those of `added`
    //! afterwards. Collective.
    void scale(grid::Grid const& grid, std::vector<Run> const& nodes, Field const& x, Field const& earlier,
               Field const& room, std::array<Field const*, 3> coupled, std::array<Field const*, 3> bounding,
               double least, double most);

  private:
    Field high_, low_, up_, down_;
    std::array<Field, 3> bend_;  // second differences
};
}
