#include "granum/particle/rows.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace granum::particle
{
namespace
{
template <class StoreType, class Visitor>
void visit(StoreType& granules, Columns which, Visitor&& visitor)
{
    for_each_column(granules, [&](auto& column) {
        if (which == Columns::all || column.traits.halo) visitor(column);
    });
}
}

void pack_row(Store const& granules, std::size_t row, Columns which, std::vector<std::byte>& bytes)
{
    visit(granules, which, [&](auto const& column) {
        auto const* first = reinterpret_cast<std::byte const*>(&column.values[row]);
        bytes.insert(bytes.end(), first, first + sizeof(column.values[row]));
    });
}

std::size_t packed_size(Store const& granules, Columns which)
{
    std::size_t size = 0;
    visit(granules, which, [&](auto const& column) { size += sizeof(column.values[0]); });
    return size;
}

std::span<std::byte const> unpack_row(Store& granules, std::size_t row, Columns which, std::span<std::byte const> bytes)
{
    visit(granules, which, [&](auto& column) {
        auto& value = column.values[row];
        std::memcpy(&value, bytes.data(), sizeof(value));
        bytes = bytes.subspan(sizeof(value));
    });
    return bytes;
}

std::vector<std::uint32_t> rows_by_identity(Store const& granules)
{
    std::vector<std::uint32_t> rows(granules.owned);
    std::iota(rows.begin(), rows.end(), 0u);
    std::sort(rows.begin(), rows.end(), [&](auto a, auto b) { return granules.id[a] < granules.id[b]; });
    return rows;
}

void reorder(Store& granules, std::span<std::uint32_t const> order)
{
    for_each_column(granules, [&](auto& column) {
        auto const former = column.values;
        column.values.resize(order.size());
        for (std::size_t k = 0; k < order.size(); ++k) column.values[k] = former[order[k]];
    });
    granules.owned = order.size();
}
}
