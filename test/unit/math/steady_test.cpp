// The steady part of a series of known making, and the error of its mean.
#include "granum/math/steady.hpp"

#include "granum/base/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{
using namespace granum;
using math::error_of_mean;
using math::steady_part;

//! x' = r x + sqrt(1 - r^2) noise: variance 1; its mean over n has the variance (1 + r) / (1 - r) / n.
std::vector<double> correlated(std::size_t count, double r, std::uint64_t number)
{
    base::Random random(7, base::Purpose::test, number, 0);
    std::vector<double> out{random.normal()};
    while (out.size() < count) out.push_back(r * out.back() + std::sqrt(1 - r * r) * random.normal());
    return out;
}

TEST(ErrorOfMean, knows_that_neighbours_are_alike)
{
    for (double const r : {0.0, 0.5, 0.9}) {
        double const exact = std::sqrt((1 + r) / (1 - r) / 4000);
        double mean = 0;
        for (std::uint64_t k = 0; k < 20; ++k) mean += error_of_mean(correlated(4000, r, k)) / 20;
        EXPECT_NEAR(mean, exact, 0.12 * exact) << r;
    }
    EXPECT_EQ(error_of_mean(std::vector<double>(50, 3.0)), 0);
    EXPECT_EQ(error_of_mean(std::vector<double>{1.0}), 0);
}

TEST(SteadyPart, begins_where_a_start_has_died_away)
{
    for (std::uint64_t k = 0; k < 10; ++k) {
        auto series = correlated(1000, 0.5, 100 + k);
        for (std::size_t n = 0; n < series.size(); ++n) series[n] += 5 + 20 * std::exp(-static_cast<double>(n) / 40);
        auto const steady = steady_part(series);
        EXPECT_TRUE(steady.settled);
        EXPECT_GT(steady.start, 60u) << "e^-1.5 of 20 is still 4 deviations";
        EXPECT_LT(steady.start, 400u);
        EXPECT_NEAR(steady.mean, 5, 5 * steady.error);
    }
}

TEST(SteadyPart, of_what_still_drifts_or_is_short_has_not_settled)
{
    std::vector<double> drifting;
    for (int n = 0; n < 400; ++n) drifting.push_back(0.1 * n);
    EXPECT_FALSE(steady_part(drifting).settled);
    EXPECT_FALSE(steady_part(std::vector<double>{1, 1, 1}).settled);
    EXPECT_TRUE(steady_part(std::vector<double>(20, 1.0)).settled);
    EXPECT_EQ(steady_part(std::vector<double>(20, 1.0)).start, 0u);
    EXPECT_FALSE(steady_part({}).settled);
}
}
