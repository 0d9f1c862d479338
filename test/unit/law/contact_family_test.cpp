// What every contact law must do, written once over the lists of laws.
#include "granum/law/contact/all.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace
{
using namespace granum;
using namespace granum::law::contact;
using Vec = Triple<double>;
using Memory = std::array<double, 4>;

template <class List>
struct AsTypes;
template <class... Laws>
struct AsTypes<base::TypeList<Laws...>>
{
    using type = ::testing::Types<Laws...>;
};

// A contact with every member somewhere in the range that a run may meet.
struct Random
{
    std::mt19937_64 engine{17};
    double between(double low, double high) { return std::uniform_real_distribution(low, high)(engine); }
    double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    Vec vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }

    Vec unit()
    {
        Vec const v = vector(1);
        return (1 / std::sqrt(norm2(v) + 1e-30)) * v;
    }
    Pair<double> pair()
    {
        double const modulus = magnitude(1e5, 1e12), stiffness = magnitude(1, 1e7);
        return {.youngs_modulus = modulus,
                .tangential = Ratio(between(0.1, 2)),
                .damping = magnitude(1e-4, 15),
                .tangential_damping = magnitude(1e-4, 15),
                .sliding_friction = between(0, 2),
                .rolling_friction = between(0, 1),
                .rolling_damping = between(0, 2),
                .stiffness = stiffness,
                .dissipation_time = magnitude(1e-9, 1e-3)};
    }
    Approach<double> approach()
    {
        double const radius = magnitude(1e-6, 1e-1), mass = 4000 * std::pow(radius, 3) * magnitude(0.1, 10);
        bool const starting = between(0, 1) < 0.1;
        return {.overlap = between(0, 1) < 0.1 ? 0 : radius * magnitude(1e-12, 0.5),
                .radius = radius,
                .mass = mass,
                .inertia = 1.4 * mass * radius * radius,
                .speed = between(-20, 20),
                .step = starting ? 0 : magnitude(1e-9, 1e-3)};
    }
};

