#include "granum/solve/whole.hpp"

#include "granum/grid/halo.hpp"

namespace granum::solve
{
namespace
{
grid::Grid all_cells(grid::Grid const& part, par::Communicator const& self)
{
    grid::Layout layout = part.halo->layout();
    layout.boxes = {grid::CellBox{{}, layout.cells}};
    grid::Grid grid;
    static_cast<grid::Shape&>(grid) = grid::Shape(layout.cells);
    grid.global = layout.cells;
    grid.periodic = layout.periodic;
    grid.halo = std::make_shared<grid::Halo const>(layout, grid, 0, self);
    return grid;
}

//! Links, extras, right sides and x.
constexpr std::size_t numbers_per_cell = 6;
}

Whole::Whole(grid::Grid const& part, par::Communicator const& comm)
    : part_(part),
      comm_(comm),
      self_(MPI_COMM_SELF),
      grid_(all_cells(part, self_)),
      system_(grid_),
      x_(grid_.make_field()),
      pressure_(grid_, self_, Method::multigrid)
{
    std::size_t sum = 0;
    for (auto const& box : part.halo->layout().boxes) {
        auto const numbers = numbers_per_cell * static_cast<std::size_t>(box.cells());
        counts_.push_back(static_cast<int>(numbers));
        sum += numbers;
    }
    mine_.resize(static_cast<std::size_t>(counts_[static_cast<std::size_t>(comm.rank())]));
    all_.resize(sum);
}

Outcome Whole::solve(System const& system, Field& x, double tolerance, double floor)
{
    auto to = mine_.begin();
    auto const& layout = part_.halo->layout();
    auto const for_box = [](std::array<int, 3> const& low, std::array<int, 3> const& end, auto&& visit) {
        for (int k = low[2]; k < end[2]; ++k)
            for (int j = low[1]; j < end[1]; ++j)
                for (int i = low[0]; i < end[0]; ++i) visit(i, j, k);
    };
    for_box({0, 0, 0}, part_.n, [&](int i, int j, int k) {
        auto const c = part_.at(i, j, k);
        for (auto const* field : {&system.link[0], &system.link[1], &system.link[2], &system.extra, &system.right})
            *to++ = (*field)[c];
        *to++ = x[c];
    });
    comm_.share(mine_, all_, counts_);
    auto from = all_.begin();
    for (auto const& box : layout.boxes)
        for_box(box.lower, box.upper, [&](int i, int j, int k) {
            auto const c = grid_.at(i, j, k);
            for (auto* field : {&system_.link[0], &system_.link[1], &system_.link[2], &system_.extra, &system_.right})
                (*field)[c] = *from++;
            x_[c] = *from++;
        });
    grid::refresh(grid_, {&system_.link[0], &system_.link[1], &system_.link[2]});

    auto const outcome = pressure_.solve(system_, x_, tolerance, floor);
    for_box({0, 0, 0}, part_.n, [&](int i, int j, int k) {
        x[part_.at(i, j, k)] = x_[grid_.at(i + part_.shift[0], j + part_.shift[1], k + part_.shift[2])];
    });
    grid::refresh(part_, {&x});
    return outcome;
}
}
