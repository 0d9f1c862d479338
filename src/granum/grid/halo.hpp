// Ghost cells: filled from the rank (or the periodic side) that owns them, or folded back into it.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"

#include <span>

namespace granum::grid
{
//! Overwrites the ghosts of each field with the values of the owner, along x by message or periodic copy, along y and z
//! by periodic copy where the grid is periodic; other ghosts are left as they are. Edges and corners included.
//! Collective.
void refresh(Grid const& grid, par::Communicator const& comm, std::span<Field* const> fields);

//! Adds what lies in ghosts to the cells they are copies of and zeroes the ghosts: the adjoint of `refresh`.
//! Collective.
void fold(Grid const& grid, par::Communicator const& comm, std::span<Field* const> fields);
}
