// What the whole step promises: goals met exactly, a bed that starts as wet as it will stay, nothing unaccounted for.
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::sim;

TEST(Ledger, is_what_was_there_plus_what_came_less_what_went)
{
    Ledger ledger{.name = "water", .unit = "kg", .bar = 1e-9, .start = 2, .in = 5, .out = 3, .now = 4};
    EXPECT_EQ(ledger.residual(), 0);
    EXPECT_EQ(ledger.relative_error(), 0);
    ledger.now = 4 + 4e-9;  // of 8 kg that passed
    EXPECT_NEAR(ledger.relative_error(), 0.5e-9, 1e-16);
    EXPECT_FALSE(ledger.broken());
    ledger.now = 4 - 8.1e-8;
    EXPECT_TRUE(ledger.broken());
    EXPECT_LT(ledger.residual(), 0);
}

TEST(Ledger, without_flows_is_measured_against_its_reference)
{
    Ledger ledger{.start = 1, .now = 1 + 1e-9, .reference = 0.1};
    EXPECT_NEAR(ledger.relative_error(), 1e-8, 1e-14);
    EXPECT_EQ(Ledger{}.relative_error(), 0);
}

//! Two granules that float in a box without gas and without weight.
std::string const two_granules = R"(
gravity = ["0 m/s2", "0 m/s2", "0 m/s2"]
[apparatus]
shape = "box"
size = ["100 mm", "100 mm", "100 mm"]
[granules]
diameter = "2 mm"
density = "1000 kg/m3"
[contact]
youngs_modulus = "10 MPa"
[time]
duration = "1 s"
[[granule]]
position = ["50 mm", "50 mm", "10 mm"]
velocity = ["0 m/s", "0 m/s", "0.1 m/s"]
[[granule]]
position = ["50 mm", "50 mm", "60 mm"]
diameter = "4 mm"
)";

TEST(Simulation, of_granules_alone_reads_height_and_energy_of_the_bed)
{
    auto const simulation = scene::simulation_of(two_granules);
    auto const readings = simulation->readings();
    // Masses 1 to 8: the mean height of the mass is (10 + 8 * 60) / 9 mm, the bed's height twice that.
    EXPECT_NEAR(readings.height, 2 * 0.490 / 9, 1e-12);
    EXPECT_NEAR(readings.highest, 0.060, 1e-12);
    EXPECT_NEAR(readings.kinetic_energy, 0.5 * 1000 * math::pi / 6 * 8e-9 * 0.01, 1e-18);
    EXPECT_EQ(readings.bed_moisture, 0);
    EXPECT_FALSE(simulation->has_gas());
    EXPECT_TRUE(simulation->take_events().empty());
}

TEST(Simulation, ends_its_steps_on_the_goal_and_makes_them_equal)
{
    auto const simulation = scene::simulation_of(two_granules);
    double const goal = 100.37 * simulation->granule_dt();
    std::vector<double> steps;
    while (simulation->time() < goal * (1 - 1e-12)) {
        double const before = simulation->time();
        simulation->step(goal - before);
        steps.push_back(simulation->time() - before);
    }
    EXPECT_NEAR(simulation->time(), goal, 1e-12 * goal);
    EXPECT_EQ(simulation->steps(), static_cast<long>(steps.size()));
    for (double const step : steps) EXPECT_NEAR(step, steps.front(), 1e-9 * step);
    // The free granule is where its speed has brought it.
    for (std::size_t row = 0; row < simulation->granules().owned; ++row)
        if (simulation->granules().id[row] == 0) {
            EXPECT_NEAR(simulation->granules().position[row].z, 0.010 + 0.1 * goal, 1e-12);
        }
}

