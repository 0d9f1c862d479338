// The pressure solver: every method reaches the answer of the plain reference, and answers known in closed form.
#include "granum/solve/pressure.hpp"

#include "granum/geometry/chamber.hpp"
#include "scene/bed_system.hpp"
#include "scene/cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace granum;
using solve::Method;

namespace
{
constexpr std::array<Method, 3> fast_methods{Method::multigrid, Method::pfmg, Method::smg};

struct Scene
{
    std::array<int, 3> cells{12, 10, 24};
    std::array<bool, 3> periodic{};
    math::Vec3 width{1, 1, 1};  // of a cell
    double stretch = 1;         // from cell to cell along z
    bool conical = false;
    BedSystem bed{};
    std::vector<Method> methods{fast_methods.begin(), fast_methods.end()};
};

grid::Grid cells_of(Scene const& scene, par::Communicator const& comm)
{
    math::Vec3 upper;
    for (std::size_t d = 0; d < 3; ++d) upper[d] = scene.cells[d] * scene.width[d];
    auto lines = grid::uniform_lines({}, upper, scene.cells);
    double z = 0, width = scene.width.z;
    for (auto& face : lines[2]) face = z, z += width, width *= scene.stretch;
    geometry::Chamber chamber{.size = {upper.x, upper.y, lines[2].back()}};
    if (scene.conical) {
        double const radius = upper.x / 2;
        chamber = {.shape = geometry::Chamber::Shape::revolution,
                   .profile = {{0, 0.72 * radius}, {0.45 * upper.z, radius}, {upper.z, radius}}};
        lines = grid::uniform_lines(chamber.lower(), chamber.upper(), scene.cells);
    }
    return cut_evenly(chamber, lines, scene.periodic, comm);
}

double largest_difference(grid::Grid const& grid, grid::Field const& a, grid::Field const& b)
{
    double worst = 0;
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) { worst = std::max(worst, std::abs(a[c] - b[c])); });
    return worst;
}

double largest(grid::Grid const& grid, grid::Field const& a)
{
    return largest_difference(grid, a, grid.make_field());
}

void expect_agreement(Scene const& scene)
{
    par::Communicator const comm;
    auto const grid = cells_of(scene, comm);
    auto const system = bed_system(grid, scene.bed);
    auto plain = grid.make_field();
    solve::Pressure reference(grid, comm, Method::diagonal);
    auto const slow = reference.solve(system, plain, 1e-12);
    ASSERT_TRUE(slow.converged);
    ASSERT_GT(largest(grid, plain), 0);
    for (Method const method : scene.methods) {
        SCOPED_TRACE(static_cast<int>(method));
        auto x = grid.make_field();
        solve::Pressure pressure(grid, comm, method);
        ASSERT_EQ(pressure.method(), method);
        auto const outcome = pressure.solve(system, x, 1e-12);
        EXPECT_TRUE(outcome.converged);
        EXPECT_LT(outcome.iterations, slow.iterations);
        EXPECT_LT(largest_difference(grid, x, plain), 1e-9 * largest(grid, plain));
    }
}
}

TEST(Pressure, methods_agree_in_a_cut_cone)
{
    expect_agreement({.cells = {12, 12, 32}, .conical = true});
    expect_agreement({.cells = {13, 13, 27}, .conical = true, .bed = {.outlet = false}});
}

TEST(Pressure, methods_agree_in_a_closed_box)
{
    expect_agreement({.bed = {.outlet = false}});
}

TEST(Pressure, methods_agree_in_periodic_boxes)
{
    expect_agreement({.cells = {16, 8, 32}, .periodic = {true, true, true}, .bed = {.outlet = false}});
    expect_agreement({.cells = {4, 4, 24}, .periodic = {true, true, false}});
    expect_agreement({.cells = {8, 6, 16}, .periodic = {true, false, false}, .bed = {.outlet = false}});
}

TEST(Pressure, methods_agree_where_cells_are_one_thick)
{
    expect_agreement({.cells = {1, 20, 40}});
    expect_agreement({.cells = {30, 1, 1}});
    expect_agreement({.cells = {1, 16, 16}, .periodic = {true, true, true}, .bed = {.outlet = false}});
}

TEST(Pressure, methods_agree_in_flat_and_in_stretched_cells)
{
    expect_agreement({.cells = {2, 15, 45}, .width = {7.5, 5, 5}});
    expect_agreement({.width = {1, 1, 6}});
    expect_agreement({.width = {5, 1, 0.3}});
    expect_agreement({.width = {1, 1, 0.4}, .stretch = 1.06});
}

