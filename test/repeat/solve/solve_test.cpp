// The pressure equation on one rank and on several, whose boxes are uneven and meet in T-joints.
#include "granum/solve/multigrid.hpp"
#include "scene/bed_system.hpp"

#include "granum/grid/build.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;
using grid::CellBox;

namespace
{
//! Boxes by rank; each list fills the same cells.
struct Scene
{
    std::array<int, 3> cells;
    std::array<bool, 3> periodic{};
    BedSystem bed{};
    bool conical = false;
};

//! Cuts at odd and even cells, boxes one cell thick among them.
std::vector<CellBox> boxes_of(std::array<int, 3> const& n, int ranks)
{
    auto const [x, y, z] = n;
    int const a = x > 4 ? 3 : x / 2, b = y > 5 ? 5 : y / 2, c = z / 3;
    switch (ranks) {
        case 1:
            return {{{0, 0, 0}, n}};
        case 2:
            return {{{0, 0, 0}, {x, y, c}}, {{0, 0, c}, n}};
        case 3:
            return {{{0, 0, 0}, {x, y, c + 1}}, {{0, 0, c + 1}, {x, b, z}}, {{0, b, c + 1}, n}};
        default:
            return {{{0, 0, 0}, {x, y, c}}, {{0, 0, c}, {x, y, c + 1}}, {{0, 0, c + 1}, {a, y, z}}, {{a, 0, c + 1}, n}};
    }
}

grid::Grid cells_of(Scene const& scene, par::Communicator const& comm)
{
    geometry::Chamber chamber{.size = {1, 1, 2}};
    if (scene.conical)
        chamber = {.shape = geometry::Chamber::Shape::revolution, .profile = {{0, 0.35}, {1, 0.5}, {2, 0.5}}};
    auto const lines = grid::uniform_lines(chamber.lower(), chamber.upper(), scene.cells);
    grid::Layout const layout{scene.cells, scene.periodic, boxes_of(scene.cells, comm.size())};
    return grid::build(grid::openness(chamber), lines, layout, comm);
}

struct Case
{
    par::Communicator comm;
    grid::Grid grid;
    solve::System system;

    Case(Scene const& scene, MPI_Comm ranks)
        : comm(ranks), grid(cells_of(scene, comm)), system(bed_system(grid, scene.bed))
    {
    }

    //! One cycle of the multigrid on the right side. It does not ask that its mean be zero.
    grid::Field cycle(long few) const
    {
        solve::Multigrid multigrid(grid, comm, few);
        auto diagonal = grid.make_field(), out = grid.make_field();
        double most = 0;
        grid::for_each_cell(grid, [&](int, int, int, grid::Index c) {
            diagonal[c] = system.extra[c];
            for (std::size_t d = 0; d < 3; ++d) diagonal[c] += system.link[d][c] + system.link[d][grid.next(c, d)];
            most = std::max(most, diagonal[c]);
        });
        auto const lines = grid::runs(grid, [](int, int, int, grid::Index) { return true; });
        for (int repeat = 0; repeat < 2; ++repeat) {  // the second on what the first left
            multigrid.set_up(system, diagonal, {.free = false, .diagonal = comm.max(most), .right = 1});
            for (std::size_t k = 0; k < lines.size(); ++k) multigrid.take(k, system.right.data() + lines[k].first);
            multigrid.apply();
            for (std::size_t k = 0; k < lines.size(); ++k) multigrid.give(k, out.data() + lines[k].first);
        }
        return out;
    }
};

double largest_difference(Case const& alone, grid::Field const& there, Case const& shared, grid::Field const& here)
{
    double worst = 0;
    grid::for_each_cell(shared.grid, [&](int i, int j, int k, grid::Index c) {
        auto const& shift = shared.grid.shift;
        worst = std::max(worst, std::abs(here[c] - there[alone.grid.at(i + shift[0], j + shift[1], k + shift[2])]));
    });
    return shared.comm.max(worst);
}

double largest(Case const& alone, grid::Field const& field)
{
    double most = 0;
    grid::for_each_cell(alone.grid, [&](int, int, int, grid::Index c) { most = std::max(most, std::abs(field[c])); });
    return most;
}

std::vector<Scene> const scenes{
    {.cells = {7, 9, 22}},
    {.cells = {2, 15, 45}},
    {.cells = {22, 9, 12}, .bed = {.outlet = false}},
    {.cells = {6, 22, 13}, .bed = {.jump = 1000}},
    {.cells = {12, 12, 33}, .conical = true},
    {.cells = {8, 6, 16}, .periodic = {true, true, true}, .bed = {.outlet = false}},
    {.cells = {7, 7, 15}, .periodic = {true, true, true}, .bed = {.outlet = false}},
    {.cells = {1, 13, 31}, .periodic = {true, true, false}},
    {.cells = {20, 20, 41}},
    {.cells = {31, 21, 33}, .periodic = {true, true, true}, .bed = {.outlet = false}},
    {.cells = {2, 95, 101}, .bed = {.outlet = false}},
    {.cells = {22, 22, 44}, .bed = {.jump = 1000}, .conical = true},
};
}

