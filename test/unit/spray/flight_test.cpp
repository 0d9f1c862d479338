// Droplets fall, evaporate and are captured as closed forms say, and whatever they lose is found with somebody.
#include "granum/spray/flight.hpp"
#include "granum/geometry/bodies_in_chamber.hpp"
#include "granum/law/droplet/evaporation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace granum;
using namespace granum::spray;
using math::zero_celsius;

//! Uniform gas and bed; keeps account of what it is given. Ranks are parted at x = `border`.
struct Uniform final : Surroundings
{
    Seen everywhere;
    std::vector<Target> bed;
    double border = 1e9;
    Given received;

    Seen seen(Vec3 const&) const override { return everywhere; }
    void give(Vec3 const&, Given const& given) override
    {
        received.vapour += given.vapour;
        received.enthalpy += given.enthalpy;
        received.momentum += given.momentum;
    }
    void targets(Vec3 const&, std::vector<Target>& out) const override { out = bed; }
    bool mine(Vec3 const& x) const override { return x.x < border; }
};

//! Gas of `celsius` and `humidity` (kg/kg dry) at rest.
Seen gas(double celsius, double humidity)
{
    Seen seen;
    seen.temperature = celsius + zero_celsius;
    seen.vapour_fraction = material::fraction(humidity);
    seen.density = material::density(101325, seen.temperature, seen.vapour_fraction);
    seen.viscosity = material::viscosity(seen.temperature);
    return seen;
}

//! Gas that leaves a droplet of its own temperature as wet as it is.
Seen saturated(double celsius)
{
    return gas(celsius, material::saturation_humidity(celsius + zero_celsius, 101325));
}

Droplet droplet(Liquid const& liquid, double diameter, double celsius, Vec3 position, Vec3 velocity = {},
                double weight = 1)
{
    double const mass = liquid.density * math::pi / 6 * std::pow(diameter, 3);
    Droplet out{.position = position, .velocity = velocity, .weight = weight};
    out.solute = mass * liquid.solids_fraction;
    out.water = mass - out.solute;
    out.temperature = celsius + zero_celsius;
    return out;
}

struct Flight
{
    geometry::Chamber chamber{.size = {1, 1, 1}};
    FlightSettings settings;
    Uniform around;
    std::vector<Droplet> droplets;
    Outcome outcome;
    std::uint32_t steps = 0;

    void step(double dt) { fly(droplets, settings, chamber, around, dt, steps++, outcome); }
};

//! Nearly pure water: the trace of solids keeps the droplet's identity.
Liquid water()
{
    return {.density = 998, .solids_fraction = 1e-7, .solubility = 0};
}

TEST(Droplet, falls_at_the_terminal_speed_of_schiller_and_naumann)
{
    // 30 um, 1000 kg/m3, rho 1.2, mu 1.8e-5: 0.02668 m/s (physics.md 1.10, weight less buoyancy). The flight leaves
    // buoyancy out, so the droplet is lighter by it.
    Flight flight;
    flight.settings.gravity = {0, 0, -9.81};
    flight.settings.liquid = {.density = 1000 - 1.2, .solids_fraction = 0.3};
    flight.around.everywhere = saturated(20);
    flight.around.everywhere.density = 1.2, flight.around.everywhere.viscosity = 1.8e-5;
    flight.droplets = {droplet(flight.settings.liquid, 30e-6, 20, {0.5, 0.5, 0.5})};
    for (int n = 0; n < 60; ++n) flight.step(1e-3);
    ASSERT_EQ(flight.droplets.size(), 1u);
    EXPECT_NEAR(flight.droplets[0].diameter(flight.settings.liquid), 30e-6, 1e-10);
    EXPECT_NEAR(flight.droplets[0].velocity.z, -0.02668, 0.51e-5);
    EXPECT_NEAR(0.5 - flight.droplets[0].position.z, flight.droplets[0].path, 1e-12);
    EXPECT_NEAR(flight.droplets[0].age, 0.06, 1e-12);
}

