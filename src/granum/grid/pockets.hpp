// Parts of a grid that nothing connects to the rest.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"

namespace granum::grid
{
//! Closes every cell, with its faces, that open faces do not connect to the largest connected part of the domain.
//! Collective.
void close_pockets(Grid& grid, par::Communicator const& comm);
}
