// The cut cells: what is open adds up, ghosts agree with their owners, ranks agree with each other.
#include "granum/grid/build.hpp"

#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace granum;
using geometry::Chamber;

namespace
{
Chamber cone()
{
    return {.shape = Chamber::Shape::revolution, .profile = {{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}}};
}

par::Slabs cut(Chamber const& chamber, std::array<int, 3> cells, bool periodic, int ranks)
{
    double const width = (chamber.upper().x - chamber.lower().x) / cells[0];
    return par::Slabs::balanced(chamber.lower().x, width, periodic, grid::column_weights(chamber, cells), ranks);
}

grid::Grid whole(Chamber const& chamber, std::array<int, 3> cells, std::array<bool, 3> periodic = {})
{
    return grid::build(chamber, cells, periodic, cut(chamber, cells, periodic[0], 1), 0);
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
            double const exact = cone().area(k * grid.spacing.z);
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
    auto const s = grid.strides();
    int open = 0;
    grid::for_each_cell(grid, [&](int, int, int k, grid::Index c) {
        for (std::size_t d = 0; d < 3; ++d) {
            if (grid.open_area[d][c] == 0) continue;
            ++open;
            EXPECT_TRUE(grid.open(c));
            if (!(d == 2 && k == 0)) {
                EXPECT_TRUE(grid.open(c - static_cast<grid::Index>(s[d])));
            }
            EXPECT_LE(grid.open_area[d][c], grid.area(static_cast<int>(d)) * (1 + 1e-12));
        }
    });
    EXPECT_GT(open, 10000);
}

TEST(Build, box_ends_are_closed_at_the_sides_and_open_at_plate_and_top)
{
    auto const grid = whole(Chamber{.size = {1, 1, 2}}, {2, 3, 4});
    EXPECT_EQ(grid.open_area[0][grid.at(0, 1, 1)], 0);
    EXPECT_EQ(grid.open_area[0][grid.at(2, 1, 1)], 0);
    EXPECT_EQ(grid.open_area[1][grid.at(1, 3, 1)], 0);
    EXPECT_DOUBLE_EQ(grid.open_area[2][grid.at(1, 1, 0)], 1.0 / 6);
    EXPECT_DOUBLE_EQ(grid.open_area[2][grid.at(1, 1, 4)], 1.0 / 6);
    EXPECT_EQ(grid.open_volume[grid.at(1, 1, 4)], 0);
}

TEST(Build, periodic_ghosts_are_the_cells_they_image)
{
    auto const grid = whole(Chamber{.size = {1, 1, 1}}, {3, 2, 4}, {true, true, true});
    for (double v : grid.open_volume) EXPECT_DOUBLE_EQ(v, 1.0 / 24);
    for (std::size_t d = 0; d < 3; ++d)
        for (double a : grid.open_area[d]) EXPECT_NEAR(a, grid.area(static_cast<int>(d)), 1e-15);
}

TEST(Build, slabs_carry_the_geometry_of_the_whole)
{
    std::array<int, 3> const cells{9, 9, 12};
    auto const all = whole(cone(), cells);
    auto const slabs = cut(cone(), cells, false, 3);
    for (int rank = 0; rank < 3; ++rank) {
        auto const part = grid::build(cone(), cells, {}, slabs, rank);
        for (int k = 0; k <= cells[2]; ++k)
            for (int j = 0; j <= cells[1]; ++j)
                for (int i = -1; i <= part.n[0]; ++i) {
                    auto const here = part.at(i, j, k), there = all.at(i + part.shift, j, k);
                    EXPECT_EQ(part.open_volume[here], all.open_volume[there]);
                    for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(part.open_area[d][here], all.open_area[d][there]);
                }
    }
}

TEST(ColumnWeights, sum_to_the_volume_and_are_symmetric)
{
    auto const weights = grid::column_weights(cone(), {10, 10, 20});
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0) / cone().volume(), 1, 1e-12);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(weights[i] / weights[9 - i], 1, 1e-12);
}
