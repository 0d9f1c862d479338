// Cells of chambers with bodies: their volumes add up, and what nothing leads to is closed.
#include "granum/geometry/bodies_in_chamber.hpp"
#include "granum/grid/build.hpp"
#include "granum/grid/halo.hpp"
#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace
{
using namespace granum;
using namespace granum::geometry;

grid::Grid cells_of(Chamber const& chamber, std::array<int, 3> const& cells)
{
    auto const lines = grid::uniform_lines(chamber.lower(), chamber.upper(), cells);
    return grid::build(grid::openness(chamber), lines, grid::Layout{cells, {}, {{{0, 0, 0}, cells}}},
                       par::Communicator(MPI_COMM_SELF));
}

double open_volume(grid::Grid const& grid)
{
    double sum = 0;
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) { sum += grid.open_volume[c]; });
    return sum;
}

TEST(Pockets, within_a_hollow_body_are_closed_with_their_faces)
{
    Chamber const box{.size = {0.1, 0.1, 0.1}};
    // A box of 60 mm with walls of 11 mm around a hollow of 38 mm.
    auto const shell = Region("case", Box{{0.02, 0.02, 0.02}, {0.08, 0.08, 0.08}}) -
                       Region("hollow", Box{{0.031, 0.031, 0.031}, {0.069, 0.069, 0.069}});
    auto const grid = cells_of(with_bodies(box, {shell}), {20, 20, 20});
    EXPECT_NEAR(open_volume(grid), 1e-3 - 0.06 * 0.06 * 0.06, 1e-9);
    EXPECT_FALSE(grid.open(grid.at(10, 10, 10)));
    for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(grid.open_area[d][grid.at(10, 10, 10)], 0);
    EXPECT_TRUE(grid.open(grid.at(1, 10, 10)));
    EXPECT_GT(grid.open_area[2][grid.at(1, 10, 10)], 0);
}

TEST(Pockets, with_a_way_out_stay_open)
{
    Chamber const box{.size = {0.1, 0.1, 0.1}};
    auto const shell = Region("case", Box{{0.02, 0.02, 0.02}, {0.08, 0.08, 0.08}}) -
                       Region("hollow", Box{{0.031, 0.031, 0.031}, {0.069, 0.069, 0.069}}) -
                       Region("hole", cylinder({0.05, 0.05, 0.05}, {1, 0, 0}, 0.06, 0.008));
    auto const grid = cells_of(with_bodies(box, {shell}), {20, 20, 20});
    EXPECT_TRUE(grid.open(grid.at(10, 10, 10)));
    EXPECT_GT(open_volume(grid), 1e-3 - 0.06 * 0.06 * 0.06 + 0.038 * 0.038 * 0.038);
}

TEST(CellsOfSolids, add_up_to_the_volume_of_the_chamber)
{
    auto const open = (Region("cone", cone_frustum({0, 0, 0}, {0, 0, 1}, 0.2, 0.05, 0.1)) |
                       Region("column", cylinder({0, 0, 0.2}, {0, 0, 1}, 0.15, 0.1))) -
                      Region("tube", tube({0, 0, 0.02}, {0, 0, 1}, 0.2, 0.03, 0.032));
    double const exact = math::pi * (0.2 / 3 * (0.0025 + 0.005 + 0.01) + 0.01 * 0.15 - (0.032 * 0.032 - 9e-4) * 0.2);
    auto const grid = cells_of(chamber_of(open), {23, 23, 41});
    EXPECT_NEAR(open_volume(grid) / exact, 1, 5e-4);
    // The tube, a quarter of a cell thick, does not leak: what is in it is connected around its ends only.
    auto const& cell = grid.at(11, 11, 20);
    EXPECT_TRUE(grid.open(cell));
    double sideways = 0;
    for (int j = 0; j < grid.n[1]; ++j)
        for (int i = 0; i < grid.n[0]; ++i) {
            auto const middle = grid.centre(i, j, 20);
            auto const before = grid.centre(i - 1, j, 20);
            bool const in = std::hypot(middle.x, middle.y) < 0.031, was_in = std::hypot(before.x, before.y) < 0.031;
            if (in != was_in) sideways += grid.open_area[0][grid.at(i, j, 20)];
        }
    EXPECT_EQ(sideways, 0);
}

TEST(CellsOfSolids, have_a_face_each_and_no_faces_on_closed_cells)
{
    auto const open =
        Region("ball", Ball{{0, 0, 0.1}, 0.1}) - Region("rod", cylinder({0, 0, 0}, {0, 0.6, 0.8}, 0.3, 0.01));
    auto const grid = cells_of(chamber_of(open), {13, 14, 15});
    int seen = 0;
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) {
        double sum = 0;
        for (std::size_t d = 0; d < 3; ++d) sum += grid.open_area[d][c] + grid.open_area[d][grid.next(c, d)];
        EXPECT_EQ(sum > 0, grid.open(c));
        seen += grid.open(c);
    });
    EXPECT_GT(seen, 1000);
}
}