//! The recipe of the lab example with few parcels and coarse cells, and a wide cone that meets the wall, too.
std::string const spray_bed = R"(
[apparatus]
shape = "revolution"
profile = [["0 mm", "180 mm"], ["450 mm", "250 mm"], ["1000 mm", "250 mm"]]
[gas]
dry_mass_flow = "0.04 kg/s"
temperature = "80 degC"
humidity = "8 g/kg"
cells = [8, 8, 32]
[granules]
diameter = "0.6 mm"
density = "1445 kg/m3"
mass = "1 kg"
parcels = 1500
start = "loose"
[contact]
youngs_modulus = "10 MPa"
[spray]
liquid = "sodium-benzoate-30"
rate = "1.2 kg/h"
solids_fraction = "30 %"
[[nozzle]]
position = ["0 mm", "0 mm", "300 mm"]
direction = [0, 0, -1]
half_angle = "60 deg"
air = "1.2 kg/h"
[time]
duration = "1 s"
)";

//! 90 degC hot granules in a column of gas of 20 degC; `granules` and `start` are more keys of their sections.
std::string hot_bed(int number, double height, double speed, std::string const& granules, std::string const& start)
{
    return fmt::format(R"(
[apparatus]
shape = "box"
size = ["8 mm", "8 mm", "{1} mm"]
[gas]
cells = [4, 4, {2}]
velocity = "{3} m/s"
temperature = "20 degC"
humidity = 0
[granules]
diameter = "1 mm"
density = "2500 kg/m3"
heat_capacity = "840 J/kg/K"
number = {0}
{4}
[contact]
youngs_modulus = "1 MPa"
[start]
quasi_steady = false
bed_temperature = "90 degC"
{5}
[time]
duration = "1 s"
)",
                       number, height, static_cast<int>(height / 2), speed, granules, start);
}

TEST(HotBed, has_hot_gas_between_its_granules_and_does_not_burst)
{
    auto const simulation = scene::simulation_of(hot_bed(500, 24, 0.2, "start = \"settled\"", ""));
    auto const& grid = simulation->grid();
    auto const& gas = simulation->gas();
    // Solids to gas by heat capacity as in any bed: some thousand to one; far above the bed there are none.
    EXPECT_NEAR(gas.temperature[grid.at(1, 1, 1)], 363.15, 0.2);
    EXPECT_NEAR(gas.temperature[grid.at(1, 1, 11)], 293.15, 1e-9);
    EXPECT_NEAR(gas.density[grid.at(1, 1, 1)], 101325 / (287.05 * 363.15), 1e-3);
    double fastest = 0;
    for (int k = 0; k < 20; ++k) {
        simulation->step(1e-4);
        for (int layer = 0; layer < 12; ++layer)
            fastest = std::max(fastest, std::abs(gas.velocity[2][grid.at(1, 1, layer)]));
    }
    EXPECT_LT(fastest, 1.5);  // 0.2 m/s between granules of 60 % by volume, a quarter wider as it warms

    // Said otherwise, gas is as cold as the case says.
    auto const cold =
        scene::simulation_of(hot_bed(500, 24, 0.2, "start = \"settled\"", "gas_temperature = \"20 degC\""));
    EXPECT_EQ(cold->gas().temperature[grid.at(1, 1, 1)], 293.15);
}

TEST(HotBed, that_is_deep_does_not_swing_as_it_settles)
{
    // In long steps, in which granules and gas come to one temperature, and slow gas.
    auto const simulation =
        scene::simulation_of(hot_bed(1500, 60, 0.05, "", "settling = \"0.5 s\"") + "gas_step = \"1.5 ms\"\n");
    double last = simulation->readings().bed_temperature;
    for (double goal = 0.02; goal < 0.3; goal += 0.02) {
        while (simulation->time() < goal * (1 - 1e-12)) simulation->step(goal - simulation->time());
        double const bed = simulation->readings().bed_temperature;
        EXPECT_LT(bed, last) << goal;
        EXPECT_GT(bed, 293.15) << goal;
        last = bed;
    }
    EXPECT_LT(last, 363.15 - 15);
}

