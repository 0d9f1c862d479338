#include "granum/solve/gathering.hpp"

namespace granum::solve
{
namespace
{
//! Calls visit(cell) for each cell of a box, x fastest.
template <class Visitor>
void for_cells(grid::CellBox const& box, Visitor&& visit)
{
    std::array<int, 3> cell;
    for (cell[2] = box.lower[2]; cell[2] < box.upper[2]; ++cell[2])
        for (cell[1] = box.lower[1]; cell[1] < box.upper[1]; ++cell[1])
            for (cell[0] = box.lower[0]; cell[0] < box.upper[0]; ++cell[0]) visit(cell);
}
}

Gathering::Gathering(Level const& parts, par::Communicator const& comm) : comm_(comm)
{
    for (auto const& box : parts.layout.boxes) counts_.push_back(static_cast<int>(box.cells()));
    mine_.resize(static_cast<std::size_t>(counts_[static_cast<std::size_t>(comm.rank())]));
    all_.resize(static_cast<std::size_t>(parts.cells()));
}

void Gathering::share(Level const& parts, Values const& from, Level const& whole, Values& to)
{
    std::size_t next = 0;
    for_cells({{}, parts.n}, [&](auto const& cell) { mine_[next++] = from[parts.place(parts.number(cell))]; });
    comm_.share(mine_, all_, counts_);
    next = 0;
    for (auto const& box : parts.layout.boxes)
        for_cells(box, [&](auto const& cell) { to[whole.place(whole.number(cell))] = all_[next++]; });
}

void Gathering::aggregate(Level const& parts, Level& whole)
{
    for (std::size_t d = 0; d < 3; ++d) share(parts, parts.link[d], whole, whole.link[d]);
    share(parts, parts.extra, whole, whole.extra);
}

void Gathering::restrict(Level const& parts, Level& whole)
{
    share(parts, parts.right, whole, whole.right);
}

void Gathering::prolong(Level const& whole, Level& parts) const
{
    // Ghosts beyond the ends of the domain are not asked for: no pair reaches over them.
    grid::CellBox box = parts.layout.box(comm_.rank());
    for (std::size_t d = 0; d < 3; ++d) box.lower[d] = std::max(box.lower[d] - 1, 0);
    for_cells(box, [&](std::array<int, 3> const& cell) {
        auto here = cell;
        for (std::size_t d = 0; d < 3; ++d) here[d] -= parts.lower[d];
        parts.x[parts.place(parts.number(here))] = whole.x[whole.place(whole.number(cell))];
    });
}
}
