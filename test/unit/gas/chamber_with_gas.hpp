// A chamber, its cells and a gas solver in one hand, for tests.
#pragma once

#include "granum/gas/flow.hpp"
#include "granum/geometry/chamber.hpp"
#include "granum/grid/build.hpp"
#include "scene/cells.hpp"

namespace granum::gas
{
//! The cells of this rank: all ranks have about as many.
inline grid::Grid cut(geometry::Chamber const& chamber, std::array<int, 3> cells, std::array<bool, 3> periodic,
                      par::Communicator const& comm)
{
    return cut_evenly(chamber, grid::uniform_lines(chamber.lower(), chamber.upper(), cells), periodic, comm);
}

struct ChamberWithGas
{
    geometry::Chamber chamber;
    par::Communicator comm;
    grid::Grid grid;
    Solver solver;
    Field voidage;
    Sources sources;
    State state;

    ChamberWithGas(geometry::Chamber shape, std::array<int, 3> cells, std::array<bool, 3> periodic, Settings settings,
                   double temperature = 293.15, double vapour = 0, Vec3 velocity = {}, MPI_Comm ranks = MPI_COMM_SELF)
        : chamber(std::move(shape)),
          comm(ranks),
          grid(cut(chamber, cells, periodic, comm)),
          solver(std::move(settings), grid, comm),
          voidage(grid.make_field(1)),
          state(solver.start(voidage, grid.make_field(temperature), vapour, velocity))
    {
        sources.clear(grid);
    }

    Balance step(double dt) { return solver.advance(state, sources, voidage, dt); }
    double sum(Field const& field) const
    {
        double total = 0;
        grid::for_each_cell(grid, [&](int, int, int, grid::Index c) { total += field[c]; });
        return comm.sum(total);
    }
    double at(Field const& field, int i, int j, int k) const { return field[grid.at(i, j, k)]; }
};

//! 16 x 16 x 64 cells of the laboratory chamber.
inline geometry::Chamber laboratory_chamber()
{
    return {.shape = geometry::Chamber::Shape::revolution, .profile = {{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}}};
}
}
