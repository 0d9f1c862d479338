// Cells that change ranks while a run goes on: the same cells with the same gas, elsewhere.
#include "granum/grid/recut.hpp"
#include "granum/grid/halo.hpp"
#include "unit/gas/chamber_with_gas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace granum;

namespace
{
//! A layout of the cells of `grid` in which the first rank has most of the work.
grid::Layout uneven_layout(grid::Grid const& grid, par::Communicator const& comm)
{
    auto const& layout = grid.halo->layout();
    par::Space space{.box = {}, .periodic = layout.periodic};
    for (std::size_t d = 0; d < 3; ++d)
        space.box.lower[d] = grid.lines[d].front(), space.box.upper[d] = grid.lines[d].back();
    std::vector<math::Vec3> points;
    std::vector<double> work;
    grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index) {
        points.push_back(grid.centre(i, j, k));
        work.push_back(1.0 + 4.0 * (k + grid.shift[2]) + (i + grid.shift[0]));
    });
    return grid::layout(par::Partition::balanced(space, points, work, comm, &grid.lines), grid.lines);
}

double of_place(grid::Grid const& grid, int i, int j, int k)
{
    return 1.0 + (i + grid.shift[0]) + 100.0 * (j + grid.shift[1]) + 1e4 * (k + grid.shift[2]);
}
}

TEST(Recut, cells_are_those_that_would_have_been_built_there)
{
    par::Communicator const comm;
    auto const chamber = gas::laboratory_chamber();
    for (std::array<bool, 3> const periodic : {std::array{false, false, false}, std::array{true, false, true}}) {
        auto const from = gas::cut(chamber, {9, 10, 14}, periodic, comm);
        auto const layout = uneven_layout(from, comm);
        if (comm.size() > 1) {
            bool other = false;
            for (int rank = 0; rank < comm.size(); ++rank)
                other = other || layout.box(rank).upper != from.halo->layout().box(rank).upper;
            ASSERT_TRUE(other) << "the cuts must differ for this test to show anything";
        }
        auto const to = grid::recut(from, layout, comm);
        auto const built = grid::build(grid::openness(chamber), from.lines, layout, comm);
        EXPECT_EQ(to.n, built.n);
        EXPECT_EQ(to.open_volume, built.open_volume);
        for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(to.open_area[d], built.open_area[d]);
    }
}

TEST(Recut, fields_go_with_their_cells_ghosts_beyond_the_ends_too)
{
    par::Communicator const comm;
    auto const from = gas::cut(geometry::Chamber{.size = {1, 1, 1}}, {7, 6, 8}, {false, true, false}, comm);
    auto field = from.make_field(), twice = from.make_field();
    // Beyond the ends along x and z as well: there lie the faces of inlets and outlets.
    for (int k = -1; k <= from.n[2]; ++k)
        for (int j = 0; j < from.n[1]; ++j)
            for (int i = -1; i <= from.n[0]; ++i) {
                field[from.at(i, j, k)] = of_place(from, i, j, k);
                twice[from.at(i, j, k)] = 2 * of_place(from, i, j, k);
            }
    auto const to = grid::recut(from, uneven_layout(from, comm), comm);
    std::array<grid::Field*, 2> const fields{&field, &twice};
    grid::move(from, to, comm, fields);
    for (int k = -1; k <= to.n[2]; ++k)
        for (int j = 0; j < to.n[1]; ++j)
            for (int i = -1; i <= to.n[0]; ++i) {
                EXPECT_EQ(field[to.at(i, j, k)], of_place(to, i, j, k));
                EXPECT_EQ(twice[to.at(i, j, k)], 2 * of_place(to, i, j, k));
            }
}

TEST(Recut, a_run_goes_on_as_if_nothing_had_been_moved)
{
    gas::Settings settings;
    settings.inlets = {gas::Inlet{.mass_flow = 0.04, .temperature = 353.15, .vapour_fraction = 0.008}};
    settings.tolerance = 1e-12;
    auto const bed = [](grid::Grid const& grid, grid::Field& voidage, gas::Sources& sources, int step) {
        grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
            bool const filled = k + grid.shift[2] < 5 && grid.open(c);
            double const wave = std::sin(0.1 * step + 0.6 * (i + grid.shift[0])) * std::cos(0.5 * (j + grid.shift[1]));
            voidage[c] = filled ? 0.6 + 0.1 * wave : 1;
            sources.drag_coefficient[c] = filled ? 2000 * grid.open_volume[c] : 0;
            sources.drag_momentum[0][c] = sources.drag_coefficient[c] * 0.2 * wave;
            sources.heat_coefficient[c] = filled ? 1e4 * grid.open_volume[c] : 0;
            sources.heat_value[c] = 40 * sources.heat_coefficient[c];
        });
    };
    gas::ChamberWithGas still(gas::laboratory_chamber(), {8, 8, 16}, {}, settings, 320, 0.01, {}, MPI_COMM_WORLD);
    gas::ChamberWithGas begun(gas::laboratory_chamber(), {8, 8, 16}, {}, settings, 320, 0.01, {}, MPI_COMM_WORLD);
    auto const& comm = still.comm;
    int step = 0;
    for (; step < 20; ++step) {
        for (auto* run : {&still, &begun}) {
            bed(run->grid, run->voidage, run->sources, step);
            run->step(1e-3);
        }
    }
    auto const grid = grid::recut(begun.grid, uneven_layout(begun.grid, comm), comm);
    auto correction = begun.solver.correction();
    std::vector<grid::Field*> fields{&correction};
    for (auto const& [name, field] : begun.state.fields()) fields.push_back(field);
    grid::move(begun.grid, grid, comm, fields);
    gas::Solver solver(settings, grid, comm);
    solver.recall(std::move(correction), std::nullopt);
    gas::Sources sources;
    sources.clear(grid);
    auto voidage = grid.make_field(1);
    for (; step < 40; ++step) {
        bed(still.grid, still.voidage, still.sources, step);
        bed(grid, voidage, sources, step);
        still.step(1e-3);
        solver.advance(begun.state, sources, voidage, 1e-3);
    }
    fields.erase(fields.begin());
    grid::move(grid, still.grid, comm, fields);
    double most = 0, least_change = 0;
    auto const mine = still.state.fields();
    auto const other = begun.state.fields();
    for (std::size_t f = 0; f < mine.size(); ++f) {
        double off = 0, largest = 0;
        grid::for_each_cell(still.grid, [&](int, int, int, grid::Index c) {
            off = std::max(off, std::abs((*mine[f].second)[c] - (*other[f].second)[c]));
            largest = std::max(largest, std::abs((*mine[f].second)[c]));
        });
        std::array<double, 2> both{off, largest};
        comm.max(both);
        EXPECT_LT(both[0], 1e-10 * std::max(both[1], 1e-300)) << mine[f].first;
        most = std::max(most, both[0] / std::max(both[1], 1e-300));
        least_change = std::max(least_change, both[1]);
    }
    EXPECT_GT(least_change, 0);
    RecordProperty("largest_relative_difference", std::to_string(most));
}
