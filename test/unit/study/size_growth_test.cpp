// Layers in proportion to a power of the diameter give that power back; sizes that hardly differ tell nothing.
#include "granum/study/size_growth.hpp"

#include "granum/base/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;

io::GranuleView grown(double power, double widest, double noise)
{
    io::GranuleView view;
    for (std::uint64_t n = 0; n < 20000; ++n) {
        base::Random random(1, base::Purpose::test, n, 0);
        double const d = 0.5e-3 * std::pow(widest, random.uniform());
        view.diameter.push_back(d);
        view.count.push_back(100);
        view.layer_mass.push_back(100 * d * d * std::pow(d / 0.5e-3, power) * std::exp(noise * random.normal()));
    }
    return view;
}

TEST(SizeGrowth, is_the_power_by_which_layers_were_made)
{
    for (double const power : {-0.5, 0.0, 1.0}) {
        auto const exact = study::size_growth(grown(power, 2, 0));
        EXPECT_TRUE(exact.known);
        EXPECT_NEAR(exact.exponent, power, 5e-3);
        auto const noisy = study::size_growth(grown(power, 2, 0.5));
        EXPECT_NEAR(noisy.exponent, power, 4 * noisy.error);
        EXPECT_LT(noisy.error, 0.1);
    }
}

TEST(SizeGrowth, is_not_told_by_granules_that_are_alike)
{
    EXPECT_FALSE(study::size_growth(grown(1, 1.05, 0)).known);
    EXPECT_FALSE(study::size_growth({}).known);
    auto bare = grown(0, 2, 0);
    for (double& mass : bare.layer_mass) mass = 0;
    EXPECT_FALSE(study::size_growth(bare).known);
}
}