TEST(Droplet, gives_the_gas_the_momentum_it_loses)
{
    Flight flight;
    flight.settings.gravity = {0, 0, -9.81};
    auto const& liquid = flight.settings.liquid = {.density = 1100, .solids_fraction = 0.3};
    flight.around.everywhere = saturated(20);
    flight.around.everywhere.gas_velocity = {0.3, 0, 0.1};
    flight.droplets = {droplet(liquid, 60e-6, 20, {0.5, 0.5, 0.5}, {1, -2, 3}, 50)};
    auto const before = flight.droplets[0];
    for (int n = 0; n < 20; ++n) flight.step(1e-3);
    auto const& after = flight.droplets.at(0);
    Vec3 const expected = before.mass() * (before.velocity - after.velocity + Vec3{0, 0, -9.81 * 0.02});
    for (std::size_t d = 0; d < 3; ++d)
        EXPECT_NEAR(flight.around.received.momentum[d], expected[d], 1e-6 * before.mass());
}

TEST(Evaporation, moves_the_law_s_mass_and_keeps_all_enthalpy)
{
    for (double const humidity : {0.0, 0.012, 0.05})  // the last condenses on the cold droplet
        for (double const dt : {1e-6, 1e-4, 1e-2}) {
            FlightSettings settings;
            settings.liquid = {
                .density = 1130, .solids_fraction = 0.3, .solubility = 0.63, .molar_mass = 0.1441, .dissociation = 2};
            auto drop = droplet(settings.liquid, 40e-6, 25, {}, {0, 0, -20}, 1000);
            auto const before = drop;
            auto const seen = gas(60, humidity);
            auto const given = evaporate(drop, settings, seen, 2.0, dt);
            EXPECT_NEAR(given.vapour, before.liquid_water() - drop.liquid_water(), 1e-13 * before.liquid_water());
            EXPECT_EQ(drop.solute, before.solute);
            double const start = before.enthalpy(settings.liquid);
            EXPECT_NEAR(drop.enthalpy(settings.liquid) + given.enthalpy, start, 1e-12 * std::abs(start));
            EXPECT_NEAR(given.momentum.z, -20 * given.vapour, 1e-12 * std::abs(given.vapour));
            if (dt > 1e-5) continue;
            double const activity = law::droplet::water_activity(0.7 / 0.3, 0.63, 0.1441, 2);
            auto const rates = law::droplet::evaporation({40e-6, 25 + zero_celsius, activity, 2.0},
                                                         {seen.temperature, seen.vapour_fraction, 101325});
            EXPECT_NEAR(given.vapour / (1000 * dt), rates.mass, 0.01 * std::abs(rates.mass)) << humidity;
            double const heat = given.vapour * material::vapour_enthalpy(25 + zero_celsius) - given.enthalpy;
            EXPECT_NEAR(heat / (1000 * dt), rates.heat, 0.01 * std::abs(rates.heat)) << humidity;
        }
}

TEST(Evaporation, in_flight_follows_the_d2_law_with_independent_constants)
{
    // Air, then T_s in degC and K = -d(d^2)/dt in m2/s of a droplet without slip: physics.md 4.2.
    struct Row
    {
        double celsius, humidity, diameter, surface, rate;
    };
    for (auto const& row : {Row{25, 0, 50e-6, 7.150, 1.4328e-9},
                            {60, 0.008, 30e-6, 25.377, 3.0017e-9},
                            {80, 0.008, 30e-6, 29.490, 4.4808e-9},
                            {20, 0.0072617, 50e-6, 13.443, 5.3551e-10}}) {
        Flight flight;
        flight.settings.liquid = water();
        flight.around.everywhere = gas(row.celsius, row.humidity);
        flight.droplets = {droplet(water(), row.diameter, row.surface, {0.5, 0.5, 0.5})};
        double const life = row.diameter * row.diameter / row.rate, dt = life / 2000;
        auto const square = [&] { return std::pow(flight.droplets.at(0).diameter(water()), 2); };
        for (int n = 0; n < 200; ++n) flight.step(dt);
        double const early = square();
        for (int n = 0; n < 1400; ++n) flight.step(dt);
        EXPECT_NEAR((early - square()) / (1400 * dt), row.rate, 0.005 * row.rate);
        EXPECT_NEAR(flight.droplets.at(0).temperature - zero_celsius, row.surface, 0.05);
        // It ends as dust that flies on, at the end of its life, and has the gas's temperature then.
        for (int n = 0; n < 500; ++n) flight.step(dt);
        auto const& dust = flight.droplets.at(0);
        EXPECT_TRUE(dust.dry(water(), 0.01));
        EXPECT_NEAR(dust.temperature - zero_celsius, row.celsius, 0.1);
    }
}

