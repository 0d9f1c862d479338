#include "granum/grid/pockets.hpp"

#include "granum/grid/halo.hpp"

#include <algorithm>
#include <cstring>
#include <map>

namespace granum::grid
{
namespace
{
//! Lowers labels to those of connected cells until none of this rank changes.
void spread(Grid const& grid, Field& label)
{
    std::vector<Index> waiting;
    auto const meet = [&](Index one, Index other) {
        if (label[one] == label[other]) return;
        Index const higher = label[one] > label[other] ? one : other;
        label[higher] = std::min(label[one], label[other]);
        waiting.push_back(higher);
    };
    auto const look = [&](Index cell) {
        for (std::size_t d = 0; d < 3; ++d) {
            if (grid.open_area[d][cell] > 0 && grid.open(grid.before(cell, d))) meet(cell, grid.before(cell, d));
            if (grid.open_area[d][grid.next(cell, d)] > 0 && grid.open(grid.next(cell, d)))
                meet(cell, grid.next(cell, d));
        }
    };
    std::vector<bool> owned(grid.size());
    for_each_cell(grid, [&](int, int, int, Index cell) { owned[cell] = true; });
    for_each_cell(grid, [&](int, int, int, Index cell) {
        if (!grid.open(cell)) return;
        look(cell);
        while (!waiting.empty()) {
            Index const next = waiting.back();
            waiting.pop_back();
            if (owned[next]) look(next);
        }
    });
}

//! Open volumes of all ranks by label.
std::map<double, double> volumes(Grid const& grid, Field const& label, par::Communicator const& comm)
{
    std::map<double, double> own;
    for_each_cell(grid, [&](int, int, int, Index cell) {
        if (grid.open(cell)) own[label[cell]] += grid.open_volume[cell];
    });
    std::vector<double> pairs;
    for (auto const& [name, volume] : own) pairs.insert(pairs.end(), {name, volume});
    auto bytes = comm.gather(std::as_bytes(std::span<double const>(pairs)));
    comm.broadcast(bytes);
    pairs.resize(bytes.size() / sizeof(double));
    if (!bytes.empty()) std::memcpy(pairs.data(), bytes.data(), bytes.size());
    std::map<double, double> out;
    for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) out[pairs[k]] += pairs[k + 1];
    return out;
}
}

void close_pockets(Grid& grid, par::Communicator const& comm)
{
    Field label = grid.make_field();
    for_each_cell(grid, [&](int i, int j, int k, Index cell) {
        auto const& [nx, ny, nz] = grid.global;
        label[cell] = i + grid.shift[0] +
                      static_cast<double>(nx) * (j + grid.shift[1] + static_cast<double>(ny) * (k + grid.shift[2]));
    });
    refresh(grid, {&label});
    for (bool changed = true; changed;) {
        Field const before = label;
        spread(grid, label);
        refresh(grid, {&label});
        changed = comm.max(label == before ? 0L : 1L) > 0;
    }
    auto const parts = volumes(grid, label, comm);
    if (parts.size() <= 1) return;
    double const kept = std::max_element(parts.begin(), parts.end(), [](auto const& one, auto const& other) {
                            return one.second < other.second;
                        })->first;
    for_each_cell(grid, [&](int, int, int, Index cell) {
        if (label[cell] == kept) return;
        grid.open_volume[cell] = 0;
        for (std::size_t d = 0; d < 3; ++d) grid.open_area[d][cell] = grid.open_area[d][grid.next(cell, d)] = 0;
    });
    refresh(grid, {&grid.open_volume, &grid.open_area[0], &grid.open_area[1], &grid.open_area[2]});
}
}
