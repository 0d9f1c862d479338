// The multigrid as an operator: what conjugate gradients ask of it.
#include "granum/solve/multigrid.hpp"

#include "scene/bed_system.hpp"
#include "scene/cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;

namespace
{
struct Scene
{
    std::array<int, 3> cells{12, 10, 24};
    std::array<bool, 3> periodic{};
    BedSystem bed{};
};

//! The multigrid of a system, applied to fields.
struct Inverse
{
    par::Communicator comm;
    grid::Grid grid;
    std::vector<grid::Run> lines;
    solve::Multigrid multigrid;

    explicit Inverse(Scene const& scene)
        : grid(cut_evenly({.size = {1.2, 1, 2.4}}, grid::uniform_lines({}, {1.2, 1, 2.4}, scene.cells), scene.periodic,
                          comm)),
          lines(grid::runs(grid, [](int, int, int, grid::Index) { return true; })),
          multigrid(grid, comm)
    {
        auto const system = bed_system(grid, scene.bed);
        auto diagonal = grid.make_field();
        double most = 0;
        grid::for_each_cell(grid, [&](int, int, int, grid::Index c) {
            diagonal[c] = system.extra[c];
            for (std::size_t d = 0; d < 3; ++d) diagonal[c] += system.link[d][c] + system.link[d][grid.next(c, d)];
            most = std::max(most, diagonal[c]);
        });
        multigrid.set_up(system, diagonal, {.free = !scene.bed.outlet, .diagonal = most, .right = 1});
    }

    grid::Field times(grid::Field const& field)
    {
        auto out = grid.make_field();
        for (std::size_t line = 0; line < lines.size(); ++line) multigrid.take(line, field.data() + lines[line].first);
        multigrid.apply();
        for (std::size_t line = 0; line < lines.size(); ++line) multigrid.give(line, out.data() + lines[line].first);
        return out;
    }

    double dot(grid::Field const& a, grid::Field const& b) const
    {
        double sum = 0;
        grid::for_each_cell(grid, [&](int, int, int, grid::Index c) { sum += a[c] * b[c]; });
        return sum;
    }

    //! Rough or smooth; of mean zero.
    grid::Field field(int number, double roughness) const
    {
        auto out = grid.make_field();
        double mean = 0, count = 0;
        grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
            out[c] = std::sin(roughness * (i + 1.7 * j + 0.6 * k) * (1 + 0.13 * number) + number);
            mean += out[c], count += 1;
        });
        grid::for_each_cell(grid, [&](int, int, int, grid::Index c) { out[c] -= mean / count; });
        return out;
    }
};

void expect_symmetric_and_positive(Scene const& scene)
{
    Inverse inverse(scene);
    for (int number = 0; number < 6; ++number)
        for (double const roughness : {0.1, 0.9, 2.9}) {
            auto const x = inverse.field(number, roughness), y = inverse.field(number + 3, 3.1 - roughness);
            auto const mx = inverse.times(x), my = inverse.times(y);
            double const xx = inverse.dot(x, mx), yy = inverse.dot(y, my);
            EXPECT_GT(xx, 0);
            EXPECT_GT(yy, 0);
            // Round-off of single precision.
            EXPECT_NEAR(inverse.dot(x, my), inverse.dot(y, mx), 1e-5 * std::sqrt(xx * yy));
        }
}
}

TEST(Multigrid, is_symmetric_and_positive)
{
    expect_symmetric_and_positive({});
    expect_symmetric_and_positive({.bed = {.outlet = false}});
    expect_symmetric_and_positive({.cells = {1, 9, 40}});
    expect_symmetric_and_positive({.cells = {24, 10, 6}, .bed = {.jump = 1000}});
}

TEST(Multigrid, is_symmetric_and_positive_over_periodic_faces)
{
    expect_symmetric_and_positive({.cells = {8, 4, 16}, .periodic = {true, true, true}, .bed = {.outlet = false}});
    expect_symmetric_and_positive({.cells = {7, 5, 11}, .periodic = {true, true, true}, .bed = {.outlet = false}});
    expect_symmetric_and_positive({.cells = {3, 10, 13}, .periodic = {true, false, true}});
}

TEST(Multigrid, tells_the_product_of_residual_and_result)
{
    Inverse inverse({});
    auto const x = inverse.field(1, 0.7);
    auto const mx = inverse.times(x);
    EXPECT_NEAR(inverse.multigrid.apply(), inverse.dot(x, mx), 1e-6 * inverse.dot(x, mx));
}
