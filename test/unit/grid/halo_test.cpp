// Ghost cells: refresh copies from the owner, fold is its adjoint.
#include "granum/grid/halo.hpp"

#include "granum/base/random.hpp"
#include "scene/cells.hpp"

#include <gtest/gtest.h>

using namespace granum;

namespace
{
grid::Grid periodic_grid(std::array<int, 3> n, std::array<bool, 3> periodic)
{
    geometry::Chamber const box{.size = {1, 1, 1}};
    return cut_evenly(box, grid::uniform_lines(box.lower(), box.upper(), n), periodic,
                      par::Communicator(MPI_COMM_SELF));
}

grid::Field random_field(grid::Grid const& grid, std::uint64_t id)
{
    base::Random random(7, base::Purpose::test, id, 0);
    auto field = grid.make_field();
    for (double& value : field) value = random.uniform() - 0.5;
    return field;
}

double dot(grid::Field const& a, grid::Field const& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}
}

TEST(Halo, refresh_fills_edges_and_corners)
{
    auto const grid = periodic_grid({4, 3, 2}, {true, true, true});
    auto field = grid.make_field(-1);
    grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) { field[c] = i + 10 * j + 100 * k; });
    std::array<grid::Field*, 1> const fields{&field};
    grid::refresh(grid, fields);
    for (int k = -1; k <= 2; ++k)
        for (int j = -1; j <= 3; ++j)
            for (int i = -1; i <= 4; ++i)
                EXPECT_EQ(field[grid.at(i, j, k)], (i + 4) % 4 + 10 * ((j + 3) % 3) + 100 * ((k + 2) % 2));
}

TEST(Halo, ghosts_beyond_a_wall_are_left_alone)
{
    auto const grid = periodic_grid({3, 3, 3}, {false, true, false});
    auto field = grid.make_field(5);
    std::array<grid::Field*, 1> const fields{&field};
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) { field[c] = 1; });
    grid::refresh(grid, fields);
    EXPECT_EQ(field[grid.at(-1, 1, 1)], 5);
    EXPECT_EQ(field[grid.at(1, 1, 3)], 5);
    EXPECT_EQ(field[grid.at(1, -1, 1)], 1);
}

TEST(Halo, fold_is_the_adjoint_of_refresh)
{
    // <refresh a, b> over all cells equals <a, fold b> over all cells, for any a and b.
    for (std::array<bool, 3> periodic : {std::array{true, true, true}, std::array{false, true, false}}) {
        auto const grid = periodic_grid({4, 3, 5}, periodic);
        auto const a = random_field(grid, 1), b = random_field(grid, 2);
        auto refreshed = a, folded = b;
        std::array<grid::Field*, 1> const up{&refreshed}, down{&folded};
        grid::refresh(grid, up);
        grid::fold(grid, down);
        EXPECT_NEAR(dot(refreshed, b), dot(a, folded), 1e-13);
        EXPECT_GT(std::abs(dot(refreshed, b) - dot(a, b)), 1e-3);
    }
}
