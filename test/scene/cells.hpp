// Cells for tests: a chamber cut among ranks without any granules.
#pragma once

#include "granum/grid/build.hpp"

namespace granum
{
//! The cells of this rank; all ranks have about as many.
inline grid::Grid cut_evenly(geometry::Chamber const& chamber, grid::Lines const& lines, std::array<bool, 3> periodic,
                             par::Communicator const& comm)
{
    par::Space space{.box = {}, .periodic = periodic};
    for (std::size_t d = 0; d < 3; ++d) space.box.lower[d] = lines[d].front(), space.box.upper[d] = lines[d].back();
    auto const partition = par::Partition::balanced(space, {}, {}, comm, &lines);
    return grid::build(grid::openness(chamber), lines, grid::layout(partition, lines), comm);
}
}