bool finite(Vec const& a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
Vec in_plane(Vec const& a, Vec const& n)
{
    return mul_add(-dot(a, n), n, a);
}
void expect_opposite(Vec const& a, Vec const& b)
{
    EXPECT_EQ(a.x, -b.x);
    EXPECT_EQ(a.y, -b.y);
    EXPECT_EQ(a.z, -b.z);
}

template <class Law>
struct EveryNormalLaw : ::testing::Test
{
};
TYPED_TEST_SUITE(EveryNormalLaw, AsTypes<NormalLaws>::type);

TYPED_TEST(EveryNormalLaw, is_finite_and_never_pulls_where_the_pull_is_cut)
{
    Random random;
    for (int k = 0; k < 20'000; ++k) {
        auto const out = TypeParam{}(random.pair(), random.approach());
        ASSERT_TRUE(std::isfinite(out.force) && std::isfinite(out.elastic) && std::isfinite(out.energy));
        ASSERT_TRUE(std::isfinite(out.tangential_stiffness));
        ASSERT_GE(out.force, 0);
        ASSERT_GE(out.elastic, 0);
    }
}

TYPED_TEST(EveryNormalLaw, is_elastic_at_rest_whatever_the_step)
{
    Random random;
    for (int k = 0; k < 1000; ++k) {
        auto at = random.approach();
        at.speed = 0;
        auto const out = TypeParam{}(random.pair(), at);
        EXPECT_EQ(out.force, out.elastic);
    }
}

TYPED_TEST(EveryNormalLaw, stores_the_work_of_its_elastic_force)
{
    auto const pair = Random{}.pair();
    double work = 0, before = 0;
    Approach<double> at{.overlap = 0, .radius = 1e-3, .mass = 1e-6, .inertia = 1.4e-12, .speed = 0, .step = 1e-7};
    NormalForce<double> out{};
    for (int k = 1; k <= 10'000; ++k) {
        at.overlap = k * 1e-8;
        out = TypeParam{}(pair, at);
        work += 0.5e-8 * (before + out.elastic);
        before = out.elastic;
    }
    EXPECT_NEAR(out.energy / work, 1, 1e-6);
}

TYPED_TEST(EveryNormalLaw, damps_more_for_a_lower_restitution_and_not_at_all_for_one)
{
    for (auto const attraction : {Attraction::cut, Attraction::keep}) {
        TypeParam const law{attraction};
        EXPECT_EQ(law.damping(1), 0);
        for (double e = 2e-3; e <= 1; e += 1e-3) EXPECT_LT(law.damping(e), law.damping(e - 1e-3)) << e;
    }
}

template <class Law>
struct EveryTangentialLaw : ::testing::Test
{
};
TYPED_TEST_SUITE(EveryTangentialLaw, AsTypes<TangentialLaws>::type);

TYPED_TEST(EveryTangentialLaw, is_finite_within_the_friction_and_exactly_opposite_for_the_partner)
{
    Random random;
    for (int k = 0; k < 20'000; ++k) {
        auto const pair = random.pair();
        auto const at = random.approach();
        auto const normal = HertzTsuji{}(pair, at);
        Vec const n = random.unit(), velocity = in_plane(random.vector(10), n);
        double const size = random.between(0, 1) < 0.2 ? 0 : random.magnitude(1e-14, 1);
        double const stiffness_before = random.magnitude(1e-3, 1e9);
        Vec const kept = random.vector(size);
        Memory mine{kept.x, kept.y, kept.z, stiffness_before}, theirs{-kept.x, -kept.y, -kept.z, stiffness_before};
        double stored = 0, other_stored = 0, stiffness = stiffness_before, other_stiffness = 0;
        auto const out = TypeParam{}(pair, at, normal, n, velocity, mine.data(), stored, stiffness);
        auto const back = TypeParam{}(pair, at, normal, -n, -velocity, theirs.data(), other_stored, other_stiffness);
        ASSERT_TRUE(finite(out.force) && std::isfinite(out.work) && std::isfinite(stored));
        for (double const value : mine) ASSERT_TRUE(std::isfinite(value));
        ASSERT_LE(std::sqrt(norm2(out.force)), pair.sliding_friction * normal.force * (1 + 1e-12));
        expect_opposite(out.force, back.force);  // also: no force depends on the ledger's stiffness
        for (std::size_t d = 0; d < 3; ++d) ASSERT_EQ(mine[d], -theirs[d]);
    }
}

TYPED_TEST(EveryTangentialLaw, gives_back_no_more_than_it_was_given_over_a_closed_cycle_at_one_overlap)
{
    Pair<double> const pair{
        .youngs_modulus = 1e7, .tangential = Ratio(1.2), .tangential_damping = 0.05, .sliding_friction = 0.4};
    Approach<double> const at{
        .overlap = 1e-5, .radius = 1e-3, .mass = 1e-6, .inertia = 1.4e-12, .speed = 0, .step = 1e-7};
    auto const normal = HertzTsuji{}(pair, at);
    for (double const amplitude : {1e-8, 1e-6, 1e-5}) {
        Memory kept{};
        double work = 0, stored = 0, stiffness = 0;
        Vec before{0, 0, 0};
        for (int k = 0; k < 40'000; ++k) {
            double const speed =
                amplitude * 2 * std::acos(-1.0) / 10'000 / at.step * std::cos(2 * std::acos(-1.0) * (k + 0.5) / 10'000);
            auto const force =
                TypeParam{}(pair, at, normal, Vec{0, 0, 1}, Vec{speed, 0, 0}, kept.data(), stored, stiffness).force;
            work -= 0.5 * at.step * speed * (before.x + force.x);  // done on the contact
            before = force;
        }
        EXPECT_GE(work, stored - 1e-9 * std::abs(work));
    }
}

template <class Law>
struct EveryRollingLaw : ::testing::Test
{
};
TYPED_TEST_SUITE(EveryRollingLaw, AsTypes<RollingLaws>::type);

TYPED_TEST(EveryRollingLaw, is_finite_in_the_plane_and_exactly_opposite_for_the_partner)
{
    Random random;
    for (int k = 0; k < 20'000; ++k) {
        auto const pair = random.pair();
        auto const at = random.approach();
        auto const normal = HertzTsuji{}(pair, at);
        Vec const n = random.unit(), spin = random.vector(1000);
        Vec const kept = random.vector(random.between(0, 1) < 0.2 ? 0 : random.magnitude(1e-15, 1));
        Memory mine{kept.x, kept.y, kept.z, 0}, theirs{-kept.x, -kept.y, -kept.z, 0};
        auto const out = TypeParam{}(pair, at, normal, n, spin, mine.data());
        auto const back = TypeParam{}(pair, at, normal, -n, -spin, theirs.data());
        ASSERT_TRUE(finite(out.torque) && std::isfinite(out.energy) && std::isfinite(out.work));
        ASSERT_LE(std::abs(dot(out.torque, n)), 1e-12 * (1 + std::sqrt(norm2(out.torque))));
        expect_opposite(out.torque, back.torque);
        double const spring = std::sqrt(mine[0] * mine[0] + mine[1] * mine[1] + mine[2] * mine[2]);
        if (TypeParam::history > 0) {
            ASSERT_LE(spring, pair.rolling_friction * at.radius * normal.force * (1 + 1e-12));
        }
    }
}

