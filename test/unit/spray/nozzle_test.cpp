// The nozzle sprays its rate, its sizes and its cone, and blows a jet that stays on its axis.
#include "granum/spray/nozzle.hpp"
#include "granum/law/droplet/size.hpp"
#include "granum/spray/flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace granum;
using namespace granum::spray;

Nozzle laboratory()
{
    return {.position = {0, 0, 0.3}, .air_mass_flow = 1.2 / 3600, .rate = 1.2 / 3600};
}
Liquid const benzoate{.density = 1130, .solids_fraction = 0.3};

std::vector<Droplet> spray(Nozzle const& nozzle, double duration, double dt)
{
    std::vector<Droplet> all;
    double now = 0;
    while (now < duration - 0.5 * dt) {
        auto const some = nozzle.emit(now, dt, benzoate, 1);
        all.insert(all.end(), some.begin(), some.end());
        now += dt;
    }
    return all;
}

TEST(Nozzle, sprays_its_rate_however_long_the_steps)
{
    auto const nozzle = laboratory();
    auto const coarse = spray(nozzle, 0.5, 1e-2), fine = spray(nozzle, 0.5, 0.5 / 7919);
    ASSERT_EQ(coarse.size(), fine.size());
    double mass = 0, solids = 0;
    for (std::size_t n = 0; n < coarse.size(); ++n) {
        EXPECT_EQ(coarse[n].id, fine[n].id);
        EXPECT_EQ(coarse[n].water, fine[n].water);
        EXPECT_EQ(coarse[n].velocity.x, fine[n].velocity.x);
        mass += fine[n].mass(), solids += fine[n].solids();
    }
    EXPECT_NEAR(mass, 0.5 * nozzle.rate, 1e-12 * mass);
    EXPECT_NEAR(solids, 0.3 * mass, 1e-12 * mass);
}

TEST(Nozzle, shares_no_identity_and_no_draw_with_another)
{
    auto second = laboratory();
    second.number = 1;
    auto const some = spray(laboratory(), 0.01, 1e-3), others = spray(second, 0.01, 1e-3);
    ASSERT_EQ(some.size(), others.size());
    for (std::size_t n = 0; n < some.size(); ++n) {
        EXPECT_NE(some[n].water, others[n].water);
        for (auto const& other : others) EXPECT_NE(some[n].id, other.id);
    }
}

TEST(Nozzle, lets_parcels_go_evenly_within_a_step)
{
    auto nozzle = laboratory();
    nozzle.half_angle = 1e-6;
    auto droplets = nozzle.emit(1.0, 2e-3, benzoate, 1);
    ASSERT_EQ(droplets.size(), 40u);
    for (std::size_t n = 0; n < 40; ++n) EXPECT_NEAR(droplets[n].delay, (static_cast<double>(n) + 0.5) / 2e4, 1e-9);
}

TEST(Nozzle, makes_droplets_of_the_stated_distribution_by_volume)
{
    // 40 um and 1.6: d_32 = 35.817, d_43 = 44.671, d_10 = 23.026 um (physics.md 4.1), here by parcels of equal mass.
    auto nozzle = laboratory();
    nozzle.parcels_per_second = 2e5;
    auto const droplets = spray(nozzle, 1.0, 0.1);
    std::vector<double> diameters;
    double inverse = 0, sum = 0, number = 0, by_number = 0;
    for (auto const& d : droplets) {
        double const diameter = d.diameter(benzoate);
        diameters.push_back(diameter);
        inverse += 1 / diameter, sum += diameter;
        number += d.weight, by_number += d.weight * diameter;
        EXPECT_NEAR(d.mass(), nozzle.rate / 2e5, 1e-12 * d.mass());
    }
    auto const count = static_cast<double>(droplets.size());
    std::nth_element(diameters.begin(), diameters.begin() + static_cast<long>(count / 2), diameters.end());
    // Standard errors of 2e5 parcels: median 0.13 %, d_32 and d_43 0.11 %, d_10 (few small ones weigh most) 2 %.
    EXPECT_NEAR(diameters[static_cast<std::size_t>(count / 2)], 40e-6, 0.005 * 40e-6);
    EXPECT_NEAR(count / inverse, 35.817e-6, 0.005 * 35.817e-6);
    EXPECT_NEAR(sum / count, 44.671e-6, 0.005 * 44.671e-6);
    EXPECT_NEAR(by_number / number, 23.026e-6, 0.06 * 23.026e-6);
}

