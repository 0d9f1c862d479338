// Vapour and heat in the gas: closed balances, bounds, equilibrium with what evaporates.
#include "chamber_with_gas.hpp"

#include "granum/base/error.hpp"
#include "granum/material/moist_air.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;
using gas::ChamberWithGas;
using geometry::Chamber;

TEST(Heat, hot_moist_inlet_displaces_cold_dry_gas_and_the_ledgers_close)
{
    gas::Settings settings;
    settings.inlets = {gas::Inlet{.mass_flow = 0.04, .temperature = 353.15, .vapour_fraction = 0.008}};
    ChamberWithGas run(gas::laboratory_chamber(), {10, 10, 24}, {}, settings);
    double vapour = run.sum(run.state.vapour), heat = run.sum(run.state.enthalpy), mass = run.sum(run.state.mass);
    double heat_passed = 0, vapour_passed = 0;
    for (int step = 0; step < 1000; ++step) {
        auto const balance = run.step(4e-3);
        mass += balance.mass_in - balance.mass_out;
        vapour += balance.vapour_in - balance.vapour_out;
        heat += balance.enthalpy_in - balance.enthalpy_out;
        heat_passed += balance.enthalpy_in;
        vapour_passed += balance.vapour_in;
        for (double t : run.state.temperature) {
            ASSERT_GT(t, 293.15 - 1e-6);
            ASSERT_LT(t, 353.15 + 1e-6);
        }
    }
    EXPECT_NEAR(run.sum(run.state.mass), mass, 1e-12 * 0.16);
    EXPECT_NEAR(run.sum(run.state.vapour), vapour, 1e-12 * vapour_passed);
    EXPECT_NEAR(run.sum(run.state.enthalpy), heat, 1e-12 * heat_passed);
    // 4 s pass about three chamber volumes.
    EXPECT_GT(run.at(run.state.temperature, 5, 5, 20), 345);
    EXPECT_NEAR(run.at(run.state.temperature, 5, 5, 2), 353.15, 0.01);
    EXPECT_NEAR(run.at(run.state.vapour_fraction, 5, 5, 2), 0.008, 1e-6);
    // Stored mass follows the equation of state.
    double const hot = run.at(run.state.temperature, 5, 5, 10), w = run.at(run.state.vapour_fraction, 5, 5, 10);
    EXPECT_NEAR(run.at(run.state.density, 5, 5, 10) / material::density(101325, hot, w), 1, 1e-4);
}

TEST(Heat, vapour_that_diffuses_takes_its_enthalpy_along)
{
    // Closed box of one temperature with a step in humidity: it must stay at that temperature.
    gas::Settings settings{.outlets = {}, .gravity = {}};
    ChamberWithGas run(Chamber{.size = {0.04, 0.01, 0.01}}, {16, 2, 2}, {}, settings, 333.15, 0.01);
    grid::for_each_cell(run.grid, [&](int i, int, int, grid::Index c) {
        double const w = i < 8 ? 0.01 : 0.03;
        double const mass = run.grid.open_volume[c] * material::density(101325, 333.15, w);
        run.state.mass[c] = mass;
        run.state.vapour[c] = w * mass;
        run.state.enthalpy[c] = material::enthalpy(333.15, w) * mass;
        run.state.vapour_fraction[c] = w;
        run.state.density[c] = mass / run.grid.open_volume[c];
    });
    double const vapour = run.sum(run.state.vapour), heat = run.sum(run.state.enthalpy);
    double work = 0;  // of the pressure that the box comes to
    for (int step = 0; step < 200; ++step) work += run.step(0.01).pressure_work;
    for (int i = 0; i < 16; ++i) EXPECT_NEAR(run.at(run.state.temperature, i, 1, 1), 333.15, 0.01);
    double const spread = run.at(run.state.vapour_fraction, 15, 0, 0) - run.at(run.state.vapour_fraction, 0, 0, 0);
    EXPECT_LT(spread, 0.019);
    EXPECT_GT(spread, 0.001);
    EXPECT_NEAR(run.sum(run.state.vapour), vapour, 1e-12 * vapour);
    EXPECT_NEAR(run.sum(run.state.enthalpy), heat + work, 1e-12 * heat);
}

