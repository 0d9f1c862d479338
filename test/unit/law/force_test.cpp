// The forces of the gas beside drag: directions argued, sizes from closed forms, limits that must not divide by
// nothing.
#include "granum/law/force/all.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::law;
using force::Motion;
using math::Vec3;

// A granule of 0.1 mm in air.
Motion in_air()
{
    return {.slip = {}, .vorticity = {}, .spin = {}, .diameter = 1e-4, .density = 1.2, .viscosity = 1.8e-5};
}

TEST(ShearLift, pushes_a_granule_that_lags_to_where_the_gas_is_faster)
{
    // u = G y in x, so curl u = -G in z. A granule that lags sees the gas pass towards +x; faster gas is at +y.
    auto lagging = in_air();
    lagging.slip = {1, 0, 0};
    lagging.vorticity = {0, 0, -1000};
    auto leading = lagging;
    leading.slip = {-1, 0, 0};
    Vec3 const lift = force::SaffmanMei{}(lagging);
    EXPECT_GT(lift.y, 0);
    EXPECT_EQ(lift.x, 0);
    EXPECT_EQ(lift.z, 0);
    EXPECT_DOUBLE_EQ(force::SaffmanMei{}(leading).y, -lift.y);
    // Re = 6.667, a = 0.05: f = 0.549475, by hand.
    EXPECT_NEAR(lift.y, 1.304208e-9, 1e-15);
}

TEST(ShearLift, is_saffmans_for_slow_slip_and_follows_mei_above)
{
    // Saffman: 6.46 mu (d/2)^2 U sqrt(G rho / mu).
    auto slow = in_air();
    slow.slip = {1e-3, 0, 0};
    slow.vorticity = {0, 0, -1};
    double const saffman = 6.46 * 1.8e-5 * 0.25e-8 * 1e-3 * std::sqrt(1.2 / 1.8e-5);
    EXPECT_NEAR(force::SaffmanMei{}(slow).y, saffman, 1e-3 * saffman);
    // Re = 133.3, a = 0.125, by hand.
    auto fast = in_air();
    fast.diameter = 1e-3;
    fast.slip = {2, 0, 0};
    fast.vorticity = {0, 0, -500};
    EXPECT_NEAR(force::SaffmanMei{}(fast).y, 7.180754e-8, 1e-13);
}

TEST(SpinLift, lifts_a_ball_with_backspin)
{
    // It flies to +x and its top moves back: spin in +z. The gas at rest passes it towards -x.
    auto ball = in_air();
    ball.slip = {-2, 0, 0};
    ball.spin = {0, 0, 300};
    for (auto const& name : force::SpinLiftLaws::names()) {
        if (name == "none") continue;
        Vec3 const lift = force::on_granule(*force::SpinLiftLaws::make(name), ball);
        EXPECT_GT(lift.y, 0) << name;
        EXPECT_EQ(lift.x, 0) << name;
        EXPECT_EQ(lift.z, 0) << name;
    }
    // Rubinow and Keller in their own letters: pi a^3 rho Omega x V.
    EXPECT_NEAR(force::RubinowKeller{}(ball).y, math::pi * 0.125e-12 * 1.2 * 300 * 2, 1e-24);
}

TEST(SpinLift, of_loth_and_dorgan_becomes_that_of_creeping_flow_and_has_their_factor)
{
    auto const factor = [](double reynolds, double spin) {
        auto ball = in_air();
        double const speed = reynolds * ball.viscosity / (ball.density * ball.diameter);
        ball.slip = {-speed, 0, 0};
        ball.spin = {0, 0, spin * speed / ball.diameter};
        return force::LothDorgan{}(ball).y / force::RubinowKeller{}(ball).y;
    };
    EXPECT_NEAR(factor(1e-8, 1), 1, 2e-5);
    // By hand.
    EXPECT_NEAR(factor(100, 2), 0.218885, 1e-6);
    EXPECT_NEAR(factor(1000, 20), 0.025035, 1e-6);
    EXPECT_NEAR(factor(10, 0.5), 0.605957, 1e-6);
}

TEST(RotationalDrag, is_the_creeping_torque_and_then_that_of_dennis)
{
    auto spinning = in_air();
    auto const coefficient = [&](double reynolds) {
        double const rate = reynolds * spinning.viscosity / (spinning.density * 1e-8);
        spinning.spin = {0, -rate, 0};
        Vec3 const torque = force::Dennis{}(spinning);
        EXPECT_GT(torque.y, 0) << "against the spin";
        return torque.y / (0.5 * spinning.density * std::pow(0.5e-4, 5) * rate * rate);
    };
    for (double const re : {1e-3, 1.0, 31.0}) EXPECT_NEAR(coefficient(re) * re, 64 * math::pi, 1e-9) << re;
    for (double const re : {40.0, 100.0, 1000.0, 4000.0})  // four digits of the factor
        EXPECT_NEAR(coefficient(re), 12.9 / std::sqrt(re) + 128.4 / re, 1e-3 * coefficient(re)) << re;
    EXPECT_NEAR(coefficient(32), coefficient(31.5) * 31.5 / 32, 3e-3 * coefficient(32)) << "the branches meet";
}

TEST(EveryForce, vanishes_with_its_cause_and_is_finite_on_the_way)
{
    auto const small = [](Vec3 const& force, double bound) {
        return math::finite(force) && math::norm(force) <= bound;
    };
    for (double const slip : {0.0, 1e-300, 1e-12, 1.0})
        for (double const turn : {0.0, 1e-300, 1e-12, 1.0}) {
            auto motion = in_air();
            motion.slip = {slip, 0, 0};
            motion.vorticity = {0, turn, 0};
            motion.spin = {0, 0, -turn};
            SCOPED_TRACE(std::to_string(slip) + " " + std::to_string(turn));
            EXPECT_TRUE(small(force::SaffmanMei{}(motion), 1e-9 * slip * std::sqrt(turn)));
            EXPECT_TRUE(small(force::RubinowKeller{}(motion), 1e-11 * slip * turn));
            EXPECT_TRUE(small(force::LothDorgan{}(motion), 1e-11 * slip * turn));
            EXPECT_TRUE(small(force::Dennis{}(motion), 1e-15 * turn));
            EXPECT_EQ(force::None{}(motion), Vec3{});
        }
}

TEST(VirtualMass, is_one_half_for_one_sphere_and_grows_with_the_crowd)
{
    for (auto const& name : force::VirtualMassLaws::names()) {
        auto const law = *force::VirtualMassLaws::make(name);
        if (name == "none") {
            EXPECT_EQ(force::virtual_mass(law, {0.3}), 0);
            continue;
        }
        EXPECT_DOUBLE_EQ(force::virtual_mass(law, {0}), 0.5) << name;
        EXPECT_GE(force::virtual_mass(law, {0.3}), force::virtual_mass(law, {0.1})) << name;
        EXPECT_TRUE(std::isfinite(force::virtual_mass(law, {1.0}))) << name;
    }
    EXPECT_DOUBLE_EQ(force::VanWijngaarden{}({0.1}), 0.639);
    EXPECT_DOUBLE_EQ(force::Zuber{}({0.25}), 1.0);
    // Both begin with nearly the same slope, 1.39 and 1.5.
    EXPECT_NEAR((force::Zuber{}({1e-6}) - 0.5) / 1e-6, 1.5, 1e-4);
}
}
