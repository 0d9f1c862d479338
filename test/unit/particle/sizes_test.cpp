// Size distributions keep their moments, whichever way their shares are stated.
#include "granum/particle/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using granum::particle::SizeDistribution;
using granum::particle::Weighting;

double cube(double x)
{
    return x * x * x;
}

//! Share of the volume of `draws` evenly drawn granules that is finer than `d`.
double finer_by_volume(SizeDistribution const& sizes, double d, int draws = 200000)
{
    double finer = 0, all = 0;
    for (int k = 0; k < draws; ++k) {
        double const diameter = sizes.diameter((k + 0.5) / draws);
        all += cube(diameter);
        if (diameter < d) finer += cube(diameter);
    }
    return finer / all;
}

TEST(SizeDistribution, of_one_size_gives_that_size)
{
    auto const sizes = SizeDistribution::single(2e-3);
    EXPECT_EQ(sizes.diameter(0), 2e-3);
    EXPECT_EQ(sizes.diameter(1), 2e-3);
    EXPECT_EQ(sizes.mean_cube(), cube(2e-3));
    EXPECT_NEAR(sizes.sauter(), 2e-3, 1e-18);
}

TEST(SizeDistribution, of_equal_masses_has_eight_small_granules_for_one_twice_as_wide)
{
    auto const sizes = SizeDistribution::list({2e-3, 1e-3}, {1, 1}, Weighting::mass);
    EXPECT_EQ(sizes.diameter(8.0 / 9 - 1e-9), 1e-3);
    EXPECT_EQ(sizes.diameter(8.0 / 9 + 1e-9), 2e-3);
    EXPECT_NEAR(sizes.mean_cube(), (8 * 1 + 8) / 9.0 * 1e-9, 1e-22);
    EXPECT_NEAR(sizes.sauter(), (8 * 1 + 8) / (8 * 1 + 4.0) * 1e-3, 1e-16);
    auto const by_number = SizeDistribution::list({1e-3, 2e-3}, {3, 1}, Weighting::number);
    EXPECT_EQ(by_number.diameter(0.74), 1e-3);
    EXPECT_EQ(by_number.diameter(0.76), 2e-3);
}

TEST(SizeDistribution, keeps_the_mass_shares_of_its_law)
{
    auto const normal = SizeDistribution::normal(1e-3, 1e-4, 6e-4, 1.4e-3, Weighting::mass);
    EXPECT_NEAR(finer_by_volume(normal, 1e-3), 0.5, 1e-3);
    EXPECT_NEAR(finer_by_volume(normal, 1.1e-3), 0.8413, 1e-3);  // one deviation above the mean
    auto const log_normal = SizeDistribution::log_normal(1e-3, 1.3, 3e-4, 3e-3, Weighting::mass);
    EXPECT_NEAR(finer_by_volume(log_normal, 1e-3), 0.5, 1e-3);
    EXPECT_NEAR(finer_by_volume(log_normal, 1.3e-3), 0.8413, 1e-3);
    auto const rosin = SizeDistribution::rosin_rammler(1e-3, 4, 2e-4, 2e-3, Weighting::mass);
    EXPECT_NEAR(finer_by_volume(rosin, 1e-3), 1 - std::exp(-1.0), 2e-3);
    auto const table = SizeDistribution::table({1e-3, 2e-3, 4e-3}, {0, 0.25, 1}, Weighting::mass);
    EXPECT_NEAR(finer_by_volume(table, 2e-3), 0.25, 1e-3);
    EXPECT_NEAR(finer_by_volume(table, 3e-3), 0.625, 2e-3);
}

TEST(SizeDistribution, by_number_has_the_moments_of_its_law)
{
    auto const uniform = SizeDistribution::uniform(1e-3, 3e-3, Weighting::number);
    EXPECT_NEAR(uniform.diameter(0.25), 1.5e-3, 1e-12);
    EXPECT_NEAR(uniform.mean_cube(), (81.0 - 1) / (4 * 2) * 1e-9, 1e-14);
    auto const normal = SizeDistribution::normal(1e-3, 1e-4, 2e-4, 1.8e-3, Weighting::number);
    EXPECT_NEAR(normal.mean_cube(), cube(1e-3) * (1 + 3 * 0.01), 1e-12 * 1e-3);  // mu^3 + 3 mu sigma^2
}

TEST(SizeDistribution, is_cut_at_its_limits_and_rises_in_between)
{
    auto const sizes = SizeDistribution::log_normal(1e-3, 2, 5e-4, 1.5e-3, Weighting::number);
    EXPECT_EQ(sizes.smallest(), 5e-4);
    EXPECT_EQ(sizes.largest(), 1.5e-3);
    EXPECT_GE(sizes.diameter(0), 5e-4);
    EXPECT_LE(sizes.diameter(1), 1.5e-3);
    for (int k = 1; k <= 100; ++k) EXPECT_LE(sizes.diameter((k - 1) / 100.0), sizes.diameter(k / 100.0));
}

TEST(SizeDistribution, has_its_mass_below_its_diameters_by_mass)
{
    auto const list = SizeDistribution::list({2e-3, 1e-3}, {3, 1}, Weighting::mass);
    EXPECT_EQ(list.mass_diameter(0.25 - 1e-9), 1e-3);
    EXPECT_EQ(list.mass_diameter(0.25 + 1e-9), 2e-3);
    // Rosin and Rammler's law by mass, by its closed form; cut off where less than 1e-8 of the mass lies.
    auto const rosin = SizeDistribution::rosin_rammler(45e-6, 2.5, 0.03e-6, 150e-6, Weighting::mass);
    for (double const u : {0.1, 0.5, 0.9, 0.99})
        EXPECT_NEAR(rosin.mass_diameter(u), 45e-6 * std::pow(-std::log1p(-u), 1 / 2.5), 2e-8) << u;
    // Even by number: the mass below d grows with its fourth power.
    auto const even = SizeDistribution::uniform(1e-9, 1e-3, Weighting::number);
    for (double const u : {0.0016, 0.2, 0.8}) EXPECT_NEAR(even.mass_diameter(u), 1e-3 * std::pow(u, 0.25), 1e-8) << u;
    EXPECT_EQ(even.mass_diameter(1), 1e-3);
}
}
