// The cut cells: what is open adds up, ghosts agree with their owners, ranks agree with each other.
#include "granum/grid/build.hpp"

#include "granum/math/constants.hpp"
#include "scene/cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace granum;
using geometry::Chamber;

namespace
{
Chamber cone()
{
    return {.shape = Chamber::Shape::revolution, .profile = {{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}}};
}

grid::Lines lines(Chamber const& chamber, std::array<int, 3> cells)
{
    return grid::uniform_lines(chamber.lower(), chamber.upper(), cells);
}

grid::Grid whole(Chamber const& chamber, std::array<int, 3> cells, std::array<bool, 3> periodic = {})
{
    return cut_evenly(chamber, lines(chamber, cells), periodic, par::Communicator(MPI_COMM_SELF));
}
}

TEST(Build, total_volume_is_the_chamber)
{
    auto const grid = whole(cone(), {16, 16, 64});
    double sum = 0;
    for (double v : grid.open_volume) sum += v;
    EXPECT_NEAR(sum / cone().volume(), 1, 1e-4);
}

TEST(Build, every_horizontal_plane_is_open_as_the_cone)
{
    for (std::array<int, 3> cells : {std::array{16, 16, 64}, std::array{10, 10, 40}, std::array{13, 13, 20}}) {
        auto const grid = whole(cone(), cells);
        for (int k = 0; k <= cells[2]; ++k) {
            double sum = 0;
            for (int j = 0; j < cells[1]; ++j)
                for (int i = 0; i < cells[0]; ++i) sum += grid.open_area[2][grid.at(i, j, k)];
            double const exact = cone().area(k * grid.axes[2].width(0));
            EXPECT_NEAR(sum / exact, 1, 0.01) << "plane " << k << " of " << cells[2];
            if (k > cells[2] / 2) {
                EXPECT_NEAR(sum / exact, 1, 1e-4);
            }
        }
    }
}

TEST(Build, a_face_is_open_only_between_open_cells)
{
    auto const grid = whole(cone(), {16, 16, 64});
    int open = 0;
    grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
        for (std::size_t d = 0; d < 3; ++d) {
            if (grid.open_area[d][c] == 0) continue;
            ++open;
            EXPECT_TRUE(grid.open(c));
            if (!(d == 2 && k == 0)) {
                EXPECT_TRUE(grid.open(grid.before(c, d)));
            }
            EXPECT_LE(grid.open_area[d][c], grid.area(d, {i, j, k}) * (1 + 1e-12));
        }
    });
    EXPECT_GT(open, 10000);
}

TEST(Build, ends_are_as_open_as_the_cells_there)
{
    auto const grid = whole(Chamber{.size = {1, 1, 2}}, {2, 3, 4});
    EXPECT_DOUBLE_EQ(grid.open_area[0][grid.at(0, 1, 1)], 1.0 / 6);
    EXPECT_DOUBLE_EQ(grid.open_area[1][grid.at(1, 3, 1)], 1.0 / 4);
    EXPECT_DOUBLE_EQ(grid.open_area[2][grid.at(1, 1, 0)], 1.0 / 6);
    EXPECT_DOUBLE_EQ(grid.open_area[2][grid.at(1, 1, 4)], 1.0 / 6);
    EXPECT_EQ(grid.open_volume[grid.at(1, 1, 4)], 0);
}

TEST(Build, periodic_ghosts_are_the_cells_they_image)
{
    auto const grid = whole(Chamber{.size = {1, 1, 1}}, {3, 2, 4}, {true, true, true});
    for (double v : grid.open_volume) EXPECT_DOUBLE_EQ(v, 1.0 / 24);
    for (std::size_t d = 0; d < 3; ++d)
        for (double a : grid.open_area[d]) EXPECT_NEAR(a, grid.area(d, {0, 0, 0}), 1e-15);
}

TEST(Build, cells_may_be_stretched)
{
    Chamber const box{.size = {1, 1, 1}};
    auto faces = lines(box, {4, 4, 4});
    faces[2] = {0, 0.1, 0.25, 0.5, 1};
    auto const grid = cut_evenly(box, faces, {}, par::Communicator(MPI_COMM_SELF));
    auto const& z = grid.axes[2];
    EXPECT_FALSE(z.uniform());
    EXPECT_DOUBLE_EQ(z.width(3), 0.5);
    EXPECT_DOUBLE_EQ(z.gap(1), 0.125);
    EXPECT_DOUBLE_EQ(z.width(-1), 0.1);  // a ghost is as wide as its neighbour
    EXPECT_DOUBLE_EQ(grid.open_volume[grid.at(0, 0, 3)], 0.5 / 16);
    for (double const x : {0.0, 0.05, 0.1, 0.17, 0.25, 0.499, 0.5, 0.99}) {
        int const cell = z.cell(x);
        EXPECT_LE(z.face(cell), x);
        EXPECT_GT(z.face(cell + 1), x);
    }
    EXPECT_EQ(z.cell(-0.01), -1);
    EXPECT_EQ(z.cell(1.0), 4);
}

TEST(Build, boxes_of_ranks_carry_the_geometry_of_the_whole)
{
    // Any cut of the cells into boxes, T-joints included: every rank sees of the cone what one rank sees.
    std::array<int, 3> const cells{9, 8, 12};
    auto const faces = lines(cone(), cells);
    auto const all = whole(cone(), cells);
    grid::Layout layout{.cells = cells, .periodic = {}, .boxes = {}};
    layout.boxes = {{{0, 0, 0}, {9, 8, 5}}, {{0, 0, 5}, {4, 8, 12}}, {{4, 0, 5}, {9, 3, 12}}, {{4, 3, 5}, {9, 8, 12}}};
    for (auto const& box : layout.boxes) {
        // What one rank cuts without asking others: its cells, and the faces between them.
        grid::Layout alone{.cells = cells, .periodic = {}, .boxes = {box}};
        auto const part = grid::build(grid::openness(cone()), faces, alone, par::Communicator(MPI_COMM_SELF));
        grid::for_each_cell(part, [&](int i, int j, int k, grid::Index here) {
            auto const there = all.at(i + part.shift[0], j + part.shift[1], k + part.shift[2]);
            EXPECT_EQ(part.open_volume[here], all.open_volume[there]);
            std::array<int, 3> const cell{i, j, k};
            for (std::size_t d = 0; d < 3; ++d) {
                if (cell[d] > 0) {
                    EXPECT_EQ(part.open_area[d][here], all.open_area[d][there]);
                }
            }
        });
    }
}
