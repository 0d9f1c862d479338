// The collision operator of hard spheres: conservation for any collision, and the rigid-body limits.
#include "granum/law/contact/all.hpp"

#include "granum/base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace
{
using namespace granum::law::contact;
using granum::math::Vec3;

struct Ball
{
    Vec3 v, w;
    double mass, radius;

    double energy() const { return 0.5 * mass * norm2(v) + 0.2 * mass * radius * radius * norm2(w); }
};

struct Collision
{
    Ball a, b;
    Vec3 n;

    explicit Collision(std::uint64_t seed)
    {
        granum::base::Random random(7, granum::base::Purpose::test, seed, 0);
        auto const any = [&] { return Vec3{random.normal(), random.normal(), random.normal()}; };
        a = {any(), 100 * any(), 1 + 9 * random.uniform(), 0.01 + 0.09 * random.uniform()};
        b = {any(), 100 * any(), 1 + 9 * random.uniform(), 0.01 + 0.09 * random.uniform()};
        n = any();
        n *= 1 / norm(n);
        if (dot(a.v - b.v, n) < 0) n = -n;
    }
    Vec3 slip() const { return a.v - b.v + cross(a.radius * a.w + b.radius * b.w, n); }
    double mass() const { return a.mass * b.mass / (a.mass + b.mass); }
    double energy() const { return a.energy() + b.energy(); }
    Vec3 momentum() const { return a.mass * a.v + b.mass * b.v; }
    // About the point of contact.
    Vec3 spin() const
    {
        Vec3 sum = 0.4 * a.mass * a.radius * a.radius * a.w + 0.4 * b.mass * b.radius * b.radius * b.w;
        return sum + cross(-a.radius * n, a.mass * a.v) + cross(b.radius * n, b.mass * b.v);
    }
    double bounce(HardPair const& pair)
    {
        auto const [impulse, lost] = Hoomans{}(pair, mass(), n, slip());
        a.v += impulse / a.mass;
        b.v -= impulse / b.mass;
        a.w += cross(n, impulse) * (2.5 / (a.mass * a.radius));
        b.w += cross(n, impulse) * (2.5 / (b.mass * b.radius));
        return lost;
    }
};

constexpr std::array<HardPair, 6> pairs{HardPair{1, 0, 0},   HardPair{1, 1e9, 1},     HardPair{0.9, 0.3, 0.33},
                                        HardPair{0, 0.5, 0}, HardPair{0.5, 0.1, 0.8}, HardPair{0.7, 1e9, 0}};

TEST(HardSphere, keeps_momentum_and_angular_momentum_and_tells_what_energy_is_lost)
{
    for (std::uint64_t seed = 0; seed < 500; ++seed)
        for (auto const& pair : pairs) {
            Collision c(seed);
            Vec3 const momentum = c.momentum(), spin = c.spin();
            double const energy = c.energy();
            double const lost = c.bounce(pair);
            EXPECT_LE(norm(c.momentum() - momentum), 1e-13 * norm(momentum) + 1e-13);
            EXPECT_LE(norm(c.spin() - spin), 1e-13 * norm(spin) + 1e-13);
            EXPECT_NEAR(c.energy() + lost, energy, 1e-13 * energy);
            EXPECT_GE(lost, -1e-14 * energy);
        }
}

TEST(HardSphere, keeps_the_energy_when_smooth_or_perfectly_rough)
{
    for (std::uint64_t seed = 0; seed < 500; ++seed)
        for (HardPair const pair : {HardPair{1, 0, 0.3}, HardPair{1, 1e9, 1}}) {
            Collision c(seed);
            double const energy = c.energy();
            c.bounce(pair);
            EXPECT_NEAR(c.energy() / energy, 1, 1e-14);
        }
}

TEST(HardSphere, gives_the_restitution_asked_for_and_reverses_the_slip_where_it_sticks)
{
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Collision c(seed);
        Vec3 const before = c.slip();
        double const approach = dot(before, c.n);
        c.bounce({0.6, 1e9, 0.4});
        EXPECT_NEAR(dot(c.slip(), c.n), -0.6 * approach, 1e-12);
        EXPECT_LE(norm((c.slip() + 0.6 * approach * c.n) + 0.4 * (before - approach * c.n)), 1e-12 * norm(before));
    }
}

TEST(HardSphere, slides_with_the_coulomb_impulse_against_the_slip)
{
    Vec3 const n{0, 0, -1};
    auto const impulse = Hoomans{}({0.98, 0.092, 0.33}, 2, n, {3, 0, -1}).on_first;
    EXPECT_NEAR(impulse.z, 1.98 * 2, 1e-14);
    EXPECT_NEAR(impulse.x, -0.092 * 1.98 * 2, 1e-14);
}

TEST(HardSphere, does_nothing_to_surfaces_that_part)
{
    auto const [impulse, lost] = Hoomans{}({0.5, 0.3, 0.33}, 1, {1, 0, 0}, {-1, 2, 0});
    EXPECT_EQ(impulse, Vec3{});
    EXPECT_EQ(lost, 0);
}
}
