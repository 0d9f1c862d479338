// The contact laws as such: restitution by integrating one collision of the law, limits, and identities.
#include "granum/law/contact/all.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{
using namespace granum::law::contact;
using granum::math::cross;
using granum::math::norm2;
using Vec = Triple<double>;

double norm(Vec const& a)
{
    return std::sqrt(norm2(a));
}

// Head-on impact of unit mass and radius on a wall with speed 1, integrated by velocity Verlet in 20,000 steps.
double restitution_of(HertzTsuji const& law, double asked)
{
    Pair<double> const pair{.youngs_modulus = 1e4, .damping = law.damping(asked)};
    double overlap = 0, speed = 1;  // closing
    double const dt = 2.943275 * std::pow(15.0 / 16e4, 0.4) / 20000;
    double force = 0;
    for (long k = 0; k < 20'000'000; ++k) {
        speed -= 0.5 * dt * force;
        overlap += dt * speed;
        if (overlap <= 0) break;
        force = law(pair,
                    Approach<double>{
                        .overlap = overlap, .radius = 1, .mass = 1, .inertia = 1.4, .speed = -speed, .step = dt})
                    .force;
        speed -= 0.5 * dt * force;
    }
    return -speed;
}

TEST(HertzTsuji, gives_the_restitution_asked_for)
{
    for (auto const attraction : {Attraction::cut, Attraction::keep})
        for (double const e : {0.2, 0.25, 0.35, 0.5, 0.65, 0.75, 0.85, 0.93, 0.96, 0.98, 1.0})
            EXPECT_NEAR(restitution_of({attraction}, e) / e, 1, 5e-3) << e;
}

TEST(HertzTsuji, damps_as_tabulated_and_ever_more_as_the_restitution_falls)
{
    HertzTsuji const cut{Attraction::cut}, keep{Attraction::keep};
    // Found by integrating the motion of a head-on impact, apart from the closed form.
    constexpr std::array<std::array<double, 2>, 12> integrated{{{0.1, 1.13487},
                                                                {0.2, 0.66753},
                                                                {0.3, 0.45392},
                                                                {0.4, 0.32362},
                                                                {0.5, 0.23303},
                                                                {0.6, 0.16510},
                                                                {0.7, 0.11157},
                                                                {0.8, 0.06788},
                                                                {0.9, 0.03128},
                                                                {0.95, 0.01506},
                                                                {0.97, 0.00891},
                                                                {0.98, 0.00589}}};
    for (auto const& [e, g] : integrated) EXPECT_NEAR(cut.damping(e), g, 6e-6) << e;
    EXPECT_NEAR(keep.damping(0.5), 0.19668, 1e-5);
    EXPECT_NEAR(keep.damping(0.9), 0.03060, 1e-5);
    EXPECT_EQ(cut.damping(1), 0);
    EXPECT_EQ(cut.damping(-3), cut.damping(1e-3));
    for (auto const& law : {cut, keep})
        for (double e = 2e-3; e <= 1; e += 1e-3) EXPECT_LT(law.damping(e), law.damping(e - 1e-3)) << e;
}

TEST(HertzTsuji, never_pulls_when_the_pull_is_cut)
{
    Pair<double> const pair{.youngs_modulus = 1e7, .damping = 0.2};
    Approach<double> const leaving{
        .overlap = 1e-8, .radius = 1e-3, .mass = 1e-6, .inertia = 1.4e-12, .speed = 1, .step = 0};
    EXPECT_EQ(HertzTsuji{Attraction::cut}(pair, leaving).force, 0);
    EXPECT_LT(HertzTsuji{Attraction::keep}(pair, leaving).force, 0);
}

TEST(Mindlin, limits_spring_and_dashpot_together_and_leaves_the_spring_at_the_limit)
{
    Pair<double> const pair{.youngs_modulus = 1e7, .tangential = Ratio(1.2), .damping = 0.3, .sliding_friction = 0.4};
    Approach<double> const at{
        .overlap = 1e-5, .radius = 1e-3, .mass = 1e-6, .inertia = 1.4e-12, .speed = 0, .step = 1e-6};
    auto const normal = HertzTsuji{}(pair, at);
    std::array<double, 3> slip{2e-6, 0, 1e-6};
    double stored = 0, stiffness = 0;
    auto const out = Mindlin{}(pair, at, normal, Vec{0, 0, 1}, Vec{3, 1, 0}, slip.data(), stored, stiffness);
    EXPECT_NEAR(norm(out.force), 0.4 * normal.force, 1e-12 * normal.force);
    EXPECT_NEAR(norm(out.force + stiffness * Vec{slip[0], slip[1], slip[2]}), 0, 1e-12 * normal.force);
    EXPECT_LT(dot(out.force, Vec{3, 1, 0}), 0);
}

TEST(Mindlin, turns_the_slip_with_the_contact_without_changing_its_length)
{
    Vec const slip{1e-6, 0, 0}, n{0.6, 0, 0.8};
    Vec const turned = turned_into_plane(slip, n);
    EXPECT_NEAR(norm(turned), 1e-6, 1e-18);
    EXPECT_NEAR(dot(turned, n), 0, 1e-18);
    EXPECT_EQ(norm(turned_into_plane(Vec{0, 0, 0}, n)), 0);
}

TEST(Epsd, builds_torque_against_the_rolling_up_to_the_limit)
{
    Pair<double> const pair{
        .youngs_modulus = 1e7, .tangential = Ratio(1.2), .sliding_friction = 0.4, .rolling_friction = 0.05};
    Approach<double> const at{
        .overlap = 1e-5, .radius = 1e-3, .mass = 1e-6, .inertia = 1.4e-12, .speed = 0, .step = 1e-7};
    auto const normal = HertzTsuji{}(pair, at);
    double const stiffness = 8 * 3e6 * std::sqrt(at.overlap * at.radius);
    std::array<double, 3> spring{};
    auto torque = Epsd{}(pair, at, normal, Vec{0, 0, 1}, Vec{0, 2, 5}, spring.data()).torque;
    EXPECT_NEAR(torque.y / (-stiffness * 1e-6 * 2 * 1e-7), 1, 1e-12);
    EXPECT_EQ(torque.z, 0);
    for (int k = 0; k < 100'000; ++k)
        torque = Epsd{}(pair, at, normal, Vec{0, 0, 1}, Vec{0, 200, 0}, spring.data()).torque;
    EXPECT_NEAR(norm(torque), 0.05 * 1e-3 * normal.force, 1e-12 * normal.force);
}
}