TEST(Evaporation, of_a_small_droplet_in_long_steps_stays_between_wet_bulb_and_gas)
{
    Flight flight;
    flight.settings.liquid = {.density = 1130, .solids_fraction = 0.3};
    flight.around.everywhere = gas(80, 0.008);
    flight.droplets = {droplet(flight.settings.liquid, 5e-6, 25, {0.5, 0.5, 0.5})};
    for (int n = 0; n < 40; ++n) {
        flight.step(5e-4);
        EXPECT_GE(flight.droplets[0].temperature, 24.9 + zero_celsius);
        EXPECT_LE(flight.droplets[0].temperature, 80 + zero_celsius);
        EXPECT_GE(flight.droplets[0].water, 0);
    }
    EXPECT_TRUE(flight.droplets[0].dry(flight.settings.liquid, 0.01));
}

TEST(Crust, freezes_the_diameter_where_solids_fill_their_share)
{
    // 25 % of chalk by mass is 1190 * 0.25 / 2710 = 0.10978 by volume; locked at 0.6 the droplet is
    // (0.10978/0.6)^(1/3).
    Flight flight;
    auto& liquid = flight.settings.liquid = {.density = 1190, .solids_density = 2710, .solids_fraction = 0.25};
    liquid.locking = 0.6;
    flight.around.everywhere = gas(60, 0.008);
    flight.droplets = {droplet(liquid, 50e-6, 25, {0.5, 0.5, 0.5})};
    auto const life = [&](double until) {
        int n = 0;
        while (flight.droplets[0].water > until * flight.droplets[0].solute && n < 100000) flight.step(2e-4), ++n;
        return 2e-4 * n;
    };
    double const locking = life(0.2);
    double const frozen = flight.droplets[0].diameter(liquid);
    EXPECT_NEAR(frozen, 50e-6 * std::cbrt(0.10978 / 0.6), 0.01 * frozen);
    EXPECT_TRUE(flight.droplets[0].dry(liquid, 0.01));
    double const rest = life(0.01);
    EXPECT_EQ(flight.droplets[0].diameter(liquid), frozen);

    // Through a crust of a hundredth of the diffusivity the rest takes longer; till then nothing has changed.
    liquid.crust_diffusivity = 2.6e-7;
    flight.droplets = {droplet(liquid, 50e-6, 25, {0.5, 0.5, 0.5})};
    EXPECT_EQ(life(0.2) > 0.9 * locking, true);
    EXPECT_GT(life(0.01), 3 * rest);
    // Slow solids gather at the surface: it locks larger.
    liquid.crust_diffusivity = 0, liquid.solids_diffusivity = 1e-10;
    flight.droplets = {droplet(liquid, 50e-6, 25, {0.5, 0.5, 0.5})};
    life(0.2);
    EXPECT_GT(flight.droplets[0].diameter(liquid), 1.05 * frozen);
}

//! Many droplets that shoot about in a bed.
Flight crowd(double solids_fraction)
{
    Flight flight;
    flight.settings.gravity = {0, 0, -9.81};
    flight.settings.liquid = {.density = 1130, .solids_fraction = 0.3};
    flight.settings.longest_hop = 0.002;
    flight.around.everywhere = gas(70, 0.01);
    flight.around.everywhere.solids_fraction = solids_fraction;
    for (std::uint64_t id = 0; id < 2000; ++id) {
        base::Random random(1, base::Purpose::test, id, 0);
        Vec3 const position{random.uniform(), random.uniform(), random.uniform()};
        Vec3 const velocity{20 * random.normal(), 20 * random.normal(), 20 * random.normal()};
        auto fresh = droplet(flight.settings.liquid, (5 + 55 * random.uniform()) * 1e-6, 25, position, velocity, 1e3);
        fresh.id = id;
        flight.droplets.push_back(fresh);
    }
    if (solids_fraction > 0) {
        double const d = 0.6e-3, number = solids_fraction / (math::pi / 6 * d * d * d);
        flight.around.bed = {{0, 0.25 * number, {}, d}, {1, 0.75 * number, {}, d}};
    }
    return flight;
}