TEST(HotBed, settles_to_the_temperature_at_which_the_gas_holds_it)
{
    auto const text = hot_bed(500, 24, 0.2, "", "settling = \"0.5 s\"");
    // 0.55 J/K in a gas of 0.0155 W/K: by itself this bed would take 35 s.
    double const capacity = 500 * 2500 * math::pi / 6 * 1e-9 * 840;
    auto const simulation = scene::simulation_of(text);
    auto const run_to = [&](double goal) {
        while (simulation->time() < goal * (1 - 1e-12)) simulation->step(goal - simulation->time());
    };
    run_to(0.02);
    EXPECT_LT(simulation->settling().end, 0);
    EXPECT_GT(simulation->readings().bed_temperature, 293.15 + 20);
    run_to(0.52);
    EXPECT_NEAR(simulation->settling().end, 0.5, 1e-3);
    double const bed = simulation->readings().bed_temperature;
    EXPECT_NEAR(bed, 293.15, 0.5);
    EXPECT_NEAR(simulation->heat().settling / capacity, -70, 1);
    EXPECT_LT(simulation->ledgers().energy.relative_error(), 1e-10);
    // From there on all of its heat capacity counts.
    run_to(0.6);
    EXPECT_NEAR(simulation->readings().bed_temperature, bed, 0.1 / 35);
}

TEST(SprayedBed, starts_as_wet_as_the_spray_keeps_it)
{
    // Before the first droplets arrive, the deposits of the start must evaporate what the spray will bring.
    for (std::string const law : {"cap", "combined", "boundary-layer"}) {
        auto const simulation = scene::simulation_of(spray_bed + "[drying]\ndeposit = \"" + law + "\"\n");
        EXPECT_GT(simulation->readings().water_on_granules, 0);
        while (simulation->time() < 0.004 * (1 - 1e-12)) simulation->step(0.004 - simulation->time());
        double const sprayed = 1.2 / 3600 * 0.7 * 0.004;
        auto const totals = simulation->totals();
        EXPECT_EQ(totals.hits, 0);
        EXPECT_NEAR(totals.water, sprayed, 0.02 * sprayed);
        EXPECT_NEAR(totals.evaporated, sprayed, 0.15 * sprayed) << law;
    }
}

TEST(SprayedBed, loses_layers_to_collisions_and_accounts_for_the_dust)
{
    auto const run = [](std::string const& abrasion) {
        auto simulation = scene::simulation_of(spray_bed + "[drying]\n" + abrasion);
        while (simulation->time() < 0.04 * (1 - 1e-12)) simulation->step(0.04 - simulation->time());
        return simulation;
    };
    auto const none = run("");
    auto const worn = run("abrasion = \"collision-energy\"\nabrasion_coefficient = \"1e-7 kg/J\"\n");
    auto const gone = run("abrasion = \"collision-energy\"\nabrasion_coefficient = \"1 kg/J\"\n");
    auto const tough =
        run("abrasion = \"collision-energy\"\nabrasion_coefficient = \"1 kg/J\"\nabrasion_threshold = \"1 kJ/kg\"\n");
    auto const layers = [](sim::Simulation& of) {
        double sum = 0;
        for (std::size_t row = 0; row < of.granules().owned; ++row) sum += of.granules().layer_mass[row];
        return sum;
    };
    EXPECT_EQ(none->totals().abraded, 0);
    EXPECT_EQ(tough->totals().abraded, 0);
    EXPECT_GT(worn->totals().abraded, 0);
    EXPECT_LT(layers(*worn), layers(*none));
    EXPECT_LT(layers(*gone), 0.8 * layers(*none));
    for (auto const* one : {&none, &worn, &gone}) {
        EXPECT_LT((*one)->ledgers().solids.relative_error(), 1e-12);
        EXPECT_LT((*one)->ledgers().energy.relative_error(), 1e-12);
    }
    // Deposits are told what their granules met; a bed of 0.6 mm granules collides some hundred times a second.
    double met = 0, time = 0;
    for (auto const& event : none->take_events())
        met += event.weight * event.wet_contacts, time += event.weight * event.drying_time;
    EXPECT_GT(met / time, 10);
    EXPECT_LT(met / time, 1e5);
}

