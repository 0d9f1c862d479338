// Atomising air and the droplets that correlations promise of it.
#include "granum/law/atomising/droplets.hpp"
#include "granum/law/atomising/orifice.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum::law::atomising;

TEST(Orifice, of_one_square_millimetre_at_three_bar_passes_what_gas_dynamics_says)
{
    Orifice const mouth{.pressure = 3e5, .temperature = 293, .ambient = 101325, .area = 1e-6, .discharge = 1};
    EXPECT_TRUE(mouth.choked());
    EXPECT_NEAR(mouth.critical_ratio(), 0.5283, 5e-5);
    EXPECT_NEAR(mouth.mass_flow(), 7.083e-4, 5e-8);  // 0.040415 p A / sqrt(T)
    EXPECT_NEAR(mouth.velocity(), 313, 0.5);
    EXPECT_NEAR(mouth.mouth_temperature(), 293 / 1.2, 1e-9);
    // What is left of the pressure adds a quarter to the momentum.
    EXPECT_NEAR(mouth.thrust() / (mouth.mass_flow() * mouth.velocity()), 1.26, 0.005);
    auto filled = mouth;
    filled.discharge = 0.8;
    EXPECT_NEAR(filled.mass_flow(), 0.8 * mouth.mass_flow(), 1e-18);
    EXPECT_NEAR(filled.thrust(), 0.8 * mouth.thrust(), 1e-15);
}

TEST(Orifice, not_choked_expands_to_the_chamber)
{
    Orifice const mouth{.pressure = 1.2e5, .temperature = 293.15, .ambient = 1e5, .area = 2e-6, .discharge = 1};
    EXPECT_FALSE(mouth.choked());
    EXPECT_EQ(mouth.mouth_pressure(), 1e5);
    // Tables of isentropic flow: p/p0 = 0.8333 at Mach 0.5170, T/T0 = 0.9492.
    EXPECT_NEAR(mouth.mach(), 0.5170, 2e-4);
    EXPECT_NEAR(mouth.mouth_temperature() / 293.15, 0.9492, 1e-4);
    EXPECT_NEAR(mouth.thrust(), mouth.mass_flow() * mouth.velocity(), 1e-18);
    // Energy: half of the square of the velocity is what the air has cooled by.
    double const capacity = 1.4 / 0.4 * 287.05;
    EXPECT_NEAR(0.5 * mouth.velocity() * mouth.velocity(), capacity * (293.15 - mouth.mouth_temperature()), 1e-6);
    // Of little excess it is Bernoulli's.
    auto weak = mouth;
    weak.pressure = 1.0001e5;
    EXPECT_NEAR(weak.velocity(), std::sqrt(2 * 10 / (1e5 / (287.05 * 293.15))), 0.001);
}

TEST(Orifice, passes_from_one_regime_to_the_other_without_a_jump)
{
    Orifice mouth{.pressure = 2e5, .temperature = 293.15, .ambient = 0, .area = 1e-6};
    mouth.ambient = mouth.critical_ratio() * mouth.pressure * (1 - 1e-9);
    double const choked = mouth.thrust(), flow = mouth.mass_flow();
    mouth.ambient *= 1 + 2e-9;
    EXPECT_FALSE(mouth.choked());
    EXPECT_NEAR(mouth.thrust(), choked, 1e-7 * choked);
    EXPECT_NEAR(mouth.mass_flow(), flow, 1e-7 * flow);
}

TEST(Correlations, of_droplets_have_the_trends_that_nozzles_have)
{
    Atomisation const lab{.liquid_flow = 3.333e-4,
                          .air_flow = 3.333e-4,
                          .air_excess_pressure = 1e5,
                          .air_density = 1.2,
                          .air_velocity = 250,
                          .density = 1130,
                          .viscosity = 3e-3,
                          .surface_tension = 0.063,
                          .bore = 1e-3};
    for (std::string const name : Droplets::names()) {
        auto const law = *Droplets::make(name);
        auto const of = [&](Atomisation const& at) { return std::visit([&](auto const& l) { return l(at); }, law); };
        EXPECT_GT(of(lab), 5e-6) << name;
        EXPECT_LT(of(lab), 200e-6) << name;
        auto other = lab;
        other.air_excess_pressure *= 2, other.air_velocity *= 1.3;
        EXPECT_LT(of(other), of(lab)) << name << ": more pressure, finer";
        other = lab, other.air_flow *= 2;
        EXPECT_LT(of(other), of(lab)) << name << ": more air, finer";
        other = lab, other.viscosity *= 10;
        EXPECT_GT(of(other), of(lab)) << name << ": more viscous, coarser";
    }
    // By hand: 0.35 mm (1e5 * 1e-3 / (0.063 * 4))^-0.4 (1 + 2.5 * 0.003 / sqrt(1130 * 0.063 * 1e-3)).
    EXPECT_NEAR(Walzel{}(lab), 0.35e-3 * std::pow(396.825, -0.4) * (1 + 2.5 * 0.0112444), 2e-10);
    // 0.95 (0.063 * 3.333e-4)^0.33 / (250 * 1130^0.37 * 1.2^0.3) * 2^1.7 + 0.13 (9e-6 * 1e-3 / 71.19)^0.5 * 2^1.7.
    EXPECT_NEAR(LorenzettoLefebvre{}(lab), (0.95 * 0.0285968 / (250 * 13.4784 * 1.05622) + 0.13 * 1.12438e-5) * 3.24901,
                2e-8);
}
}
