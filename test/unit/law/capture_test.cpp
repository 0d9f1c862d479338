// Capture of droplets by granules and what happens on impact.
#include "granum/base/random.hpp"
#include "granum/law/capture/all.hpp"
#include "granum/law/capture/filter.hpp"
#include "granum/law/impact/splash.hpp"
#include "granum/law/wetting/footprint.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::law;

TEST(Capture, stokes_numbers_and_efficiencies_agree_with_independent_numbers)
{
    // 3 m/s past 0.6 mm in air of 2e-5 Pa s, droplets of 1100 kg/m3.
    struct Row
    {
        double diameter, stokes, share, half_stokes;
    };
    for (auto const& row : {Row{5e-6, 0.382, 0.365, 5e-4},
                            {10e-6, 1.528, 0.739, 5e-4},
                            {20e-6, 6.11, 0.923, 5e-3},
                            {40e-6, 24.4, 0.980, 5e-2}}) {
        double const stokes = capture::stokes_number(1100, row.diameter, 3, 2e-5, 0.6e-3);
        EXPECT_NEAR(stokes, row.stokes, 1.01 * row.half_stokes);
        EXPECT_NEAR(capture::Simple{}({stokes, 108}), row.share, 1e-3);
        EXPECT_NEAR(capture::efficiency(stokes, 200), row.share, 1e-3) << "above Re = 190 the ranges end in this law";
    }
}

TEST(Capture, efficiency_is_a_share_that_grows_with_the_stokes_number_without_jumps)
{
    for (auto const& name : capture::All::names()) {
        auto const law = *capture::All::make(name);
        auto const share = [&](double st, double re) {
            return std::visit([&](auto const& chosen) { return chosen({st, re}); }, law);
        };
        for (double re = 0.01; re < 1e4; re *= 1.002) {
            EXPECT_EQ(share(0, re), 0);
            EXPECT_NEAR(share(1e9, re), 1, 1e-6);
            EXPECT_LT(share(0.5, re), share(1, re));
            EXPECT_NEAR(share(1, re), share(1, 1.002 * re), 2e-3) << name << " jumps at Re " << re;
        }
    }
}

TEST(Loeffler, has_its_coefficients_within_each_range)
{
    double const st = 2;
    auto const formula = [st](double a, double b) { return std::pow(st / (st + a), b); };
    EXPECT_NEAR(capture::efficiency(st, 0.5), formula(0.65, 3.7), 1e-12);
    EXPECT_NEAR(capture::efficiency(st, 10), formula(1.24, 1.95), 1e-12);
    EXPECT_NEAR(capture::efficiency(st, 40), formula(1.03, 2.07), 1e-12);
    EXPECT_NEAR(capture::efficiency(st, 70), formula(0.84, 2.0), 1e-12);
    EXPECT_NEAR(capture::efficiency(st, 500), formula(0.25, 2.0), 1e-12);
}

TEST(FilterOfGranules, has_the_mean_free_path_of_random_spheres)
{
    EXPECT_NEAR(capture::mean_free_path(0.3, 0.6e-3, 0, 0.9), 1.481e-3, 0.51e-6);
    EXPECT_NEAR(capture::path_rate(0.3, 0.6e-3, 0, 3, 0.9) * 1.481481481e-3, 3, 1e-8);
    EXPECT_TRUE(std::isinf(capture::mean_free_path(0, 0.6e-3, 40e-6, 0.9)));
    EXPECT_EQ(capture::path_rate(0, 0.6e-3, 40e-6, 3, 0.9), 0);
}

