// Turbulence in cells: decay, shear, walls, granules, ranks.
#include "chamber_with_gas.hpp"

#include "granum/grid/halo.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;
using gas::ChamberWithGas;
namespace turbulence = law::turbulence;

namespace
{
gas::Settings with_model(char const* name)
{
    gas::Settings settings{.outlets = {}, .gravity = {}, .density = 1.2, .viscosity = 1.8e-5};
    settings.turbulence.model = *turbulence::All::make(name);
    return settings;
}
constexpr std::array<bool, 3> periodic{true, true, true};
}

TEST(Turbulence, laminar_gas_holds_nothing_of_it)
{
    ChamberWithGas run({.size = {1, 1, 1}}, {2, 2, 2}, periodic, with_model("laminar"));
    EXPECT_FALSE(run.state.turbulent);
    EXPECT_TRUE(run.state.energy_of_eddies.empty());
    EXPECT_TRUE(run.solver.eddy_viscosity(run.state).empty());
    EXPECT_EQ(run.state.fields().size() + 2,
              ChamberWithGas({.size = {1, 1, 1}}, {2, 2, 2}, periodic, with_model("k-epsilon")).state.fields().size());
}

TEST(Turbulence, of_k_epsilon_decays_by_its_power_law)
{
    // k = k0 (1 + (C2 - 1) e0 t/k0)^(-1/(C2 - 1)): 0.49211 after 1 s with k0 = e0 = 1, also where gas has half the
    // room.
    auto settings = with_model("k-epsilon");
    settings.turbulence.energy = 1;
    settings.turbulence.length = std::pow(0.09, 0.75);
    for (double const voidage : {1.0, 0.5}) {
        ChamberWithGas run({.size = {1, 1, 1}}, {3, 2, 2}, periodic, settings, 293.15, 0, {0.3, 0, 0});
        std::fill(run.voidage.begin(), run.voidage.end(), voidage);
        run.state = run.solver.start(run.voidage, run.grid.make_field(293.15), 0, {0.3, 0, 0});
        for (int step = 0; step < 400; ++step) run.step(1.0 / 400);
        EXPECT_NEAR(run.at(run.state.energy_of_eddies, 1, 1, 1), 0.49211, 0.002);
        EXPECT_NEAR(run.at(run.state.rate_of_eddies, 0, 0, 1), std::pow(1.92, -(1 / 0.92 + 1)), 0.002);
    }
}

TEST(Turbulence, of_k_omega_decays_by_its_power_law)
{
    // omega = w0/(1 + beta w0 t), k = k0 (1 + beta w0 t)^(-beta*/beta), with the constants far from walls.
    auto settings = with_model("k-omega-sst");
    settings.turbulence.energy = 1;
    settings.turbulence.length = 1 / (std::pow(0.09, 0.25) * 10);
    ChamberWithGas run({.size = {1, 1, 1}}, {2, 2, 2}, periodic, settings);
    EXPECT_NEAR(run.at(run.state.rate_of_eddies, 0, 0, 0), 10, 1e-12);
    for (int step = 0; step < 400; ++step) run.step(1.0 / 400);
    EXPECT_NEAR(run.at(run.state.rate_of_eddies, 1, 1, 1), 10 / 1.828, 0.01);
    EXPECT_NEAR(run.at(run.state.energy_of_eddies, 1, 1, 1), std::pow(1.828, -0.09 / 0.0828), 0.001);
}

TEST(Turbulence, stays_positive_at_any_step)
{
    for (char const* name : {"k-epsilon", "k-omega-sst"}) {
        auto settings = with_model(name);
        settings.turbulence.energy = 3;
        settings.turbulence.length = 1e-3;
        ChamberWithGas run({.size = {0.1, 0.1, 0.1}}, {6, 6, 6}, {}, settings, 293.15, 0, {1, 2, 3});
        for (double const dt : {1e-3, 1e-1, 1e-4, 1.0}) {
            run.step(dt);
            grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) {
                EXPECT_GT(run.state.energy_of_eddies[c], 0) << name;
                EXPECT_GT(run.state.rate_of_eddies[c], 0) << name;
                EXPECT_TRUE(std::isfinite(run.state.energy_of_eddies[c]));
                EXPECT_TRUE(std::isfinite(run.state.rate_of_eddies[c]));
            });
        }
    }
}

