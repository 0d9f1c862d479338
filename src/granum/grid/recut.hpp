// The same cells on other ranks: when the cuts between the ranks move while a run goes on.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"

#include <span>

namespace granum::grid
{
//! The cells that `layout` gives this rank, of the same domain as those of `from`, with open volumes and areas from
//! the ranks that have them. Collective.
Grid recut(Grid const& from, Layout const& layout, par::Communicator const& comm);

//! Brings fields of the cells of `from` to those of `to`, ghosts included, those beyond ends of the domain too.
//! Collective.
void move(Grid const& from, Grid const& to, par::Communicator const& comm, std::span<Field* const> fields);
}
