// A sample of surfaces takes what the events of its granules left, whatever else they tell of.
#include "granum/sim/surface_sample.hpp"

#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum;
using namespace granum::sim;

//! A deposit that covers a hundredth of its granule, on the average twice on each.
drying::Event event_on(double parcel)
{
    drying::Event event{};
    event.granule = parcel;
    event.granule_diameter = 0.6e-3, event.footprint = 0.06e-3, event.per_granule = 2;
    event.weight = 100, event.solids = 100 * 1440 * 0.5 * 1e-15, event.porosity = 0.5;  // 1e-15 m3 each
    return event;
}

TEST(SurfaceSample, takes_the_events_of_its_granules)
{
    SurfaceSample sample(1, 100, 10);
    for (int parcel = 0; parcel < 100; ++parcel)
        for (int n = 0; n < 50; ++n) sample.take(event_on(parcel), 1440);
    auto const got = sample.statistics();
    ASSERT_EQ(got.granules, 10u);
    double const area = math::pi * 0.36e-6, expected = 100 * 1e-15 / area;
    EXPECT_NEAR(got.mean_thickness, expected, 4 * expected / std::sqrt(10 * 100.0));
    EXPECT_NEAR(got.coverage, 1 - std::exp(-1.0), 0.05);

    // The same again, and in another order of the granules, to the bit.
    SurfaceSample other(1, 100, 10);
    for (int n = 0; n < 50; ++n)
        for (int parcel = 99; parcel >= 0; --parcel) other.take(event_on(parcel), 1440);
    for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(sample.surfaces()[k].thickness(), other.surfaces()[k].thickness());
}

TEST(SurfaceSample, leaves_out_what_the_start_had_placed_and_may_be_empty)
{
    SurfaceSample sample(1, 4, 4), none(1, 4, 0);
    auto start = event_on(2);
    start.initial = 1;
    sample.take(start, 1440), none.take(event_on(2), 1440);
    EXPECT_EQ(sample.statistics().coverage, 0);
    EXPECT_EQ(none.statistics().granules, 0u);
    EXPECT_EQ(SurfaceSample(1, 4, 200).statistics().granules, 4u);
}
}