TEST(Turbulence, large_eddies_of_a_linear_shear_have_the_viscosity_of_the_law)
{
    // Between slipping walls that shear: u = s z. A fixed field, read before it moves.
    auto settings = with_model("smagorinsky");
    settings.walls[0].slip = true;
    ChamberWithGas run({.size = {1, 1, 1}}, {4, 4, 8}, {true, true, false}, settings);
    grid::for_each_cell(
        run.grid, [&](int, int, int k, grid::Index c) { run.state.velocity[0][c] = 5 * run.grid.axes[2].centre(k); });
    grid::refresh(run.grid, {&run.state.velocity[0]});
    auto const eddy = run.solver.eddy_viscosity(run.state);
    double const length = 0.168 * std::cbrt(1.0 / (4 * 4 * 8));
    EXPECT_NEAR(run.at(eddy, 1, 1, 4), length * length * 5, 1e-12);
}

TEST(Turbulence, among_dense_granules_has_no_eddy_viscosity)
{
    auto settings = with_model("k-epsilon");
    settings.turbulence.energy = 1;
    ChamberWithGas run({.size = {1, 1, 1}}, {2, 2, 2}, periodic, settings);
    double const free = run.at(run.solver.eddy_viscosity(run.state), 0, 0, 0);
    EXPECT_NEAR(free, 0.09 / run.at(run.state.rate_of_eddies, 0, 0, 0), 1e-12);
    run.state.voidage.assign(run.grid.size(), 0.825);  // half way: 3/4 - 1/4
    EXPECT_NEAR(run.at(run.solver.eddy_viscosity(run.state), 0, 0, 0), 0.5 * free, 1e-12);
    run.state.voidage.assign(run.grid.size(), 0.6);
    EXPECT_EQ(run.at(run.solver.eddy_viscosity(run.state), 0, 0, 0), 0);
}

TEST(Turbulence, is_damped_by_granules_that_do_not_follow_and_made_by_their_wakes)
{
    // Heavy granules (T_p >> T) take 2 beta k: one implicit step from k = 1 with hardly any dissipation.
    auto settings = with_model("k-epsilon");
    settings.turbulence.energy = 1;
    settings.turbulence.length = 1e6;
    settings.turbulence.granules = {.on = true, .wake = 0, .lagrangian = 1e-15, .rate = 1.5, .solids_density = 2000};
    double const dt = 0.01, voidage = 0.98, beta = 3, volume = 1.0 / 8;
    double slip = 0;
    auto const after = [&] {
        ChamberWithGas run({.size = {1, 1, 1}}, {2, 2, 2}, periodic, settings);
        std::fill(run.voidage.begin(), run.voidage.end(), voidage);
        run.state = run.solver.start(run.voidage, run.grid.make_field(293.15), 0, {});
        double const relaxation = 2000 * 0.02 * volume / beta;
        for (grid::Index c = 0; c < run.grid.size(); ++c) {
            run.sources.drag_coefficient[c] = beta / (1 + dt / relaxation);
            run.sources.drag_momentum[0][c] = run.sources.drag_coefficient[c] * 2;  // granules at 2 m/s, gas at rest
        }
        run.step(dt);
        slip = 2 - run.at(run.state.velocity[0], 0, 0, 0);
        return run.at(run.state.energy_of_eddies, 0, 0, 0);
    };
    double const mass = 1.2 * voidage * volume;
    EXPECT_NEAR(after(), 1 / (1 + dt * 2 * beta / mass), 1e-6);
    settings.turbulence.granules.wake = 0.1;
    double const made = after(), gain = dt * 0.1 * beta * slip * slip / mass;
    EXPECT_GT(gain, 0.05);
    EXPECT_NEAR(made, (1 + gain) / (1 + dt * 2 * beta / mass), 1e-6);
}