TEST(Pressure, methods_agree_over_jumps_of_the_coefficients)
{
    expect_agreement({.bed = {.jump = 10}});
    expect_agreement({.bed = {.jump = 1000}});
}

TEST(Pressure, methods_agree_where_every_cell_has_an_extra)
{
    expect_agreement({.bed = {.extra = 0.05}});
    expect_agreement({.bed = {.outlet = false, .extra = 1e-3}});
}

TEST(Pressure, multigrid_takes_odd_periodic_sizes)
{
    for (auto const cells : {std::array{7, 5, 9}, std::array{15, 8, 31}, std::array{3, 1, 21}})
        expect_agreement(
            {.cells = cells, .periodic = {true, true, true}, .bed = {.outlet = false}, .methods = {Method::multigrid}});
}

TEST(Pressure, periodic_sizes_that_hypre_cannot_halve_use_the_own_multigrid)
{
    par::Communicator const comm;
    auto const grid = cells_of({.cells = {6, 5, 7}, .periodic = {true, true, true}}, comm);
    for (Method const method : {Method::pfmg, Method::smg})
        EXPECT_EQ(solve::Pressure(grid, comm, method).method(), Method::multigrid);
}

// Closed form: with equal links l a wave cos(k (i + 1/2)), k = pi m / n, between closed ends is an eigenvector of the
// matrix, of eigenvalue 2 l (1 - cos k); in several directions the eigenvalues add up.
TEST(Pressure, a_wave_in_a_closed_box_is_found)
{
    par::Communicator const comm;
    Scene const scene{.cells = {9, 14, 20}};
    auto const grid = cells_of(scene, comm);
    solve::System system(grid);
    std::array<double, 3> const links{1, 0.5, 2}, waves{2, 1, 3};
    auto exact = grid.make_field();
    double eigenvalue = 0;
    for (std::size_t d = 0; d < 3; ++d)
        eigenvalue += 2 * links[d] * (1 - std::cos(std::numbers::pi * waves[d] / scene.cells[d]));
    grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
        std::array<int, 3> const cell{i, j, k};
        exact[c] = 1;
        for (std::size_t d = 0; d < 3; ++d) {
            system.link[d][c] = cell[d] > 0 ? links[d] : 0;
            exact[c] *= std::cos(std::numbers::pi * waves[d] * (cell[d] + 0.5) / scene.cells[d]);
        }
        system.right[c] = eigenvalue * exact[c];
    });
    for (Method const method : fast_methods) {
        auto x = grid.make_field();
        solve::Pressure(grid, comm, method).solve(system, x, 1e-12);
        EXPECT_LT(largest_difference(grid, x, exact), 1e-10) << static_cast<int>(method);
    }
}

// Closed form: what enters at the lower end passes all links l_k of a column and the outlet e, so that x at the lower
// end is the sum of 1 / l_k, plus 1 / e.
TEST(Pressure, a_column_is_a_row_of_resistances)
{
    par::Communicator const comm;
    auto const grid = cells_of({.cells = {1, 1, 150}}, comm);
    solve::System system(grid);
    double sum = 1 / 0.3;
    for (int k = 1; k < 150; ++k) {
        double const link = k < 70 ? 0.01 * (1 + k % 3) : 1.0;
        system.link[2][grid.at(0, 0, k)] = link;
        sum += 1 / link;
    }
    system.right[grid.at(0, 0, 0)] = 1;
    system.extra[grid.at(0, 0, 149)] = 0.3;
    for (Method const method : fast_methods) {
        auto x = grid.make_field();
        solve::Pressure(grid, comm, method).solve(system, x, 1e-13);
        EXPECT_NEAR(x[grid.at(0, 0, 0)], sum, 1e-9 * sum) << static_cast<int>(method);
        EXPECT_NEAR(x[grid.at(0, 0, 149)], 1 / 0.3, 1e-9 * sum) << static_cast<int>(method);
    }
}

TEST(Pressure, solution_satisfies_the_equation_of_each_cell)
{
    par::Communicator const comm;
    auto const grid = cells_of({.cells = {8, 8, 16}, .conical = true}, comm);
    auto const system = bed_system(grid);
    auto x = grid.make_field();
    solve::Pressure(grid, comm, Method::multigrid).solve(system, x, 1e-13);
    double const scale = largest(grid, system.right);
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) {
        if (!grid.open(c)) return;
        double sum = system.extra[c] * x[c];
        for (std::size_t d = 0; d < 3; ++d) {
            auto const up = grid.next(c, d), down = grid.before(c, d);
            sum += system.link[d][c] * (x[c] - x[down]) + system.link[d][up] * (x[c] - x[up]);
        }
        EXPECT_NEAR(sum, system.right[c], 1e-11 * scale);
    });
}