TEST(Flight, finds_all_that_was_sprayed_with_somebody)
{
    auto flight = crowd(0.01);
    auto const& liquid = flight.settings.liquid;
    flight.around.border = 0.9;
    Losses start;
    for (auto const& d : flight.droplets) {
        start.solids += d.solids(), start.water += d.liquid_water(), start.enthalpy += d.enthalpy(liquid);
    }
    for (int n = 0; n < 100; ++n) flight.step(5e-4);
    Losses end = flight.outcome.walls;
    auto const count = [&](Droplet const& d) {
        end.solids += d.solids(), end.water += d.liquid_water(), end.enthalpy += d.enthalpy(liquid);
    };
    for (auto const& d : flight.droplets) count(d);
    for (auto const& d : flight.outcome.leaving) count(d);
    for (auto const& hit : flight.outcome.hits) count(hit.droplet);
    end.solids += flight.outcome.overspray.solids;
    end.water += flight.outcome.overspray.water + flight.outcome.evaporated;
    end.enthalpy += flight.outcome.overspray.enthalpy + flight.around.received.enthalpy;
    EXPECT_NEAR(end.solids / start.solids, 1, 1e-12);
    EXPECT_NEAR(end.water / start.water, 1, 1e-12);
    EXPECT_NEAR(end.enthalpy / start.enthalpy, 1, 1e-11);
    EXPECT_NEAR(flight.around.received.vapour / flight.outcome.evaporated, 1, 1e-12);
    // Every way out was taken, or this says little.
    EXPECT_GT(flight.outcome.walls.solids, 0);
    EXPECT_GT(flight.outcome.overspray.solids, 0);
    EXPECT_GT(flight.outcome.leaving.size(), 10u);
    EXPECT_GT(flight.outcome.hits.size(), 10u);
}

TEST(Flight, through_the_top_is_overspray_and_against_a_wall_is_a_wall_deposit)
{
    for (bool const up : {true, false}) {
        Flight flight;
        flight.settings.liquid = {.density = 1130, .solids_fraction = 0.3};
        flight.around.everywhere = saturated(20);
        flight.droplets = {droplet(flight.settings.liquid, 100e-6, 20, {0.5, 0.5, up ? 0.999 : 0.5},
                                   up ? Vec3{0, 0, 10} : Vec3{20, 0, 0})};
        flight.droplets[0].position.x = up ? 0.5 : 0.999;
        double const solids = flight.droplets[0].solids();
        flight.step(1e-3);
        EXPECT_TRUE(flight.droplets.empty());
        EXPECT_EQ(flight.outcome.overspray.solids, up ? solids : 0);
        EXPECT_EQ(flight.outcome.walls.solids, up ? 0 : solids);
    }
}

TEST(Flight, ends_at_a_body_that_is_thinner_than_a_hop)
{
    // A plate of 1 mm, which droplets at 10 m/s pass in less than a hop.
    Flight flight;
    flight.settings.longest_hop = 0.02;
    flight.settings.gravity = {};
    flight.settings.liquid = {.density = 1100, .solids_fraction = 0.3};
    flight.around.everywhere = saturated(25);
    flight.chamber = geometry::with_bodies(
        flight.chamber, {geometry::Region("plate", geometry::Box{{0.2, 0.2, 0.5}, {0.8, 0.8, 0.501}})});
    flight.droplets = {droplet(flight.settings.liquid, 1e-3, 25, {0.5, 0.5, 0.49}, {0, 0, 10}),
                       droplet(flight.settings.liquid, 1e-3, 25, {0.1, 0.5, 0.49}, {0, 0, 10})};
    flight.step(0.005);
    ASSERT_EQ(flight.droplets.size(), 1u) << "one passes beside it";
    EXPECT_EQ(flight.droplets[0].position.x, 0.1);
    EXPECT_GT(flight.droplets[0].position.z, 0.53);
    EXPECT_GT(flight.outcome.walls.solids, 0);
    EXPECT_EQ(flight.outcome.overspray.solids, 0);
}

