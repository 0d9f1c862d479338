// Crystals in a cap: the moments of nucleation and growth where they have a closed form, and what dries faster has more
// and smaller ones.
#include "granum/law/deposit/crystallisation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace
{
using granum::law::deposit::Crystals;
using granum::law::deposit::NucleationGrowth;
using granum::law::deposit::Solution;

constexpr double foot = std::numbers::pi * 38e-6 * 38e-6;

// Birth and growth that do not depend on supersaturation: N = J t, sum L = J G t^2 / 2, sum L^2 = J G^2 t^3 / 3, mass =
// rho k_v J G^3 t^4 / 4, in any number of steps.
TEST(Crystals, of_constant_birth_and_growth_have_the_moments_of_the_closed_form)
{
    NucleationGrowth const law{
        .nucleation = 1e13, .nucleation_order = 0, .growth = 2e-6, .growth_order = 0, .shape = 0.5};
    for (int const steps : {1, 7, 400}) {
        Crystals crystals;
        double const t = 0.4;
        for (int n = 0; n < steps; ++n)
            law.advance(crystals,
                        {.water = 1e-11, .solids = 1, .foot = foot, .solubility = 0.63, .solids_density = 1440},
                        t / steps);
        double const born = 1e13 * foot, g = 2e-6;
        EXPECT_NEAR(crystals.count, born * t, 1e-9 * born * t);
        EXPECT_NEAR(crystals.length / (born * g * t * t / 2), 1, 1e-9) << steps;
        EXPECT_NEAR(crystals.area / (born * g * g * t * t * t / 3), 1, 1e-9) << steps;
        EXPECT_NEAR(crystals.mass / (1440 * 0.5 * born * std::pow(g, 3) * std::pow(t, 4) / 4), 1, 1e-9) << steps;
    }
}

//! A droplet of 40 um of 30 % solution whose water leaves at a constant rate within `time` s; stops at 1 % of it.
Crystals dried(NucleationGrowth const& law, double time, int steps = 4000)
{
    Crystals crystals;
    double const volume = std::numbers::pi / 6 * std::pow(40e-6, 3), solids = 0.3 * 1130 * volume;
    for (int n = 1; n <= 0.99 * steps; ++n)
        law.advance(crystals,
                    {.water = 0.7 * 1130 * volume * (1 - static_cast<double>(n) / steps),
                     .solids = solids,
                     .foot = foot,
                     .solubility = 0.63,
                     .solids_density = 1440},
                    time / steps);
    return crystals;
}

// physics.md 5.2b: fast growth leaves the solution saturated, so crystals weigh what the water cannot hold.
TEST(Crystals, that_grow_at_once_are_what_the_water_cannot_hold)
{
    NucleationGrowth const law{.nucleation = 1e26, .growth = 1};
    double const volume = std::numbers::pi / 6 * std::pow(40e-6, 3), solids = 0.3 * 1130 * volume;
    Crystals const crystals = dried(law, 0.5);
    EXPECT_NEAR(crystals.mass, solids - 0.63 * 0.01 * 0.7 * 1130 * volume, 1e-4 * solids);
    // A step takes 2.5 % of the water that is left in the end.
    EXPECT_LT(crystals.supersaturation, 1.026);
}

TEST(Crystals, are_born_at_1_3_times_saturation_in_the_deposit_that_the_default_is_for)
{
    EXPECT_NEAR(dried({}, 0.5).supersaturation, 1.3, 0.005);
}

TEST(Crystals, are_more_and_smaller_where_the_deposit_dries_faster)
{
    Crystals const fast = dried({}, 0.25), slow = dried({}, 1);
    EXPECT_GT(fast.supersaturation, slow.supersaturation);
    EXPECT_GT(fast.count, 2 * slow.count);
    // Steps as long as a run's, 1 ms of 0.5 s, do as well.
    EXPECT_NEAR(dried({}, 0.5, 500).count / dried({}, 0.5, 8000).count, 1, 0.04);
}

TEST(Crystals, dissolve_where_water_comes_back)
{
    NucleationGrowth const law;
    Crystals crystals = dried(law, 0.5);
    auto const before = crystals;
    Solution wetted{.water = 2e-12, .solids = 1.1e-11, .foot = foot, .solubility = 0.63, .solids_density = 1440};
    crystals.mass = 1.05e-11;  // more than the water leaves
    law.advance(crystals, wetted, 1e-3);
    EXPECT_NEAR(crystals.mass, 1.1e-11 - 0.63 * 2e-12, 1e-20);
    double const ratio = std::cbrt(crystals.mass / 1.05e-11);
    EXPECT_NEAR(crystals.length / before.length, ratio, 1e-12);
    EXPECT_NEAR(crystals.area / before.area, ratio * ratio, 1e-12);
    EXPECT_EQ(crystals.count, before.count);
    wetted.water = 1e-10;
    law.advance(crystals, wetted, 1e-3);
    EXPECT_EQ(crystals.mass, 0);
    EXPECT_EQ(crystals.count, 0);
}
}