TEST(Pressure, numbers_of_any_size_are_solved_for)
{
    par::Communicator const comm;
    auto const grid = cells_of({}, comm);
    auto const plain = bed_system(grid);
    auto x = grid.make_field();
    solve::Pressure pressure(grid, comm, Method::multigrid);
    auto const iterations = pressure.solve(plain, x, 1e-8).iterations;
    for (double const factor : {1e-60, 1e60}) {
        auto scaled = plain;
        for (auto* field : {&scaled.link[0], &scaled.link[1], &scaled.link[2], &scaled.extra})
            for (double& value : *field) value *= factor;
        auto y = grid.make_field();
        EXPECT_LE(pressure.solve(scaled, y, 1e-8).iterations, iterations + 1);
        for (double& value : y) value *= factor;
        EXPECT_LT(largest_difference(grid, x, y), 1e-6 * largest(grid, x));
    }
}

TEST(Pressure, a_kept_set_up_still_solves_a_changed_matrix)
{
    par::Communicator const comm;
    auto const grid = cells_of({.cells = {8, 8, 16}}, comm);
    for (Method const method : fast_methods) {
        auto system = bed_system(grid);
        solve::Pressure kept(grid, comm, method), fresh(grid, comm, Method::diagonal);
        auto x = grid.make_field(), y = grid.make_field();
        kept.solve(system, x, 1e-10);
        for (auto& links : system.link)
            for (std::size_t c = 0; c < links.size(); ++c)
                links[c] *= 1 + 0.3 * std::sin(0.37 * static_cast<double>(c));
        grid::refresh(grid, {&system.link[0], &system.link[1], &system.link[2]});
        EXPECT_TRUE(kept.solve(system, x, 1e-12).converged);
        EXPECT_TRUE(fresh.solve(system, y, 1e-12).converged);
        EXPECT_LT(largest_difference(grid, x, y), 1e-9 * largest(grid, y));
    }
}

TEST(Pressure, with_its_memory_recalled_a_new_solver_goes_on_with_the_same_bits)
{
    par::Communicator const comm;
    auto const grid = cells_of({.cells = {8, 8, 16}}, comm);
    auto const first = bed_system(grid), second = bed_system(grid, {.jump = 7, .noise = 0.5});
    for (Method const method : fast_methods) {
        solve::Pressure one(grid, comm, method), other(grid, comm, method);
        auto x = grid.make_field();
        one.solve(first, x, 1e-6);
        EXPECT_EQ(one.memory().set_up, method != Method::multigrid);
        other.recall(one.memory());
        auto y = x;
        one.solve(second, x, 1e-6);
        other.solve(second, y, 1e-6);
        EXPECT_EQ(x, y) << static_cast<int>(method);
    }
}

TEST(Pressure, a_good_first_guess_is_used_and_a_bad_one_dropped)
{
    par::Communicator const comm;
    auto const grid = cells_of({}, comm);
    auto const system = bed_system(grid);
    auto x = grid.make_field();
    solve::Pressure pressure(grid, comm, Method::multigrid);
    auto const cold = pressure.solve(system, x, 1e-6).iterations;
    EXPECT_EQ(pressure.solve(system, x, 1e-5).iterations, 0);
    auto bad = x;
    for (std::size_t c = 0; c < bad.size(); ++c) bad[c] *= 1e6 * std::cos(2.0 * static_cast<double>(c));
    EXPECT_EQ(pressure.solve(system, bad, 1e-6).iterations, cold);
}

// Measured: 8, 9 and 9 iterations.
TEST(Pressure, iterations_do_not_grow_with_the_number_of_cells)
{
    par::Communicator const comm;
    int fewest = 1000, most = 0;
    for (auto const& scene : {Scene{.cells = {2, 30, 90}, .width = {7.5, 5, 5}}, Scene{.cells = {32, 32, 128}},
                              Scene{.cells = {64, 64, 256}, .conical = true}}) {
        auto const grid = cells_of(scene, comm);
        auto const system = bed_system(grid);
        auto x = grid.make_field();
        auto const iterations = solve::Pressure(grid, comm, Method::multigrid).solve(system, x, 1e-6).iterations;
        fewest = std::min(fewest, iterations);
        most = std::max(most, iterations);
    }
    EXPECT_LE(most, 12);
    EXPECT_LE(most, 1.5 * fewest);
}
