// Coverage and thickness of layers that chance lays, against the closed forms of Poisson's distribution
// (physics.md 5.5).
#include "granum/product/surface.hpp"

#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::product;

TEST(Surface, has_panels_of_equal_area_all_over_the_sphere)
{
    Surface const surface(500);
    math::Vec3 sum;
    double closest = 2;
    for (std::size_t k = 0; k < 500; ++k) {
        auto const x = surface.middle(k);
        EXPECT_NEAR(math::norm(x), 1, 1e-12);
        sum += x;
        for (std::size_t j = 0; j < k; ++j) closest = std::min(closest, math::norm(surface.middle(j) - x));
    }
    EXPECT_LT(math::norm(sum), 0.5);
    EXPECT_GT(closest, 0.6 * std::sqrt(4 * math::pi / 500));  // none crowd: the mean distance is about 1 of this
}

TEST(Surface, takes_a_cap_where_it_falls)
{
    Surface surface(20000);
    math::Vec3 const direction{0.6, 0, 0.8};
    double const radius = 3e-4, base = 6e-5, volume = 1e-15;
    surface.add(direction, radius, base, volume);
    double const area = 2 * math::pi * radius * radius * (1 - std::cos(0.2));
    for (std::size_t k = 0; k < 20000; ++k) {
        double const angle = std::acos(math::dot(surface.middle(k), direction));
        EXPECT_EQ(surface.thickness()[k], angle <= 0.2 ? volume / area : 0) << angle;
    }
    // As much as has fallen, to what panels can tell.
    EXPECT_NEAR(surface.mean_thickness() * 4 * math::pi * radius * radius, volume, 0.01 * volume);
    EXPECT_NEAR(surface.coverage(), area / (4 * math::pi * radius * radius), 1e-4);
    // Over a pole, and one that is wider than the sphere.
    surface.add({0, 0, -1}, radius, base, volume);
    EXPECT_NEAR(surface.coverage(), 2 * area / (4 * math::pi * radius * radius), 2e-4);
    surface.add({0, 0, 1}, radius, 1e-2, volume);
    EXPECT_EQ(surface.coverage(), 1);
}

TEST(Surface, is_covered_and_varies_as_poisson_says)
{
    // Mean hits per point: N (1 - cos(a/R)) / 2. Coverage 1 - exp(-hits), variation of thickness 1 / sqrt(hits).
    double const radius = 3e-4, base = 3e-5;
    double const share = 0.5 * (1 - std::cos(base / radius));
    struct Row
    {
        double hits, coverage;
    };
    for (auto const& row : {Row{0.1, 0.095163}, {1, 0.632121}, {2, 0.864665}, {3, 0.950213}, {5, 0.993262}}) {
        std::vector<Surface> sample(40, Surface(1000));
        for (std::size_t n = 0; n < sample.size(); ++n) {
            base::Random random(1, base::Purpose::test, n, static_cast<std::uint32_t>(10 * row.hits));
            // In several falls, as the events of a run come.
            for (int part = 0; part < 5; ++part) fall(sample[n], {row.hits / share / 5, radius, base, 1e-16}, random);
        }
        auto const got = statistics(sample);
        // Standard errors: a granule has row.hits / share (40 to 2000) deposits.
        double const error = std::sqrt(share / row.hits / 40);
        EXPECT_NEAR(got.coverage, row.coverage, 4 * error * row.hits * std::exp(-row.hits) + 0.002) << row.hits;
        EXPECT_NEAR(got.variation_within, 1 / std::sqrt(row.hits), 0.03 / std::sqrt(row.hits)) << row.hits;
        double const fallen = row.hits / share * 1e-16 / (4 * math::pi * radius * radius);
        EXPECT_NEAR(got.mean_thickness, fallen, 4 * error * fallen) << row.hits;
        // Among granules the number of deposits varies as 1 / sqrt(number).
        EXPECT_NEAR(got.variation_between, std::sqrt(share / row.hits), 4 * std::sqrt(share / row.hits / 80))
            << row.hits;
    }
}

TEST(Poisson, has_its_mean_and_its_variance)
{
    for (double const mean : {0.03, 0.8, 7.0, 32.0, 100.0}) {
        base::Random random(3, base::Purpose::test, 1, static_cast<std::uint32_t>(100 * mean));
        double sum = 0, square = 0;
        int const draws = 20000;
        for (int n = 0; n < draws; ++n) {
            auto const x = static_cast<double>(random.poisson(mean));
            sum += x, square += x * x;
        }
        double const got = sum / draws, variance = square / draws - got * got;
        EXPECT_NEAR(got, mean, 4 * std::sqrt(mean / draws)) << mean;
        EXPECT_NEAR(variance, mean, 4 * std::sqrt((mean + 2 * mean * mean) / draws)) << mean;
    }
    base::Random random(3, base::Purpose::test, 1, 0);
    EXPECT_EQ(random.poisson(0), 0);
}
}
