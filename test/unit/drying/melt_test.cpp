// Deposits of a melt give away their heat of fusion, all of it to their granule, and are then part of its layer.
#include "bed.hpp"

#include "granum/law/wetting/footprint.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum;
using namespace granum::drying;
using math::zero_celsius;
using test::Bed;

//! A bed whose deposits are of molten urea (recalled: 132.7 degC, 224 kJ/kg).
struct MoltenBed : Bed
{
    explicit MoltenBed(double celsius) : Bed(1, 10)
    {
        settings.liquid = {.density = 1220,
                           .solids_density = 1335,
                           .solubility = 0,
                           .feed_moisture = 0,
                           .melting_point = 132.7 + zero_celsius,
                           .conductivity = 0.5};
        granules.temperature[0] = temperature[0] = celsius + zero_celsius;
    }
    void splat(double weight, double melt, double heat, double base_radius)
    {
        wet(0, weight, 0, melt, base_radius);
        deposits.on(0).back().heat = weight * heat;
    }
};

TEST(Melt, is_solid_when_its_heat_of_fusion_has_gone_to_the_granule)
{
    double const melt = 4.1e-11, heat = melt * 224e3, radius = 40e-6;  // J of one cap
    MoltenBed bed(80);
    bed.settings.solidification = law::deposit::ToGasAndGranule{};
    double const before = bed.granules.enthalpy[0], mass = bed.granules.mass[0];
    bed.splat(30, melt, heat, radius);
    resize_granule(bed.granules, 0);
    double const dt = 1e-4;
    while (bed.events.empty() && bed.now < 1) bed.advance(dt);

    ASSERT_EQ(bed.events.size(), 1u);
    auto const& event = bed.events.front();
    // Through the base 4 k a dT; what the gas takes makes it faster by less than a tenth.
    double const through_base = heat / (4 * 0.5 * radius * 52.7);
    EXPECT_LT(event.drying_time, through_base);
    EXPECT_GT(event.drying_time, 0.9 * through_base);
    EXPECT_NEAR(bed.granules.enthalpy[0] - before, 30 * heat, 1e-12 * 30 * heat);
    EXPECT_NEAR(bed.granules.layer_mass[0], 30 * melt, 1e-24);
    EXPECT_NEAR(bed.granules.mass[0], mass + 30 * melt, 1e-20);
    EXPECT_EQ(bed.granules.solute[0], 0);
    EXPECT_EQ(bed.evaporated[0], 0);
    EXPECT_EQ(event.mean_flux, 0);
    EXPECT_NEAR(event.mean_granule_temperature, 80 + zero_celsius, 1e-9);
}

// h = Sh (Pr / Sc)^(1/3) k / d with air of 106 degC by hand: k 0.0321 W/m/K, Pr 0.70, Sc 0.59: h = 325 W/m2/K.
TEST(Melt, through_the_gas_alone_takes_far_longer)
{
    double const melt = 4.1e-11, heat = melt * 224e3, radius = 40e-6;
    MoltenBed bed(80);
    bed.settings.solidification = law::deposit::ToGas{};
    bed.splat(1, melt, heat, radius);
    while (bed.events.empty() && bed.now < 10) bed.advance(1e-3);
    ASSERT_EQ(bed.events.size(), 1u);
    double const area = law::wetting::cap_area(radius, law::wetting::pinned_angle(melt / 1335, radius));
    EXPECT_NEAR(bed.events.front().drying_time, heat / (325 * area * 52.7), 0.05 * bed.events.front().drying_time);
}

TEST(Melt, does_not_solidify_on_a_granule_and_in_gas_as_hot_as_itself)
{
    MoltenBed bed(140);
    bed.splat(1, 4.1e-11, 9e-6, 40e-6);
    double const before = bed.granules.enthalpy[0];
    for (int n = 0; n < 100; ++n) bed.advance(1e-2);
    EXPECT_TRUE(bed.events.empty());
    EXPECT_EQ(bed.deposits.on(0).front().heat, 9e-6);
    EXPECT_EQ(bed.granules.enthalpy[0], before);
}
}