TEST(FilterOfGranules, lets_droplets_through_as_spheres_in_random_places_do)
{
    // Straight flights through a slab of overlapping random spheres: the share that meets none within z is
    // exp(-n pi r^2 z) by Poisson, with n = phi / volume. Counted here by throwing spheres.
    double const diameter = 1, droplet = 0.2, phi = 0.05, depth = 4, reach = 0.5 * (diameter + droplet);
    double const spheres_in_reach = phi / (math::pi / 6) * depth * 4 * reach * reach;  // in the column about the path
    base::Random random(3, base::Purpose::test, 1, 0);
    int through = 0;
    int const flights = 40000;
    for (int flight = 0; flight < flights; ++flight) {
        bool met = false;
        double arrivals = -std::log(random.uniform());
        while (arrivals < spheres_in_reach) {
            double const x = reach * (2 * random.uniform() - 1), y = reach * (2 * random.uniform() - 1);
            met = met || x * x + y * y < reach * reach;
            arrivals -= std::log(random.uniform());
        }
        through += !met;
    }
    double const expected = std::exp(-depth / capture::mean_free_path(phi, diameter, droplet, 1));
    double const deviation = std::sqrt(expected * (1 - expected) / flights);
    EXPECT_NEAR(static_cast<double>(through) / flights, expected, 4 * deviation);
}

TEST(Impact, has_the_dimensionless_numbers_of_a_known_example)
{
    // 40 um at 10 m/s; the example gives We 73, Re 220, K 33 for a density of 1100 kg/m3.
    impact::Impact const hit{1100, 2e-3, 0.06, 10, 40e-6};
    EXPECT_NEAR(hit.weber(), 73, 0.5);
    EXPECT_NEAR(hit.reynolds(), 220, 0.5);
    EXPECT_NEAR(hit.mundo(), 33, 0.5);
    EXPECT_NEAR(hit.ohnesorge(), std::sqrt(hit.weber()) / hit.reynolds(), 1e-12);
    EXPECT_NEAR(hit.mundo(), hit.ohnesorge() * std::pow(hit.reynolds(), 1.25), 1e-10);
    impact::Splash const splash;
    EXPECT_EQ(splash.share(hit.mundo(), 0.5), 0);
    impact::Impact const fast{1100, 2e-3, 0.06, 100, 40e-6};
    EXPECT_NEAR(splash.share(fast.mundo(), 0.5), 0.2 + 0.5 * 0.6, 1e-15);
}

TEST(Cap, has_the_shape_of_independent_numbers)
{
    struct Row
    {
        double diameter, degrees, base, height, area;  // um, um2
    };
    for (auto const& row : {Row{40, 40, 38.289, 13.936, 5215.9},
                            {40, 30, 42.682, 11.437, 6134.1},
                            {40, 90, 25.198, 25.198, 3989.6},
                            {30, 60, 24.118, 13.925, 2436.6}}) {
        double const theta = row.degrees * math::pi / 180;
        double const base = wetting::cap_base_radius(row.diameter * 1e-6, theta);
        EXPECT_NEAR(base * 1e6, row.base, 0.51e-3);
        EXPECT_NEAR(wetting::cap_height(base, theta) * 1e6, row.height, 0.51e-3);
        EXPECT_NEAR(wetting::cap_area(base, theta) * 1e12, row.area, 0.51e-1);
    }
}

TEST(Cap, keeps_the_volume_of_the_droplet)
{
    for (double theta = 0.1; theta < 3; theta += 0.1) {
        double const a = wetting::cap_base_radius(40e-6, theta), h = wetting::cap_height(a, theta);
        double const droplet = math::pi * std::pow(40e-6, 3) / 6;
        EXPECT_NEAR(math::pi * h * (3 * a * a + h * h) / 6, droplet, 1e-9 * droplet);
        EXPECT_NEAR(wetting::pinned_angle(droplet, a), theta, 1e-9);
    }
    EXPECT_NEAR(wetting::pinned_angle(0, 40e-6), 0, 1e-12);
}

TEST(Spreading, at_impact_agrees_with_a_known_example_and_the_footprint_is_the_wider)
{
    double const theta = 60 * math::pi / 180;
    EXPECT_NEAR(wetting::maximum_spread(73, 220, theta), 2.00, 0.005);
    double const rest = wetting::cap_base_radius(40e-6, theta);
    EXPECT_NEAR(wetting::footprint_radius(40e-6, theta, 73, 220), 20e-6 * wetting::maximum_spread(73, 220, theta),
                1e-12);
    EXPECT_EQ(wetting::footprint_radius(40e-6, theta, 0, 0), rest);
    EXPECT_GE(wetting::footprint_radius(40e-6, 0.3, 1e-3, 1), wetting::cap_base_radius(40e-6, 0.3));
}
}
