// Whole rows of the granule store: sorted, packed for another rank, unpacked.
#pragma once

#include "granum/particle/store.hpp"

#include <span>

namespace granum::particle
{
//! Which columns a packed row holds.
enum class Columns
{
    all,
    halo
};

//! Appends the bytes of one row to `bytes`.
void pack_row(Store const& granules, std::size_t row, Columns which, std::vector<std::byte>& bytes);

//! Bytes of one packed row of a store with the same groups of columns.
std::size_t packed_size(Store const& granules, Columns which);

//! Overwrites a row with what pack_row wrote; returns the bytes behind it.
std::span<std::byte const> unpack_row(Store& granules, std::size_t row, Columns which,
                                      std::span<std::byte const> bytes);

//! The owned rows, by rising identity.
std::vector<std::uint32_t> rows_by_identity(Store const& granules);

//! Makes row k the former row order[k]; rows that `order` does not name are dropped, and so are all ghosts.
void reorder(Store& granules, std::span<std::uint32_t const> order);
}
