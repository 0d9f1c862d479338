// One number for the state of all granules: equal states have equal hashes, whatever the ranks and the order of rows.
#pragma once

#include "granum/par/communicator.hpp"
#include "granum/particle/store.hpp"

#include <string>

namespace granum::sim
{
//! 32 hexadecimal digits from every column of every owned granule, bit for bit: the sum of the rows' hashes, which hold
//! their identities, so it depends neither on memory order nor on the number of ranks. Collective; the same everywhere.
std::string state_hash(particle::Store const& granules, par::Communicator const& comm);
}
