#include "granum/grid/recut.hpp"

#include "granum/grid/build.hpp"
#include "granum/grid/halo.hpp"

#include <algorithm>
#include <cstring>

namespace granum::grid
{
namespace
{
//! Calls visit(cell of `of`) for what the boxes have in common.
template <class Visitor>
void for_common(Grid const& of, CellBox const& one, CellBox const& other, Visitor&& visit)
{
    std::array<int, 3> low, high;
    for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::max(one.lower[d], other.lower[d]) - of.shift[d];
        high[d] = std::min(one.upper[d], other.upper[d]) - 1 - of.shift[d];
    }
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i) visit(of.at(i, j, k));
}
}

void move(Grid const& from, Grid const& to, par::Communicator const& comm, std::span<Field* const> fields)
{
    auto const &before = from.halo->layout(), &after = to.halo->layout();
    std::vector<std::vector<std::byte>> letters(static_cast<std::size_t>(comm.size()));
    std::vector<double> values;
    for (int rank = 0; rank < comm.size(); ++rank) {
        values.clear();
        for (Field const* field : fields)
            for_common(from, before.reach(comm.rank()), after.reach(rank),
                       [&](Index cell) { values.push_back((*field)[cell]); });
        auto const bytes = std::as_bytes(std::span(values));
        letters[static_cast<std::size_t>(rank)].assign(bytes.begin(), bytes.end());
    }
    auto const arrived = comm.deliver(letters);
    for (Field* field : fields) *field = to.make_field();
    for (int rank = 0; rank < comm.size(); ++rank) {
        auto const& bytes = arrived[static_cast<std::size_t>(rank)];
        values.resize(bytes.size() / sizeof(double));
        if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
        auto value = values.begin();
        for (Field* field : fields)
            for_common(to, after.reach(comm.rank()), before.reach(rank),
                       [&](Index cell) { (*field)[cell] = *value++; });
    }
    refresh(to, fields);
}

Grid recut(Grid const& from, Layout const& layout, par::Communicator const& comm)
{
    Grid to = frame(from.lines, layout, comm);
    to.open_volume = from.open_volume;
    to.open_area = from.open_area;
    Field* fields[] = {&to.open_volume, &to.open_area[0], &to.open_area[1], &to.open_area[2]};
    move(from, to, comm, fields);
    return to;
}
}
