// Heat through the gas between granules: the closed form against the plain integral and against published numbers.
#include "granum/law/film/all.hpp"
#include "granum/law/film/quadrature.hpp"
#include "granum/math/constants.hpp"
#include "scene/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using namespace granum;
using namespace granum::law;
using film::Pair;

double const nowhere = std::numeric_limits<double>::infinity();

// Spheres of 3 and 3.6 mm in a gas of 1.239e-4 cal/(s cm K), 0.05184 W/m/K.
Pair published(double gap)
{
    return {.radius = 1.5e-3, .other = 1.8e-3, .gap = gap};
}
double const gas = 1.239e-4 * 418.4;

TEST(Film, conducts_as_published_between_separated_spheres)
{
    // MFIX's archived rates imply 1.9051e-4 W/K; the integral of the reference case is 1.905227e-4.
    double const conductance = film::conductance(film::RongHorio{}, published(0.18e-3), gas);
    EXPECT_NEAR(conductance, 1.9051e-4, 1.5e-8);
    EXPECT_NEAR(conductance, 1.905227e-4, 1e-10);
    EXPECT_NEAR(published(0.18e-3).outer(), 5.565457e-4, 1e-10);
}

TEST(Film, brings_two_spheres_together_as_the_reference_case)
{
    double const conductance = film::conductance(film::RongHorio{}, published(0.18e-3), gas);
    double const one = 420 * math::pi / 6 * 27e-9 * 0.191204 * 4184;
    double const other = 8850 * math::pi / 6 * 46.656e-9 * 0.013145 * 4184;
    double const rate = conductance * (1 / one + 1 / other);
    double const end = (one * 298.15 + other * 453.15) / (one + other);
    auto const colder = [&](double time) { return end + (298.15 - end) * std::exp(-rate * time); };
    auto const hotter = [&](double time) { return end + (453.15 - end) * std::exp(-rate * time); };
    // Published by MFIX after 0.1 s.
    EXPECT_NEAR(colder(0.1), 298.76991, 1e-4);
    EXPECT_NEAR(hotter(0.1), 452.90236, 1e-4);
    scene::Table const table("h-11.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const time = table.number(row, "t_s");
        EXPECT_NEAR(colder(time), table.number(row, "T1_K"), 5e-3) << time;
        EXPECT_NEAR(hotter(time), table.number(row, "T2_K"), 5e-3) << time;
    }
}

TEST(Film, agrees_with_numbers_of_an_independent_program)
{
    struct Row
    {
        double radius, other, gap, length;
    };
    for (auto const& row : {Row{1.5e-3, 1.8e-3, 0.18e-3, 3.675223768e-3},
                            {1.5e-3, 1.8e-3, -1.33e-7, 5.367181810e-2},
                            {0.6e-3, 0.9e-3, 1e-6, 1.157165868e-2},
                            {0.3e-3, 0.3e-3, 1e-8, 7.831744586e-3},
                            {0.3e-3, 0.3e-3, 0, 8.174342654e-3},
                            {0.2e-3, 1e-3, 1e-5, 2.483445772e-3}}) {
        EXPECT_NEAR(film::RongHorio{}({row.radius, row.other, row.gap}), row.length, 1e-8 * row.length);
        EXPECT_NEAR(film::RongHorio{}({row.other, row.radius, row.gap}), row.length, 1e-8 * row.length);
    }
}

TEST(Film, in_closed_form_is_the_plain_integral)
{
    for (double const other : {0.4e-3, 0.41e-3, 0.9e-3, 4e-3, nowhere})
        for (double const gap : {-2e-5, -1e-6, -1e-8, 0.0, 1e-9, 2.75e-8, 1e-6, 2e-5, 7e-5})
            for (double const lens : {0.1, 0.2, 0.4}) {
                Pair const pair{.radius = 0.4e-3, .other = other, .gap = gap, .lens = lens};
                double const plain = film::by_quadrature(pair), closed = film::RongHorio{}(pair);
                EXPECT_NEAR(closed, plain, 2e-6 * plain + 1e-15) << other << " " << gap << " " << lens;
            }
}