TEST(Heat, a_step_in_humidity_decays_as_the_error_function)
{
    // Half-way value stays, and a cell at distance x follows w = mean + step/2 erf(x / (2 sqrt(D t))).
    gas::Settings settings{.outlets = {}, .gravity = {}, .density = 1.1};
    ChamberWithGas run(Chamber{.size = {0.08, 0.01, 0.01}}, {64, 1, 1}, {false, true, true}, settings, 298.15, 0);
    grid::for_each_cell(run.grid, [&](int i, int, int, grid::Index c) {
        double const w = i < 32 ? 0 : 0.01;
        run.state.vapour[c] = w * run.state.mass[c];
        run.state.enthalpy[c] = material::enthalpy(298.15, w) * run.state.mass[c];
        run.state.vapour_fraction[c] = w;
    });
    double const time = 2, diffusivity = 2.5e-5;
    for (int step = 0; step < 400; ++step) run.step(time / 400);
    for (int i = 20; i < 44; i += 3) {
        double const x = (i + 0.5 - 32) * 0.08 / 64;
        EXPECT_NEAR(run.at(run.state.vapour_fraction, i, 0, 0),
                    0.005 * (1 + std::erf(x / (2 * std::sqrt(diffusivity * time)))), 5e-5);
    }
}

TEST(Heat, evaporation_into_flowing_gas_gives_the_balance_humidity)
{
    gas::Settings settings;
    double const flow = 0.04, water = 2e-4;
    settings.inlets = {gas::Inlet{.mass_flow = flow, .temperature = 353.15, .vapour_fraction = 0.008}};
    ChamberWithGas run(Chamber{.size = {0.2, 0.2, 0.5}}, {4, 4, 10}, {}, settings, 340, 0.01);
    int cells = 0;
    grid::for_each_cell(run.grid, [&](int, int, int k, grid::Index c) { cells += k == 3 && run.grid.open(c); });
    grid::for_each_cell(run.grid, [&](int, int, int k, grid::Index c) {
        if (k != 3 || !run.grid.open(c)) return;
        run.sources.mass[c] = run.sources.vapour[c] = water / cells;
        run.sources.enthalpy[c] =
            water / cells * material::water_enthalpy(300);  // water evaporates at the gas's expense
    });
    double const dt = 5e-3;
    for (int step = 0; step < 1000; ++step) run.step(dt);
    double mass_out = 0, vapour_out = 0, enthalpy_out = 0, time = 0;
    for (int step = 0; step < 500; ++step) {
        auto const balance = run.step(dt);
        mass_out += balance.mass_out, vapour_out += balance.vapour_out, enthalpy_out += balance.enthalpy_out;
        time += dt;
    }
    double const out = flow + water, vapour = flow * 0.008 + water, w = vapour / out;
    EXPECT_NEAR(mass_out / time / out, 1, 1e-6);
    EXPECT_NEAR(vapour_out / time / vapour, 1, 1e-6);
    double const enthalpy = flow * material::enthalpy(353.15, 0.008) + water * material::water_enthalpy(300);
    EXPECT_NEAR(enthalpy_out / time / enthalpy, 1, 1e-6);
    EXPECT_NEAR(run.at(run.state.temperature, 2, 2, 8), material::temperature(enthalpy / out, w), 0.1);
    EXPECT_NEAR(run.at(run.state.vapour_fraction, 2, 2, 8), w, 0.01 * w);
}

TEST(Heat, granules_get_exactly_what_the_gas_gives)
{
    gas::Settings settings{.outlets = {}, .gravity = {}};
    ChamberWithGas run(Chamber{.size = {0.04, 0.04, 0.04}}, {4, 4, 4}, {}, settings, 350, 0.01);
    grid::for_each_cell(run.grid, [&](int i, int, int, grid::Index c) {
        run.sources.heat_coefficient[c] = 0.5 * (1 + i);  // stiff: a cell's air holds 1.1e-3 J/K
        run.sources.heat_value[c] = run.sources.heat_coefficient[c] * 30;
    });
    double const before = run.sum(run.state.enthalpy);
    double const work = run.step(0.01).pressure_work;  // the box cools: its pressure falls
    double given = 0;
    grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) {
        double const t = run.solver.exchanged_temperature()[c] - 273.15;
        given -= 0.01 * (run.sources.heat_value[c] - run.sources.heat_coefficient[c] * t);
        EXPECT_GT(t, 30);
        EXPECT_LT(t, 60);
    });
    EXPECT_GT(given, 0);
    EXPECT_NEAR(run.sum(run.state.enthalpy), before - given + work, 1e-12 * before);
}