TEST(MindlinRescaled, lets_the_spring_fall_with_the_stiffness_and_gains_nothing_by_unloading_first)
{
    // Slip while pressed, unload to a quarter of the overlap, slip back: the spring holds half of what it held.
    Pair<double> const pair{.youngs_modulus = 1e7, .tangential = Ratio(1.2), .sliding_friction = 10};
    Approach<double> at{.overlap = 4e-5, .radius = 1e-3, .mass = 1e-6, .inertia = 1.4e-12, .speed = 0, .step = 1e-6};
    Memory summed{}, rescaled{};
    double stored = 0, stiffness = 0;
    auto const both = [&](Vec const& velocity) {
        auto const normal = HertzTsuji{}(pair, at);
        Vec const n{0, 0, 1};
        auto const a = MindlinIncremental{}(pair, at, normal, n, velocity, summed.data(), stored, stiffness);
        auto const b = MindlinRescaled{}(pair, at, normal, n, velocity, rescaled.data(), stored, stiffness);
        return std::array{a.force.x, b.force.x};
    };
    auto const loaded = both({-0.1, 0, 0});
    EXPECT_NEAR(loaded[0] / loaded[1], 1, 1e-14);
    at.overlap = 1e-5;
    auto const unloaded = both({0, 0, 0});
    EXPECT_NEAR(unloaded[0] / loaded[0], 1, 1e-14);
    EXPECT_NEAR(unloaded[1] / loaded[1], 0.5, 1e-14);
}

TEST(EpsdDashpot, adds_its_viscous_torque_below_the_limit_only)
{
    Pair<double> const pair{
        .youngs_modulus = 1e7, .tangential = Ratio(1.2), .rolling_friction = 0.05, .rolling_damping = 0.3};
    Approach<double> const at{
        .overlap = 1e-5, .radius = 1e-3, .mass = 1e-6, .inertia = 1.4e-12, .speed = 0, .step = 1e-9};
    auto const normal = HertzTsuji{}(pair, at);
    Vec const n{0, 0, 1}, spin{0, 2, 0};
    Memory plain{}, damped{};
    auto const spring = Epsd{}(pair, at, normal, n, spin, plain.data()).torque.y;
    auto const both = EpsdDashpot{}(pair, at, normal, n, spin, damped.data()).torque.y;
    double const stiffness = normal.tangential_stiffness * 1e-6;
    EXPECT_NEAR((both - spring) / (-2 * 0.3 * std::sqrt(1.4e-12 * stiffness) * 2), 1, 1e-3);
    EXPECT_EQ(plain, damped);
    double const limit = 0.05 * 1e-3 * normal.force;
    Memory full{0, -limit, 0, 0};
    EXPECT_NEAR(EpsdDashpot{}(pair, at, normal, n, spin, full.data()).torque.y / -limit, 1, 1e-9);
}

TEST(HertzViscoelastic, loses_with_the_fifth_root_of_the_speed_and_by_the_known_first_coefficient)
{
    // 1 - e = 1.15344 (3/2) A (k/m)^(2/5) v^(1/5) at small loss, k = 4/3 E* sqrt(R*): Ramirez, Poeschel, Brilliantov
    // and Schwager, Phys. Rev. E 60 (1999) 4465 (recalled); the coefficient is (2/5) 3 (5/4)^(3/5) B(3/5, 3/2) / (3/2).
    double const modulus = 1e7, radius = 1e-3, mass = 1e-6;
    for (auto const attraction : {Attraction::cut, Attraction::keep})
        for (double const speed : {0.1, 3.2}) {
            double const time = HertzViscoelastic{attraction}.dissipation_time(0.998, modulus, radius, mass, speed);
            double const rate = std::pow(4.0 / 3.0 * modulus * std::sqrt(radius) / mass, 0.4) * std::pow(speed, 0.2);
            EXPECT_NEAR(1.5 * time * rate * 1.15344 / 0.002, 1, 5e-3);
        }
}
}