TEST(Flight, through_a_bed_ends_after_the_mean_free_path_of_a_filter)
{
    // Share that gets through z: exp(-z / lambda), lambda = 2 d_p / (3 phi eta (1 + d_d / d_p)^2), physics.md 4.5.
    double const phi = 0.1, d_p = 0.6e-3, d_d = 100e-6, speed = 30;
    Flight flight;
    flight.settings.liquid = {.density = 1e6, .solids_density = 1e6, .solids_fraction = 0.3};  // too heavy to slow down
    flight.settings.capture = law::capture::Simple{};
    flight.settings.longest_hop = 3e-4;
    flight.around.everywhere = saturated(20);
    flight.around.everywhere.solids_fraction = phi;
    double const number = phi / (math::pi / 6 * std::pow(d_p, 3));
    flight.around.bed = {{4, 0.2 * number, {}, d_p}, {9, 0.8 * number, {}, d_p}};
    int const parcels = 20000;
    for (std::uint64_t id = 0; id < parcels; ++id) {
        flight.droplets.push_back(droplet(flight.settings.liquid, d_d, 20, {0.5, 0.5, 0.5}, {0, 0, speed}));
        flight.droplets.back().id = id;
    }
    double const depth = 4e-3;
    flight.step(depth / speed);
    double const stokes = 1e6 * d_d * d_d * speed / (18 * flight.around.everywhere.viscosity * d_p);
    double const efficiency = std::pow(stokes / (stokes + 0.25), 2);
    double const path = 2 * d_p / (3 * phi * efficiency * std::pow(1 + d_d / d_p, 2));
    double const through = std::exp(-depth / path), deviation = std::sqrt(through * (1 - through) / parcels);
    EXPECT_NEAR(static_cast<double>(flight.droplets.size()) / parcels, through, 4 * deviation);
    // Granules are hit in proportion to their number, at the speed of the droplet.
    double second = 0;
    for (auto const& hit : flight.outcome.hits) {
        second += hit.row == 9;
        EXPECT_NEAR(hit.speed, speed, 0.01 * speed);
        EXPECT_TRUE(hit.row == 4 || hit.row == 9);
    }
    double const hits = static_cast<double>(flight.outcome.hits.size());
    EXPECT_NEAR(second / hits, 0.8, 4 * std::sqrt(0.16 / hits));
}

TEST(Flight, where_there_are_no_granules_captures_nothing)
{
    auto flight = crowd(0);
    flight.around.everywhere.solids_fraction = 1e-3;  // smoothed voidage, but nobody near
    flight.step(1e-3);
    EXPECT_TRUE(flight.outcome.hits.empty());
}

TEST(Flight, across_the_border_of_a_rank_loses_no_time)
{
    // One rank for all against two that hand the droplet over between steps: same place, speed and age.
    auto const end = [](bool parted) {
        Flight here;
        here.settings.liquid = {.density = 1130, .solids_fraction = 0.3};
        here.settings.gravity = {0, 0, -9.81};
        here.settings.longest_hop = 0.001;
        here.around.everywhere = saturated(20);
        here.droplets = {droplet(here.settings.liquid, 80e-6, 20, {0.4981, 0.5, 0.5}, {10, 0, 0})};
        Flight there = here;
        there.droplets.clear();
        if (parted) here.around.border = 0.5;
        for (int n = 0; n < 4; ++n) {
            here.step(7e-4), there.step(7e-4);
            for (auto const& d : here.outcome.leaving) there.droplets.push_back(d);
            here.outcome.leaving.clear();
        }
        EXPECT_EQ(here.droplets.size() + there.droplets.size(), 1u);
        EXPECT_EQ(there.droplets.size(), parted ? 1u : 0u);
        return parted ? there.droplets.at(0) : here.droplets.at(0);
    };
    auto const whole = end(false), parted = end(true);
    EXPECT_NEAR(parted.age, whole.age, 1e-12);
    EXPECT_NEAR(parted.position.x, whole.position.x, 1e-4);
    EXPECT_NEAR(parted.velocity.x, whole.velocity.x, 1e-2);
}

//! Light droplets in homogeneous turbulence of sigma = 1 m/s and T = 0.1 s that do not dry.
Flight turbulent_flight(int number)
{
    Flight flight;
    flight.chamber.size = {200, 200, 200};
    flight.settings.liquid = water();
    flight.settings.longest_hop = 1;
    law::dispersion::Langevin const law;
    flight.settings.dispersion = law;
    flight.around.everywhere = saturated(20);
    flight.around.everywhere.turbulent_energy = 1.5;
    flight.around.everywhere.dissipation = law.time_ratio * 1.5 / 0.1;
    for (int n = 0; n < number; ++n) {
        flight.droplets.push_back(droplet(flight.settings.liquid, 5e-6, 20, {100, 100, 100}));
        flight.droplets.back().id = static_cast<std::uint64_t>(n);
    }
    return flight;
}