TEST(Heat, a_moving_bed_keeps_the_gas_it_pushes_around)
{
    // Voidage that changes in time drives gas out through the top, and back in as ambient air.
    gas::Settings settings;
    settings.inlets = {gas::Inlet{.mass_flow = 0.01, .temperature = 300}};
    ChamberWithGas run(gas::laboratory_chamber(), {8, 8, 20}, {}, settings, 300, 0.01);
    double mass = run.sum(run.state.mass), vapour = run.sum(run.state.vapour), drawn = 0;
    for (int step = 0; step < 200; ++step) {
        grid::for_each_cell(run.grid, [&](int i, int j, int k, grid::Index c) {
            run.voidage[c] =
                k < 10 ? 0.7 + 0.2 * std::sin(0.3 * step + 0.5 * i + 0.2 * j) * std::min(1.0, step / 20.0) : 1;
        });
        auto const balance = run.step(2e-3);
        mass += balance.mass_in - balance.mass_out;
        vapour += balance.vapour_in - balance.vapour_out;
        drawn = std::min(drawn, balance.mass_out);
    }
    EXPECT_NEAR(run.sum(run.state.mass), mass, 1e-12 * 0.05);
    EXPECT_NEAR(run.sum(run.state.vapour), vapour, 1e-12 * 5e-4);
    EXPECT_NEAR(run.at(run.state.density, 4, 4, 5) / material::density(101325, run.at(run.state.temperature, 4, 4, 5),
                                                                       run.at(run.state.vapour_fraction, 4, 4, 5)),
                1, 1e-4);  // one step's change of temperature and humidity behind
}

TEST(Heat, the_filter_keeps_cold_air_from_falling_in)
{
    gas::Settings settings;
    settings.inlets = {gas::Inlet{.mass_flow = 0.03, .temperature = 353.15}};
    ChamberWithGas run(gas::laboratory_chamber(), {8, 8, 20}, {}, settings, 353.15, 0);
    for (int step = 0; step < 300; ++step) run.step(5e-3);
    for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) EXPECT_GE(run.at(run.state.mass_flux[2], i, j, 20), 0);
    EXPECT_NEAR(run.at(run.state.temperature, 4, 4, 19), 353.15, 1e-6);
    // Its own pressure drop does not show: the top layer is at the outlet's pressure.
    double mean = 0, area = 0;
    for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) {
            mean += run.at(run.state.pressure, i, j, 19) * run.at(run.grid.open_area[2], i, j, 20);
            area += run.at(run.grid.open_area[2], i, j, 20);
        }
    EXPECT_NEAR(mean / area, 0, 0.5);
}

TEST(Heat, a_number_that_is_not_finite_is_named_with_its_place)
{
    gas::Settings settings{.outlets = {}, .gravity = {}};
    ChamberWithGas run(Chamber{.size = {0.04, 0.04, 0.04}}, {4, 4, 4}, {}, settings, 350, 0.01);
    run.sources.enthalpy[run.grid.at(1, 2, 3)] = std::nan("");
    try {
        run.step(1e-3);
        FAIL() << "the step went on";
    } catch (base::NumericsError const& error) {
        EXPECT_NE(std::string(error.what()).find("temperature"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("in cell ("), std::string::npos) << error.what();
    }
}

TEST(Heat, a_source_in_a_closed_cell_is_refused)
{
    gas::Settings settings;
    settings.inlets = {gas::Inlet{.mass_flow = 0.03}};
    ChamberWithGas run(gas::laboratory_chamber(), {8, 8, 20}, {}, settings);
    run.sources.mass[run.grid.at(0, 0, 0)] = 1e-9;
    EXPECT_THROW(run.step(1e-3), base::NumericsError);
}
