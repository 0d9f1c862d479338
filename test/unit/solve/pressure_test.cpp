// The pressure solver: both preconditioners reach the same answer, singular systems included.
#include "granum/solve/pressure.hpp"

#include "granum/base/random.hpp"
#include "granum/geometry/chamber.hpp"
#include "granum/grid/build.hpp"
#include "granum/grid/halo.hpp"
#include "scene/cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;
using solve::Method;

namespace
{
enum class Ends
{
    open_top,
    closed
};

grid::Grid make_grid(std::array<int, 3> cells, std::array<bool, 3> periodic, par::Communicator const& comm,
                     bool conical)
{
    geometry::Chamber const chamber =
        conical ? geometry::Chamber{.shape = geometry::Chamber::Shape::revolution, .profile = {{0, 0.09}, {1, 0.125}}}
                : geometry::Chamber{.size = {1, 1.5, 2}};
    return cut_evenly(chamber, grid::uniform_lines(chamber.lower(), chamber.upper(), cells), periodic, comm);
}

//! Links from face areas with coefficients that vary fourfold from cell to cell; a right side of mixed signs.
solve::System make_system(grid::Grid const& grid, Ends ends)
{
    solve::System system(grid);
    auto at = [&](int i, int j, int k) {
        return static_cast<std::uint64_t>(i + grid.shift[0] +
                                          grid.global[0] * (j + grid.shift[1] + grid.global[1] * (k + grid.shift[2])));
    };
    grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
        base::Random random(3, base::Purpose::test, at(i, j, k), 0);
        for (std::size_t d = 0; d < 3; ++d) {
            std::array<int, 3> const cell{i, j, k};
            bool const end = cell[d] == 0 && grid.at_end(d, false);
            double const gap = grid.axes[d].gap(cell[d]);
            system.link[d][c] = end ? 0 : grid.open_area[d][c] / gap * (1 + 3 * random.uniform());
        }
        if (grid.open(c)) system.right[c] = random.uniform() - 0.4;
        if (ends == Ends::open_top && k == grid.n[2] - 1 && grid.at_end(2, true))
            system.extra[c] = grid.open_area[2][grid.at(i, j, k + 1)] / grid.axes[2].width(k) * 2;
    });
    grid::refresh(grid, {&system.link[0], &system.link[1], &system.link[2]});
    return system;
}

double largest_difference(grid::Grid const& grid, grid::Field const& a, grid::Field const& b)
{
    double worst = 0;
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) { worst = std::max(worst, std::abs(a[c] - b[c])); });
    return worst;
}

void expect_agreement(grid::Grid const& grid, par::Communicator const& comm, Ends ends)
{
    auto const system = make_system(grid, ends);
    auto x = grid.make_field(), y = grid.make_field();
    solve::Pressure fast(grid, comm, Method::multigrid), plain(grid, comm, Method::diagonal);
    ASSERT_EQ(fast.method(), Method::multigrid);
    auto const a = fast.solve(system, x, 1e-12);
    auto const b = plain.solve(system, y, 1e-12);
    EXPECT_TRUE(a.converged);
    EXPECT_TRUE(b.converged);
    EXPECT_LT(a.iterations, b.iterations / 2);
    double scale = 0;
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) { scale = std::max(scale, std::abs(y[c])); });
    EXPECT_GT(scale, 0);
    EXPECT_LT(largest_difference(grid, x, y), 1e-9 * scale);
}
}

TEST(Pressure, multigrid_equals_the_reference_in_a_cut_cone)
{
    par::Communicator const comm;
    expect_agreement(make_grid({12, 12, 32}, {}, comm, true), comm, Ends::open_top);
}

TEST(Pressure, multigrid_equals_the_reference_in_a_closed_box)
{
    par::Communicator const comm;
    expect_agreement(make_grid({12, 10, 24}, {}, comm, false), comm, Ends::closed);
}

TEST(Pressure, multigrid_equals_the_reference_in_a_periodic_box)
{
    par::Communicator const comm;
    expect_agreement(make_grid({16, 8, 32}, {true, true, true}, comm, false), comm, Ends::closed);
}

TEST(Pressure, multigrid_equals_the_reference_in_a_box_that_is_periodic_sideways)
{
    par::Communicator const comm;
    for (auto const ends : {Ends::closed, Ends::open_top}) {
        expect_agreement(make_grid({4, 4, 24}, {true, true, false}, comm, false), comm, ends);
        expect_agreement(make_grid({8, 6, 16}, {true, false, false}, comm, false), comm, ends);
    }
}

TEST(Pressure, periodic_sizes_that_hypre_cannot_halve_use_the_reference)
{
    par::Communicator const comm;
    auto const grid = make_grid({6, 5, 7}, {true, true, true}, comm, false);
    auto const system = make_system(grid, Ends::closed);
    auto x = grid.make_field();
    solve::Pressure pressure(grid, comm, Method::multigrid);
    EXPECT_EQ(pressure.method(), Method::diagonal);
    EXPECT_TRUE(pressure.solve(system, x, 1e-10).converged);
}

TEST(Pressure, solution_satisfies_the_equation_of_each_cell)
{
    par::Communicator const comm;
    auto const grid = make_grid({8, 8, 16}, {}, comm, true);
    auto const system = make_system(grid, Ends::open_top);
    auto x = grid.make_field();
    solve::Pressure pressure(grid, comm, Method::multigrid);
    pressure.solve(system, x, 1e-13);
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) {
        if (!grid.open(c)) return;
        double sum = system.extra[c] * x[c];
        for (std::size_t d = 0; d < 3; ++d) {
            auto const up = grid.next(c, d), down = grid.before(c, d);
            sum += system.link[d][c] * (x[c] - x[down]) + system.link[d][up] * (x[c] - x[up]);
        }
        EXPECT_NEAR(sum, system.right[c], 1e-9);
    });
}

TEST(Pressure, a_kept_set_up_still_solves_a_changed_matrix)
{
    par::Communicator const comm;
    auto const grid = make_grid({8, 8, 16}, {}, comm, false);
    auto system = make_system(grid, Ends::open_top);
    solve::Pressure kept(grid, comm, Method::multigrid), fresh(grid, comm, Method::diagonal);
    auto x = grid.make_field(), y = grid.make_field();
    kept.solve(system, x, 1e-10);
    for (auto& links : system.link)
        for (std::size_t c = 0; c < links.size(); ++c) links[c] *= 1 + 0.3 * std::sin(0.37 * static_cast<double>(c));
    grid::refresh(grid, {&system.link[0], &system.link[1], &system.link[2]});
    EXPECT_TRUE(kept.solve(system, x, 1e-12).converged);
    EXPECT_TRUE(fresh.solve(system, y, 1e-12).converged);
    EXPECT_LT(largest_difference(grid, x, y), 1e-8);
}
