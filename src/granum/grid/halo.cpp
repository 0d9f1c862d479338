#include "granum/grid/halo.hpp"

#include <algorithm>
#include <cstring>

namespace granum::grid
{
namespace
{
enum class Way
{
    refresh,
    fold
};

//! Plane of all cells (ghosts of the other directions included) at index `at` in `direction`.
template <class Visitor>
void for_plane(Grid const& grid, int direction, int at, Visitor&& visit)
{
    std::array<int, 3> low{-1, -1, -1}, high{grid.n[0], grid.n[1], grid.n[2]};
    low[static_cast<std::size_t>(direction)] = high[static_cast<std::size_t>(direction)] = at;
    for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
            for (int i = low[0]; i <= high[0]; ++i) visit(grid.at(i, j, k));
}

std::vector<double> pack(Grid const& grid, int at, std::span<Field* const> fields)
{
    std::vector<double> out;
    out.reserve(fields.size() * static_cast<std::size_t>(grid.n[1] + 2) * static_cast<std::size_t>(grid.n[2] + 2));
    for (Field const* field : fields) for_plane(grid, 0, at, [&](Index cell) { out.push_back((*field)[cell]); });
    return out;
}

void unpack(Grid const& grid, int at, std::span<Field* const> fields, std::vector<std::byte> const& bytes, Way way)
{
    if (bytes.empty()) return;
    std::vector<double> values(bytes.size() / sizeof(double));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    std::size_t next = 0;
    for (Field* field : fields)
        for_plane(grid, 0, at, [&](Index cell) {
            if (way == Way::refresh)
                (*field)[cell] = values[next++];
            else
                (*field)[cell] += values[next++];
        });
}

void clear(Grid const& grid, int at, std::span<Field* const> fields)
{
    for (Field* field : fields) for_plane(grid, 0, at, [&](Index cell) { (*field)[cell] = 0; });
}

//! Periodic direction within this rank: ghost -1 is cell n-1, ghost n is cell 0.
void wrap(Grid const& grid, int direction, std::span<Field* const> fields, Way way)
{
    int const n = grid.n[static_cast<std::size_t>(direction)];
    auto const span = grid.strides()[static_cast<std::size_t>(direction)] * n;
    for (Field* pointer : fields) {
        Field& field = *pointer;
        auto image = [span](Index ghost, bool low) {
            return static_cast<Index>(static_cast<std::ptrdiff_t>(ghost) + (low ? span : -span));
        };
        for (bool low : {true, false})
            for_plane(grid, direction, low ? -1 : n, [&](Index ghost) {
                if (way == Way::refresh) {
                    field[ghost] = field[image(ghost, low)];
                } else {
                    field[image(ghost, low)] += field[ghost];
                    field[ghost] = 0;
                }
            });
    }
}

//! Neighbours in x, or -1 where the domain ends. Ranks are slabs in order.
std::array<int, 2> neighbours(Grid const& grid, par::Communicator const& comm)
{
    int const rank = comm.rank(), last = comm.size() - 1;
    bool const round = grid.periodic[0];
    return {rank > 0 ? rank - 1 : round ? last : -1, rank < last ? rank + 1 : round ? 0 : -1};
}

void along_x(Grid const& grid, par::Communicator const& comm, std::span<Field* const> fields, Way way)
{
    auto const [left, right] = neighbours(grid, comm);
    if (comm.size() == 1) {
        if (left >= 0) wrap(grid, 0, fields, way);
        return;
    }
    int const n = grid.n[0];
    bool const fill = way == Way::refresh;
    // Refresh sends the outermost owned planes into the neighbours' ghosts; fold sends the ghosts back.
    auto send = [&](int from_plane, int to, int from, int into_plane) {
        std::vector<double> out;
        if (to >= 0) out = pack(grid, from_plane, fields);
        unpack(grid, into_plane, fields, comm.exchange(std::as_bytes(std::span(out)), to, from), way);
        if (!fill && to >= 0) clear(grid, from_plane, fields);
    };
    if (fill) {
        send(0, left, right, n);
        send(n - 1, right, left, -1);
    } else {
        send(-1, left, right, n - 1);
        send(n, right, left, 0);
    }
}
}

// Direction after direction, whole planes with the ghosts of the others: so edges and corners come out right.
void refresh(Grid const& grid, par::Communicator const& comm, std::span<Field* const> fields)
{
    along_x(grid, comm, fields, Way::refresh);
    for (int direction : {1, 2})
        if (grid.periodic[static_cast<std::size_t>(direction)]) wrap(grid, direction, fields, Way::refresh);
}

void fold(Grid const& grid, par::Communicator const& comm, std::span<Field* const> fields)
{
    for (int direction : {2, 1})
        if (grid.periodic[static_cast<std::size_t>(direction)]) wrap(grid, direction, fields, Way::fold);
    along_x(grid, comm, fields, Way::fold);
}
}
