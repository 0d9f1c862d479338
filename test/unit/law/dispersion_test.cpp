// Turbulent dispersion: long-time spread against its closed form, and whether what is mixed stays mixed.
#include "granum/base/random.hpp"
#include "granum/law/dispersion/all.hpp"
#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace
{
using namespace granum;
using namespace granum::law;
using dispersion::Eddy;
using dispersion::Turbulence;
using math::Vec3;

Vec3 normals(base::Random& random)
{
    double const x = random.normal(), y = random.normal(), z = random.normal();
    return {x, y, z};
}

base::Random stream(int tracer)
{
    return {7, base::Purpose::test, static_cast<std::uint64_t>(tracer), 0};
}

//! Mean square of the displacement of a component after `time` in homogeneous turbulence, tracers begun in equilibrium.
template <class Law>
double spread(Law const& law, Turbulence const& gas, double time, double step, int tracers)
{
    double sum = 0;
    for (int tracer = 0; tracer < tracers; ++tracer) {
        auto random = stream(tracer);
        Eddy eddy{normals(random), 0};
        Vec3 way;
        for (long k = std::lround(time / step); k > 0; --k) way += step * law(eddy, gas, step, normals(random));
        sum += math::norm2(way) / 3;
    }
    return sum / tracers;
}

TEST(Langevin, spreads_tracers_as_taylor_says)
{
    // sigma = 1 m/s, T = 0.1 s: after 10 s 2 sigma^2 T (t - T (1 - exp(-t/T))) = 1.98 m2. 30 000 components leave a
    // statistical error of 0.8 %.
    dispersion::Langevin const law;
    Turbulence const gas{.energy = 1.5, .dissipation = law.time_ratio * 1.5 / 0.1};
    EXPECT_NEAR(law.integral_time(gas), 0.1, 1e-15);
    EXPECT_NEAR(spread(law, gas, 10, 0.02, 10000), 1.98, 0.03 * 1.98);
}

TEST(Langevin, spreads_tracers_at_first_with_the_gas)
{
    // Far below T the gas's velocity is a constant: sigma^2 t^2 (1 - t/(3T)) to the second order.
    dispersion::Langevin const law;
    Turbulence const gas{.energy = 1.5, .dissipation = law.time_ratio * 1.5 / 0.1};
    EXPECT_NEAR(spread(law, gas, 0.01, 0.0005, 10000), 1e-4 * (1 - 0.1 / 3), 0.03e-4);
}

TEST(Langevin, forgets_exactly_whatever_the_step)
{
    // Two steps without new numbers are one of the double length.
    dispersion::Langevin const law;
    Turbulence const gas{.energy = 2, .dissipation = 3, .gradient = {0.4, 0, -1}};
    Eddy once{{1, -2, 0.5}}, twice = once;
    Vec3 const velocity = law(once, gas, 0.2, {});
    law(twice, gas, 0.1, {});
    Vec3 const same = law(twice, gas, 0.1, {});
    EXPECT_NEAR(math::norm(velocity - same), 0, 1e-14);
    // The variance put in is what was forgotten: 1 - a^2.
    Eddy none;
    Turbulence const plain{.energy = 2, .dissipation = 3};
    double const a = std::exp(-0.2 / (0.3 * 2 / 3.0));
    EXPECT_NEAR(law(none, plain, 0.2, {1, 0, 0}).x, std::sqrt(4.0 / 3) * std::sqrt(1 - a * a), 1e-14);
}

//! Largest deviation from the mean of the number of tracers in tenths of a channel whose turbulence grows from the
//! walls to the middle: k = (0.25 + 0.75 sin^2(pi y/H)) m2/s2. Walls mirror.
template <class Law>
double unevenness(Law const& law, bool with_gradient)
{
    double const height = 0.5, step = 0.005;
    int const tracers = 10000, bins = 10;
    auto const turbulence = [&](double y) {
        double const angle = math::pi * y / height;
        double const k = 0.25 + 0.75 * std::sin(angle) * std::sin(angle);
        double const slope = 0.75 * math::pi / height * std::sin(2 * angle);
        return Turbulence{.energy = k, .dissipation = 3 * k, .gradient = {0, with_gradient ? slope : 0, 0}};
    };
    std::array<double, bins> count{};
    for (int tracer = 0; tracer < tracers; ++tracer) {
        auto random = stream(tracer);
        double y = height * random.uniform();
        Eddy eddy{{0, random.normal(), 0}, 0};
        for (int k = 1; k <= 2000; ++k) {
            y += step * law(eddy, turbulence(y), step, {0, random.normal(), 0}).y;
            if (y < 0 || y > height) {
                y = y < 0 ? -y : 2 * height - y;
                eddy.fluctuation.y = -eddy.fluctuation.y;
            }
            // Counted at intervals in which a tracer forgets where it was.
            if (k > 400 && k % 50 == 0) count[static_cast<std::size_t>(y / height * bins)] += 1;
        }
    }
    double sum = 0, worst = 0;
    for (double const number : count) sum += number;
    for (double const number : count) worst = std::max(worst, std::abs(number * bins / sum - 1));
    return worst;
}

TEST(Langevin, keeps_tracers_mixed_where_the_turbulence_is_uneven)
{
    EXPECT_LT(unevenness(dispersion::Langevin{}, true), 0.03);
}

TEST(Langevin, would_unmix_them_without_its_drift)
{
    EXPECT_GT(unevenness(dispersion::Langevin{}, false), 0.15);
}

TEST(DiscreteWalk, spreads_tracers_by_whole_eddies)
{
    // Eddies of 0.1 s, 100 of them: sigma^2 t_e t = 1 m2.
    Turbulence const gas{.energy = 1.5, .dissipation = 15};
    EXPECT_DOUBLE_EQ(dispersion::DiscreteWalk::eddy_time(gas), 0.1);
    EXPECT_NEAR(spread(dispersion::DiscreteWalk{}, gas, 10, 0.02, 10000), 1, 0.03);
}

TEST(DiscreteWalk, unmixes_tracers_as_its_page_says)
{
    EXPECT_GT(unevenness(dispersion::DiscreteWalk{}, true), 0.1);
}

TEST(DiscreteWalk, keeps_an_eddy_for_its_time)
{
    dispersion::DiscreteWalk const law;
    Turbulence const gas{.energy = 1.5, .dissipation = 15};
    Eddy eddy;
    Vec3 const first = law(eddy, gas, 0.02, {1, 0, 0});
    EXPECT_EQ(first, (Vec3{1, 0, 0}));
    for (int k = 0; k < 4; ++k) EXPECT_EQ(law(eddy, gas, 0.02, {0, 9, 0}), first) << k;
    EXPECT_EQ(law(eddy, gas, 0.02, {0, 9, 0}), (Vec3{0, 9, 0}));
    // A droplet that falls through eddies leaves them early: 0.09^(3/4) k^(3/2) / (epsilon slip).
    Turbulence falling = gas;
    falling.slip = 5;
    EXPECT_NEAR(law.eddy_time(falling), std::pow(0.09, 0.75) * std::pow(1.5, 1.5) / (15 * 5), 1e-15);
    falling.slip = 0.01;
    EXPECT_DOUBLE_EQ(law.eddy_time(falling), 0.1);
}

TEST(Dispersion, of_every_law_is_nothing_in_gas_at_rest_and_finite_without_dissipation)
{
    for (auto const& name : dispersion::All::names()) {
        auto const law = *dispersion::All::make(name);
        Eddy eddy;
        EXPECT_EQ(dispersion::fluctuation(law, eddy, {0, 0, {}, 0}, 0.1, {1, 1, 1}), Vec3{}) << name;
        EXPECT_EQ(dispersion::fluctuation(law, eddy, {-1e-9, 0, {1, 1, 1}, 0}, 0.1, {1, 1, 1}), Vec3{}) << name;
        EXPECT_TRUE(math::finite(dispersion::fluctuation(law, eddy, {1, 0, {1, 0, 0}, 2}, 0.1, {1, 1, 1}))) << name;
        EXPECT_TRUE(math::finite(dispersion::fluctuation(law, eddy, {1e-12, 1, {1, 0, 0}, 2}, 0.1, {1, 1, 1}))) << name;
    }
}
}