TEST(SprayedBed, accounts_for_all_that_was_sprayed)
{
    auto const simulation = scene::simulation_of(spray_bed);
    double const wet = simulation->readings().water_on_granules;
    double solids = 0, initial = 0;
    long events = 0;
    for (double const goal : {0.01, 0.03, 0.1}) {
        while (simulation->time() < goal * (1 - 1e-12)) simulation->step(goal - simulation->time());
        auto const t = simulation->totals();
        EXPECT_NEAR(t.solids, 1.2 / 3600 * 0.3 * goal, 1e-3 * t.solids);
        EXPECT_NEAR(t.deposited + t.walls + t.overspray + t.in_flight, t.solids, 1e-12 * t.solids);
        double in_flight = 0;
        for (auto const& droplet : simulation->droplets()) in_flight += droplet.liquid_water();
        EXPECT_LE(t.evaporated + simulation->readings().water_on_granules + in_flight, t.water + wet);
        for (auto const& event : simulation->take_events()) {
            initial += event.initial * event.solids, solids += (1 - event.initial) * event.solids;
            ++events;
        }
    }
    auto const t = simulation->totals();
    EXPECT_GT(t.deposited, 0);
    EXPECT_GT(t.hits, 100);
    EXPECT_GT(events, 100);
    EXPECT_GT(initial, 0);
    EXPECT_LE(solids, t.deposited * (1 + 1e-12));
    double layer = 0;
    auto const& granules = simulation->granules();
    for (std::size_t row = 0; row < granules.owned; ++row) layer += granules.layer_mass[row];
    EXPECT_NEAR(layer, solids + initial, 1e-12 * layer);
    EXPECT_LT(simulation->ledgers().solids.relative_error(), 1e-9);
    EXPECT_LT(simulation->ledgers().water.relative_error(), 1e-9);
    EXPECT_LT(simulation->ledgers().energy.relative_error(), 1e-6);
    EXPECT_LT(simulation->ledgers().momentum, 1e-12);
}

TEST(SprayedBed, accounts_for_what_splashes_and_for_dust_that_does_not_stick)
{
    // Droplets that all splash, and a suspension whose droplets lock before they reach the bed.
    for (bool const splash : {true, false}) {
        auto text = spray_bed;
        auto const at = text.find("[spray]\n") + 8;
        text.insert(at, splash ? "splash_limit = 0.1\n" : "solubility = 0\nlocking = 0.3\nsplash_limit = 1e9\n");
        auto const simulation = scene::simulation_of(text);
        while (simulation->time() < 0.08 * (1 - 1e-12)) simulation->step(0.08 - simulation->time());
        auto const t = simulation->totals();
        EXPECT_EQ(t.splashed > 0, splash);
        EXPECT_GT(t.deposited, 0);
        if (!splash) {
            EXPECT_GT(t.rebounds, 10);
        }
        EXPECT_NEAR(t.deposited + t.walls + t.overspray + t.in_flight, t.solids, 1e-12 * t.solids);
        double shares = 0, dry = 0, events = 0;
        for (auto const& event : simulation->take_events())
            if (event.initial == 0) shares += event.splashed, dry += event.dry, ++events;
        ASSERT_GT(events, 10);
        if (splash) {
            EXPECT_NEAR(shares / events, 0.5, 0.2);  // some are the second droplet of one that has splashed
        }
        EXPECT_LT(dry, splash ? 1 : events + 1);
        EXPECT_LT(simulation->ledgers().solids.relative_error(), 1e-9);
        EXPECT_LT(simulation->ledgers().water.relative_error(), 1e-9);
        EXPECT_LT(simulation->ledgers().energy.relative_error(), 1e-6);
        EXPECT_LT(simulation->ledgers().momentum, 1e-12);
    }
}
}