TEST(Turbulence, mixes_heat_and_tracer_by_its_prandtl_and_schmidt_numbers)
{
    // Waves of 0.1 m die away with exp(-(D + nu_t/Sc) (2 pi/L)^2 t); the eddies hardly change within 0.03 s.
    auto settings = with_model("k-epsilon");
    settings.turbulence.energy = 0.01;
    settings.turbulence.length = 0.1;
    settings.turbulence.prandtl = 0.5;
    settings.turbulence.schmidt = 1.5;
    settings.conductivity = 1.2 * 1006 * 1e-4;
    settings.tracer = gas::Tracer{2e-4, {}};
    int const cells = 32;
    double const length = 0.1, wave = 2 * math::pi / length, time = 0.03;
    ChamberWithGas run({.size = {length, 0.01, 0.01}}, {cells, 1, 1}, periodic, settings);
    grid::for_each_cell(run.grid, [&](int i, int, int, grid::Index c) {
        double const s = std::sin(wave * run.grid.axes[0].centre(i));
        run.state.temperature[c] = 293.15 + s;
        run.state.enthalpy[c] = run.state.mass[c] * material::enthalpy(293.15 + s, 0);
        run.state.tracer_fraction[c] = 0.5 + 0.1 * s;
        run.state.tracer[c] = run.state.mass[c] * run.state.tracer_fraction[c];
    });
    grid::refresh(run.grid,
                  {&run.state.temperature, &run.state.enthalpy, &run.state.tracer, &run.state.tracer_fraction});
    run.state.tracer_fractions = {0.4, 0.6};
    run.state.temperatures = {292.15, 294.15};
    double const eddy = run.at(run.solver.eddy_viscosity(run.state), 0, 0, 0);
    EXPECT_NEAR(eddy, std::pow(0.09, 0.25) * 0.1 * 0.1, 1e-6);
    for (int step = 0; step < 60; ++step) run.step(time / 60);
    double heat = 0, tracer = 0;
    grid::for_each_cell(run.grid, [&](int i, int, int, grid::Index c) {
        double const s = 2.0 / cells * std::sin(wave * run.grid.axes[0].centre(i));
        heat += s * (run.state.temperature[c] - 293.15);
        tracer += s * (run.state.tracer_fraction[c] - 0.5);
    });
    EXPECT_NEAR(heat, std::exp(-(1e-4 + eddy / 0.5) * wave * wave * time), 0.01);
    EXPECT_NEAR(tracer, 0.1 * std::exp(-(2e-4 + eddy / 1.5) * wave * wave * time), 0.001);
}

TEST(Turbulence, enters_with_its_intensity_and_length)
{
    // Through a duct that slips, 10 m/s, 10 %: k = 1.5 m2/s2; behind the inlet it decays by its power law.
    for (char const* name : {"k-epsilon", "k-omega-sst"}) {
        gas::Settings settings{.gravity = {}, .density = 1.2, .viscosity = 1.8e-5};
        settings.turbulence.model = *turbulence::All::make(name);
        settings.turbulence.energy = 1e-3;
        settings.walls[0].slip = true;
        settings.inlets = {
            gas::Inlet{.mass_flow = 1.2 * 0.01 * 10, .turbulence_intensity = 0.1, .turbulence_length = 0.05}};
        ChamberWithGas run({.size = {0.1, 0.1, 1}}, {2, 2, 50}, {true, true, false}, settings, 293.15, 0, {0, 0, 10});
        for (int step = 0; step < 400; ++step) run.step(1e-3);
        double const time = run.grid.axes[2].centre(40) / 10,
                     epsilon = std::pow(0.09, 0.75) * std::pow(1.5, 1.5) / 0.05;
        double const omega = std::sqrt(1.5) / (std::pow(0.09, 0.25) * 0.05);
        double const k = name[2] == 'e' ? 1.5 * std::pow(1 + 0.92 * epsilon / 1.5 * time, -1 / 0.92)
                                        : 1.5 * std::pow(1 + 0.0828 * omega * time, -0.09 / 0.0828);
        EXPECT_NEAR(run.at(run.state.energy_of_eddies, 0, 0, 40), k, 0.02 * k) << name;
        auto const eddies = run.solver.eddies(run.state);
        double const slope =
            (run.at(run.state.energy_of_eddies, 0, 0, 41) - run.at(run.state.energy_of_eddies, 0, 0, 39)) / 0.04;
        EXPECT_NEAR(run.at(eddies.gradient[2], 0, 0, 40), slope, 1e-9 * std::abs(slope)) << name;
    }
}

TEST(Turbulence, knows_how_far_walls_are)
{
    // Read off the balance of omega in still gas: beside the wall omega is 6 nu/(beta y^2), far from it what was.
    auto settings = with_model("k-omega-sst");
    settings.turbulence.energy = 1e-10;
    ChamberWithGas run({.size = {0.08, 0.08, 0.08}}, {8, 8, 8}, {true, true, false}, settings);
    run.step(1e-6);
    double const y = 0.005, nu = 1.8e-5 / 1.2;
    for (int const k : {0, 7})
        EXPECT_NEAR(run.at(run.state.rate_of_eddies, 3, 3, k), 6 * nu / (0.075 * y * y),
                    1e-3 * 6 * nu / (0.075 * y * y));
}
