#include "granum/math/first_fall.hpp"

#include "granum/base/random.hpp"

#include <gtest/gtest.h>

namespace
{
using granum::math::first_fall;
using granum::math::never;

TEST(FirstFall, of_a_gap_that_is_zero_and_opens_is_when_it_closes_again)
{
    EXPECT_EQ(first_fall(0, 1, 0), never);
    EXPECT_EQ(first_fall(0, 0, 0), never);
    EXPECT_EQ(first_fall(0, -1, 0), 0);
    EXPECT_DOUBLE_EQ(first_fall(0, 1, -0.5), 2);       // thrown up, comes down
    EXPECT_DOUBLE_EQ(first_fall(-1e-18, 1, -0.5), 2);  // whatever the rounding of the gap
    EXPECT_DOUBLE_EQ(first_fall(1e-18, 1, -0.5), 2);
    EXPECT_NEAR(first_fall(-1e-18, 1e-20, -0.5), 0, 1e-19);  // too weak a bounce to leave: at once
}

TEST(FirstFall, of_a_parabola_that_turns_before_zero_is_never)
{
    EXPECT_EQ(first_fall(1, -1, 1), never);
    EXPECT_DOUBLE_EQ(first_fall(1, -3, 2), 0.5);
    EXPECT_DOUBLE_EQ(first_fall(4.905, 0, -4.905), 1);
}

TEST(FirstFall, of_a_quartic_is_its_first_falling_root)
{
    // (t - 1)(t - 2)(t - 3)(t - 4) falls through zero at 1 and 3; from above at the start it is 1.
    std::array<double, 5> const four{24, -50, 35, -10, 1};
    EXPECT_NEAR(first_fall(four, 5), 1, 1e-12);
    EXPECT_EQ(first_fall(four, 0.9), never);
    std::array<double, 5> below = four;
    for (auto& c : below) c = -c;  // begins below zero and rises: at 1 up, at 2 down
    EXPECT_NEAR(first_fall(below, 5), 2, 1e-12);
}

TEST(FirstFall, of_a_quartic_agrees_with_a_fine_scan)
{
    for (std::uint64_t k = 0; k < 2000; ++k) {
        granum::base::Random random(3, granum::base::Purpose::test, k, 0);
        std::array<double, 5> c{random.uniform()};
        for (std::size_t p = 1; p < 5; ++p) c[p] = 8 * (random.uniform() - 0.5);
        auto const value = [&](double t) { return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4]))); };
        double const found = first_fall(c, 2);
        double scanned = never;
        int const steps = 4000;
        for (int s = 1; s <= steps && scanned == never; ++s)
            if (value(2.0 * s / steps) < 0) scanned = 2.0 * s / steps;
        if (scanned == never) {
            // The scan may miss a fall between two of its points, never one that stays.
            if (found != never) {
                EXPECT_NEAR(value(found), 0, 1e-12) << k;
            }
            continue;
        }
        EXPECT_LE(found, scanned) << k;
        EXPECT_NEAR(value(found), 0, 1e-12) << k;
        for (double t = 0; t < found; t += found / 50) EXPECT_GE(value(t), -1e-12) << k;
    }
}

TEST(FirstFall, of_a_parabola_is_the_same_by_both_ways)
{
    for (std::uint64_t k = 0; k < 500; ++k) {
        granum::base::Random random(4, granum::base::Purpose::test, k, 0);
        double const c0 = random.uniform(), c1 = 4 * (random.uniform() - 0.7), c2 = 4 * (random.uniform() - 0.5);
        double const exact = first_fall(c0, c1, c2);
        double const found = first_fall({c0, c1, c2, 0, 0}, 10);
        if (exact > 10)
            EXPECT_EQ(found, never);
        else
            EXPECT_NEAR(found, exact, 1e-11);
    }
}
}