TEST(PressureOnRanks, a_cycle_has_the_same_bits)
{
    for (auto const& scene : scenes) {
        Case const alone(scene, MPI_COMM_SELF), shared(scene, MPI_COMM_WORLD);
        auto const expected = alone.cycle(4096);
        ASSERT_GT(largest(alone, expected), 0);
        // Levels gathered early, or shared down to the last cell, when most ranks have none.
        for (long const few : {4096L, 100L, 1L})
            EXPECT_EQ(largest_difference(alone, expected, shared, shared.cycle(few)), 0)
                << scene.cells[0] << " x " << scene.cells[1] << " x " << scene.cells[2] << ", few = " << few;
    }
}

TEST(PressureOnRanks, small_systems_have_the_same_bits)
{
    for (auto const& scene : scenes) {
        if (scene.cells[0] * scene.cells[1] * scene.cells[2] > 16384) continue;
        Case const alone(scene, MPI_COMM_SELF), shared(scene, MPI_COMM_WORLD);
        auto x = alone.grid.make_field(), y = shared.grid.make_field();
        for (double const tolerance : {1e-3, 1e-6}) {  // the second from the first's result
            solve::Pressure(alone.grid, alone.comm, solve::Method::multigrid).solve(alone.system, x, tolerance);
            solve::Pressure(shared.grid, shared.comm, solve::Method::multigrid).solve(shared.system, y, tolerance);
            EXPECT_EQ(largest_difference(alone, x, shared, y), 0)
                << scene.cells[0] << " x " << scene.cells[1] << " x " << scene.cells[2];
        }
    }
}

TEST(PressureOnRanks, solutions_agree_to_round_off)
{
    for (auto const& scene : scenes) {
        if (scene.cells[0] * scene.cells[1] * scene.cells[2] <= 16384) continue;
        Case const alone(scene, MPI_COMM_SELF), shared(scene, MPI_COMM_WORLD);
        auto x = alone.grid.make_field(), y = shared.grid.make_field();
        auto const one =
            solve::Pressure(alone.grid, alone.comm, solve::Method::multigrid).solve(alone.system, x, 1e-13);
        auto const many =
            solve::Pressure(shared.grid, shared.comm, solve::Method::multigrid).solve(shared.system, y, 1e-13);
        EXPECT_TRUE(one.converged && many.converged);
        EXPECT_NEAR(one.iterations, many.iterations, 0.1 * one.iterations);
        EXPECT_LT(largest_difference(alone, x, shared, y), 1e-12 * largest(alone, x))
            << scene.cells[0] << " x " << scene.cells[1] << " x " << scene.cells[2];
    }
}

TEST(PressureOnRanks, other_methods_agree)
{
    for (auto const& scene : {scenes[0], scenes[2], scenes[5]}) {
        Case const alone(scene, MPI_COMM_SELF), shared(scene, MPI_COMM_WORLD);
        auto x = alone.grid.make_field();
        solve::Pressure(alone.grid, alone.comm, solve::Method::multigrid).solve(alone.system, x, 1e-12);
        for (auto const method : {solve::Method::pfmg, solve::Method::smg, solve::Method::diagonal}) {
            auto y = shared.grid.make_field();
            solve::Pressure(shared.grid, shared.comm, method).solve(shared.system, y, 1e-12);
            EXPECT_LT(largest_difference(alone, x, shared, y), 1e-9 * largest(alone, x)) << static_cast<int>(method);
        }
    }
}