TEST(Droplets, are_spread_by_turbulence_as_taylor_says)
{
    // 2 sigma^2 T (t - T (1 - exp(-t/T))) = 0.18 m2 after 1 s; 6000 components leave 1.8 %.
    auto flight = turbulent_flight(2000);
    for (int step = 0; step < 100; ++step) flight.step(0.01);
    ASSERT_EQ(flight.droplets.size(), 2000u);
    double spread = 0;
    Vec3 mean;
    for (auto const& one : flight.droplets) {
        Vec3 const way = one.position - Vec3{100, 100, 100};
        spread += math::norm2(way) / 3 / 2000;
        mean += way / 2000.0;
    }
    EXPECT_NEAR(spread, 0.18, 0.05 * 0.18);
    EXPECT_LT(math::norm(mean), 4 * std::sqrt(3 * 0.18 / 2000));
}

TEST(Droplets, are_spread_the_same_in_any_order)
{
    auto one = turbulent_flight(20), other = turbulent_flight(20);
    std::reverse(other.droplets.begin(), other.droplets.end());
    for (int step = 0; step < 5; ++step) one.step(0.01), other.step(0.01);
    for (std::size_t n = 0; n < 20; ++n) EXPECT_EQ(one.droplets[n].position, other.droplets[19 - n].position);
    EXPECT_NE(one.droplets[0].position, one.droplets[1].position);
}

Liquid urea()
{
    Liquid liquid;
    liquid.density = 1220, liquid.solids_density = 1335, liquid.solids_fraction = 1;
    liquid.solids_heat_capacity = 1500;
    liquid.melting_point = 132.7 + zero_celsius;
    liquid.fusion_heat = 224e3;
    return liquid;
}

// In still air the droplet loses 2 pi d k (T - T_gas): held at the melting point until the heat of fusion has gone.
TEST(MoltenDroplet, keeps_its_melting_point_while_it_solidifies)
{
    FlightSettings settings;
    settings.liquid = urea();
    auto const air = gas(30, 0.005);
    double const diameter = 60e-6;
    Droplet drop = droplet(settings.liquid, diameter, 140, {}, {}, 1000);
    drop.molten = drop.solute;
    double const before = drop.enthalpy(settings.liquid);
    double given = 0, mushy = 0, last = drop.temperature;
    double const dt = 1e-5;
    for (int n = 0; n < 200000; ++n) {
        auto const out = evaporate(drop, settings, air, 0, dt);
        given += out.enthalpy;
        EXPECT_EQ(out.vapour, 0);
        ASSERT_LE(drop.temperature, last);
        last = drop.temperature;
        if (drop.temperature == settings.liquid.melting_point && drop.molten > 0) mushy += dt;
        if (drop.molten == 0 && drop.temperature < air.temperature + 0.01) break;
    }
    EXPECT_NEAR(given, before - drop.enthalpy(settings.liquid), 1e-12 * before);
    EXPECT_TRUE(drop.dry(settings.liquid, 0.01));
    EXPECT_NEAR(drop.temperature, air.temperature, 0.02);
    double const film = settings.liquid.melting_point + (air.temperature - settings.liquid.melting_point) / 3;
    double const loss = 2 * math::pi * diameter * material::conductivity(film) * (132.7 - 30);
    EXPECT_NEAR(mushy, drop.solute * 224e3 / loss, 0.01 * mushy);
}

TEST(MoltenDroplet, melts_again_in_gas_that_is_hotter)
{
    FlightSettings settings;
    settings.liquid = urea();
    Droplet drop = droplet(settings.liquid, 60e-6, 30, {});
    EXPECT_TRUE(drop.dry(settings.liquid, 0.01));
    auto const air = gas(200, 0.005);
    for (int n = 0; n < 100000; ++n) evaporate(drop, settings, air, 0, 1e-5);
    EXPECT_EQ(drop.molten, drop.solute);
    EXPECT_NEAR(drop.temperature, air.temperature, 0.01);
    EXPECT_FALSE(drop.dry(settings.liquid, 0.01));
}

TEST(MoltenDroplet, holds_back_what_it_has_to_give_until_it_is_solid)
{
    auto const liquid = urea();
    Droplet drop = droplet(liquid, 60e-6, 140, {}, {}, 10);
    drop.molten = drop.solute;
    EXPECT_NEAR(drop.heat_until_solid(liquid), 10 * drop.solute * (1500 * 7.3 + 224e3), 1e-15);
    EXPECT_NEAR(drop.enthalpy(liquid) - drop.heat_until_solid(liquid), 10 * drop.solute * 1500 * 132.7, 1e-15);
}
}
