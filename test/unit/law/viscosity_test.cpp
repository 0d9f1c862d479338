// Viscosity as a function of the rate of shear.
#include "granum/law/viscosity/all.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum::law;
using viscosity::Shear;

TEST(Viscosity, of_every_law_is_that_at_rest_where_nothing_shears)
{
    for (auto const& name : viscosity::All::names()) {
        auto const law = *viscosity::All::make(name);
        EXPECT_DOUBLE_EQ(viscosity::viscosity(law, {0, 0.3, 0.001, 2, 0.4}), 0.3) << name;
        EXPECT_DOUBLE_EQ(viscosity::viscosity(law, {1e4, 1.8e-5}), 1.8e-5) << name << ": a gas needs no further number";
    }
}

TEST(Carreau, thins_from_one_plateau_to_the_other)
{
    Shear shear{.rate = 0.5, .at_rest = 0.3, .infinite = 0.001, .time = 2, .exponent = 0.4};
    // At time * rate = 1, by hand: 0.001 + 0.299 * 2^(-0.3).
    EXPECT_NEAR(viscosity::Carreau{}(shear), 0.001 + 0.299 * 0.8122523963562356, 1e-15);
    double last = 0.3;
    for (shear.rate = 0.01; shear.rate < 1e9; shear.rate *= 10) {
        double const now = viscosity::Carreau{}(shear);
        EXPECT_LT(now, last);
        EXPECT_GT(now, shear.infinite);
        last = now;
    }
    EXPECT_NEAR(last, shear.infinite, 1e-5);
}

TEST(Carreau, is_a_power_law_between)
{
    // K rate^(n - 1) with K = at_rest time^(n - 1), for thinning and for thickening.
    for (double const n : {0.3, 1.0, 1.4}) {
        Shear const shear{.rate = 1e4, .at_rest = 2, .time = 5, .exponent = n};
        double const power = 2 * std::pow(5, n - 1) * std::pow(1e4, n - 1);
        EXPECT_NEAR(viscosity::Carreau{}(shear), power, 1e-8 * power) << n;
    }
}
}