TEST(Nozzle, makes_droplets_of_a_measured_distribution)
{
    auto nozzle = laboratory();
    nozzle.sizes = particle::SizeDistribution::list({20e-6, 60e-6}, {1, 3}, particle::Weighting::mass);
    nozzle.parcels_per_second = 2e5;
    double coarse = 0, count = 0;
    for (auto const& d : spray(nozzle, 0.5, 0.1)) {
        double const diameter = d.diameter(benzoate);
        EXPECT_TRUE(std::abs(diameter - 20e-6) < 1e-9 || std::abs(diameter - 60e-6) < 1e-9) << diameter;
        EXPECT_NEAR(d.mass(), nozzle.rate / 2e5, 1e-12 * d.mass());
        coarse += diameter > 40e-6, ++count;
    }
    EXPECT_NEAR(coarse / count, 0.75, 4 * std::sqrt(0.25 * 0.75 / count));
    EXPECT_EQ(nozzle.largest_diameter(), 60e-6);
    EXPECT_EQ(nozzle.median_diameter(), 60e-6);
}

TEST(Nozzle, fills_its_cone_evenly_in_solid_angle)
{
    auto nozzle = laboratory();
    nozzle.direction = Vec3{0.6, 0, -0.8};
    double cosines = 0, count = 0;
    Vec3 mean;
    for (auto const& d : spray(nozzle, 2.0, 0.1)) {
        double const cosine = math::dot(d.velocity, nozzle.direction) / math::norm(d.velocity);
        EXPECT_NEAR(math::norm(d.velocity), nozzle.droplet_velocity, 1e-10);
        EXPECT_GE(cosine, std::cos(nozzle.half_angle) - 1e-12);
        cosines += cosine, ++count;
        mean += d.velocity;
    }
    double const range = 1 - std::cos(nozzle.half_angle);
    EXPECT_NEAR(cosines / count, 1 - 0.5 * range, 4 * range / std::sqrt(12 * count));
    mean = mean / (count * nozzle.droplet_velocity);
    Vec3 const aside = mean - math::dot(mean, nozzle.direction) * nozzle.direction;
    EXPECT_LT(math::norm(aside), 4 * std::sin(nozzle.half_angle) / std::sqrt(2 * count));
}

TEST(Jet, decays_along_the_axis_as_a_free_round_jet)
{
    // u = 7.0 sqrt(J / rho) / z; half of it at the half-width 0.09 z (physics.md 4.1: 0.086 to 0.094).
    auto const nozzle = laboratory();
    double const momentum = 1.2 / 3600 * 250;
    for (double const z : {0.05, 0.1, 0.2}) {
        Vec3 const on_axis = nozzle.position + z * nozzle.direction;
        double const expected = 7.0 * std::sqrt(momentum / 1.1) / z;
        EXPECT_NEAR(nozzle.jet_speed(on_axis, 1.1), expected, 1e-12 * expected);
        EXPECT_NEAR(nozzle.jet_speed(on_axis + Vec3{0, 0.09 * z, 0}, 1.1), 0.5 * expected, 1e-12 * expected);
    }
    EXPECT_EQ(nozzle.jet_speed(nozzle.position + Vec3{0, 0, 0.01}, 1.1), 0);
    EXPECT_EQ(nozzle.jet_speed(nozzle.position - Vec3{0, 0, 1e-4}, 1.1), 250);  // never faster than it leaves
}

TEST(Jet, is_blown_evenly_about_its_axis_whatever_its_direction)
{
    for (Vec3 const direction : {Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{0.6, 0, -0.8}}) {
        auto nozzle = laboratory();
        nozzle.direction = direction;
        Vec3 const side = Vec3{0, 1, 0}, other = math::cross(direction, side);
        for (double const along : {-0.005, 0.0, 0.011, 0.025})
            for (double const across : {0.004, 0.012}) {
                Vec3 const middle = nozzle.position + along * direction;
                double const weight = nozzle.source_weight(middle + across * side, 0.0125);
                for (double const turn : {0.3, 1.2, 2.5, 4.0})
                    EXPECT_NEAR(nozzle.source_weight(middle + across * (std::cos(turn) * side + std::sin(turn) * other),
                                                     0.0125),
                                weight, 1e-12);
                EXPECT_GT(weight, 0);
            }
        EXPECT_EQ(nozzle.source_weight(nozzle.position + 0.2 * direction, 0.0125), 0);
    }
}
}
