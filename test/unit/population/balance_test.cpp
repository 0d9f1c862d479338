// Population balances with an exact answer: growth of a batch, advection of a top hat, a stirred bed with nuclei.
#include "granum/population/balance.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace granum;
using namespace granum::population;

// physics.md 5.3: 1 kg of cores of 0.6 mm and 1445 kg/m3, 0.36 kg/h of solids as layer of 864 kg/m3.
TEST(Batch, grows_as_the_volume_of_its_layer_has_it)
{
    double const volume = 1 / 1445.0, each = math::pi / 6 * std::pow(0.6e-3, 3), count = volume / each;
    EXPECT_NEAR(count, 6118991, 1);
    auto classes = Classes::even(0.55e-3, 0.8e-3, 500);
    classes.add(0.60001e-3, count);
    double const start = classes.total_volume();
    Rates const rates{.layer = 1e-4 / 864};
    double now = 0, grown = 0;
    for (auto const& [time, diameter] : {std::pair{600.0, 619.433e-6}, {1800.0, 655.011e-6}, {3600.0, 702.069e-6}}) {
        grown += advance(classes, rates, time - now).grown;
        now = time;
        EXPECT_NEAR(classes.total(), count, 1e-9 * count);
        EXPECT_NEAR(classes.total_volume() - start, 1e-4 / 864 * time, 1e-9 * start);
        EXPECT_NEAR(grown, 1e-4 / 864 * time, 1e-12 * start);
        // Of the classes' own start, which is half a class from that of the cores.
        double const exact = std::cbrt(std::pow(diameter, 3) + 6 / math::pi * (start - volume) / count);
        EXPECT_NEAR(std::cbrt(classes.total_volume() / count * 6 / math::pi), exact, 1e-4 * exact);
        EXPECT_NEAR(classes.percentile(0.5), diameter, 1e-6) << "a class is half a micrometre wide";
        EXPECT_LT(classes.percentile(0.9) - classes.percentile(0.1), 12e-6) << "smeared over some classes only";
    }
    EXPECT_NEAR(2 * 1e-4 / (864 * count * math::pi * 0.36e-6), 33.449e-9, 1e-12) << "G(0) of the reference";
}

TEST(TopHat, moves_by_the_speed_without_new_extremes)
{
    auto classes = Classes::even(0, 1e-3, 400);
    for (std::size_t k = 60; k < 120; ++k) classes.number[k] = 100;
    double const mean = classes.mean_diameter(), all = classes.total();
    advance_by_speed(classes, 1e-8, 4e4);
    EXPECT_NEAR(classes.mean_diameter() - mean, 4e-4, 1e-15);
    EXPECT_NEAR(classes.total(), all, 1e-10 * all);
    EXPECT_LE(*std::max_element(classes.number.begin(), classes.number.end()), 100 * (1 + 1e-9));
    EXPECT_GE(*std::min_element(classes.number.begin(), classes.number.end()), -1e-9);
    // Fronts from a tenth to nine tenths.
    long const smeared =
        std::count_if(classes.number.begin(), classes.number.end(), [](double n) { return n > 10 && n < 90; });
    EXPECT_LE(smeared, 12);
    EXPECT_NEAR(classes.number[250], 100, 0.1) << "the middle of the hat";
}

// Stirred bed, nuclei of d_0 at the rate B, every granule leaves with 1 / tau: n(d) = B / G exp(-(d - d_0) / (G tau)).
TEST(StirredBed, has_the_exponential_distribution_of_its_residence_time)
{
    double const nuclei = 1e4, residence = 600, start = 0.2e-3, speed = 100e-9;
    double const decay = speed * residence;  // m
    auto classes = Classes::even(0.199e-3, 2.0e-3, 1500);
    // Layer that makes the wanted speed of the steady state: G/2 times the surface of B tau granules of these
    // diameters.
    double const surface = nuclei * residence * math::pi * (start * start + 2 * start * decay + 2 * decay * decay);
    Rates const rates{
        .layer = 0.5 * speed * surface, .nuclei = nuclei, .nuclei_diameter = start, .discharge = [=](double) {
            return 1 / residence;
        }};
    classes.add(start, nuclei * residence);
    for (int n = 0; n < 60; ++n) advance(classes, rates, 200);
    EXPECT_NEAR(classes.total(), nuclei * residence, 1e-3 * nuclei * residence);
    double sum = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (std::size_t k = 0; k < classes.size(); ++k) {
        double const x = (classes.centre(k) - start) / decay;
        if (x < 0.5 || x > 4) continue;
        double const y = std::log(classes.number[k] / classes.width(k));
        sum += 1, sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
    }
    double const slope = (sum * sum_xy - sum_x * sum_y) / (sum * sum_xx - sum_x * sum_x);
    EXPECT_NEAR(slope, -1, 0.01);
}

TEST(Discharge, that_classifies_holds_the_bed_and_takes_the_large)
{
    auto classes = Classes::even(0.3e-3, 3e-3, 900);
    classes.add(0.6e-3, 1e6);
    double const held = classes.total_volume();
    Rates const rates{.layer = 2e-8,
                      .feed = 100,
                      .feed_diameter = 0.6e-3,
                      .discharge = [](double d) { return 1 / (1 + std::pow(0.9e-3 / d, 20)); },
                      .hold_up = held};
    Passed all, late;
    for (int n = 0; n < 80; ++n) {
        auto const passed = advance(classes, rates, 600);
        all.grown += passed.grown, all.fed += passed.fed, all.discharged += passed.discharged;
        if (n < 60) continue;
        late.discharged += passed.discharged, late.number_discharged += passed.number_discharged;
    }
    EXPECT_NEAR(classes.total_volume(), held, 1e-3 * held);
    EXPECT_NEAR(all.grown + all.fed - all.discharged, classes.total_volume() - held, 1e-9 * held);
    // In the steady state as many leave as come, with what they came with and their share of the layer.
    double const each = math::pi / 6 * std::pow(0.6e-3, 3) + 2e-8 / 100;
    EXPECT_NEAR(std::cbrt(6 / math::pi * late.discharged / late.number_discharged), std::cbrt(6 / math::pi * each),
                1e-5);
    EXPECT_LT(classes.percentile(0.9), 1.1e-3);
}

TEST(Classes, refuse_what_is_beyond_them)
{
    auto classes = Classes::even(0.5e-3, 0.6e-3, 50);
    EXPECT_THROW(classes.add(0.7e-3, 1), base::NumericsError);
    EXPECT_THROW(classes.add(0.4e-3, 1), base::NumericsError);
    classes.add(0.55e-3, 1e6);
    EXPECT_THROW(advance(classes, {.layer = 1e-6}, 1000), base::NumericsError);
}

TEST(Classes, know_surface_and_volume_of_an_even_filling)
{
    auto classes = Classes::even(1, 3, 1);
    classes.number[0] = 2;
    EXPECT_NEAR(classes.total_surface(), 2 * math::pi * 13 / 3, 1e-12);  // mean of d^2: (27 - 1) / 3 / 2
    EXPECT_NEAR(classes.total_volume(), 2 * math::pi / 6 * 10, 1e-12);   // mean of d^3: (81 - 1) / 4 / 2
    EXPECT_NEAR(classes.percentile(0.25), 1.5, 1e-12);
}
}