// The closed form of MFIX for a sphere and a plane, in units of the radius: o = overlap, k = shortest way.
double to_plane(double o, double k, double lens)
{
    double const outer = std::sqrt(lens * lens - (1 - o) * (1 - o)), root = std::sqrt(1 - outer * outer);
    if (o >= 0)
        return math::pi * ((1 - o) * (1 - o) - (1 - o - k) * (1 - o - k)) / k + 2 * math::pi * (root - (1 - o - k)) +
               2 * math::pi * (1 - o) * std::log((1 - o - root) / k);
    return 2 * math::pi * (root - 1) + 2 * math::pi * (1 - o) * std::log((1 - o - root) / -o);
}

TEST(Film, to_a_wall_and_between_equal_spheres_has_the_closed_form_of_mfix)
{
    double const radius = 0.3e-3, shortest = 2.75e-8;
    for (double const o : {0.01, 1e-3, 0.0, -1e-3, -0.01, -0.09}) {
        Pair const wall{.radius = radius, .other = nowhere, .gap = -o * radius, .shortest = shortest};
        double const expected = radius * to_plane(o, shortest / radius, 1.2);
        EXPECT_NEAR(film::RongHorio{}(wall), expected, 1e-9 * expected) << o;
        // Two equal spheres are two such planes in series, each with half the gap and half the shortest way; the lens
        // is the distance at which the enlarged sphere cuts the other's surface.
        Pair const pair{.radius = radius, .other = radius, .gap = -2 * o * radius, .shortest = shortest};
        double const lens = std::sqrt(std::pow(pair.outer() / radius, 2) + (1 - o) * (1 - o));
        double const half = radius * to_plane(o, 0.5 * shortest / radius, lens);
        EXPECT_NEAR(film::RongHorio{}(pair), 0.5 * half, 1e-9 * half) << o;
    }
}

TEST(Film, is_widest_at_the_touch_falls_with_the_gap_and_ends_at_the_edge_of_the_lens)
{
    for (double const other : {0.4e-3, 1.2e-3, nowhere}) {
        double const edge = 0.2 * (std::isinf(other) ? 0.4e-3 : other);
        double last = nowhere;
        for (double gap = 0; gap < edge; gap += 1e-6) {
            double const length = film::RongHorio{}({0.4e-3, other, gap});
            EXPECT_LT(length, last) << gap;
            EXPECT_GT(length, 0);
            last = length;
        }
        EXPECT_LT(film::RongHorio{}({0.4e-3, other, -1e-6}), film::RongHorio{}({0.4e-3, other, 0}))
            << "the circle in which they touch is not the gas's";
        EXPECT_EQ(film::RongHorio{}({0.4e-3, other, edge * 1.001}), 0);
        EXPECT_LT(film::RongHorio{}({0.4e-3, other, edge * 0.999}), 1e-5);
    }
    EXPECT_EQ(film::conductance(film::NoFilm{}, {0.4e-3, 0.4e-3, 0}, 0.026), 0);
}

TEST(Film, of_a_grain_on_a_boulder_covers_its_near_half_only)
{
    // The lens of the boulder holds the whole grain.
    Pair const pair{.radius = 0.1e-3, .other = 5e-3, .gap = 1e-6};
    EXPECT_EQ(pair.outer(), pair.radius);
    double const length = film::RongHorio{}(pair);
    EXPECT_NEAR(length, film::by_quadrature(pair), 1e-4 * length);
    EXPECT_TRUE(std::isfinite(film::RongHorio{}({1e-3, 1e-3, 1e-4, 2.0}))) << "equal spheres, a lens around both";
}

TEST(Film, of_parcels_grows_with_their_size)
{
    // Three times everything but the shortest way: the conductance of a bed of parcels keeps its conductivity.
    double const small = film::RongHorio{}({0.3e-3, 0.3e-3, 1e-5}), large = film::RongHorio{}({0.9e-3, 0.9e-3, 3e-5});
    EXPECT_NEAR(large, 3 * small, 1e-9 * large);
}
}
