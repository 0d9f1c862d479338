// The gas in motion: free stream, walls, packed beds, exchange of momentum, jets.
#include "chamber_with_gas.hpp"

#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;
using gas::ChamberWithGas;
using geometry::Chamber;
using math::Vec3;

namespace
{
//! Constant properties, no gravity.
gas::Settings plain(double density, double viscosity)
{
    return {.gravity = {}, .density = density, .viscosity = viscosity};
}

//! Ergun's drag of a bed of spheres as coefficient per bed volume, kg/m3/s: F = (150 phi + 1.75 Re)/(18 eps^2) with Re
//! on the superficial slip, force per volume 18 mu eps phi F (u - v) / d^2.
double ergun(double eps, double diameter, double superficial, double mu, double density)
{
    double const phi = 1 - eps, reynolds = density * superficial * diameter / mu;
    double const f = (150 * phi + 1.75 * reynolds) / (18 * eps * eps);
    return 18 * mu * eps * phi * f / (diameter * diameter);
}
}

TEST(Momentum, uniform_flow_stays_uniform_in_a_cut_cylinder)
{
    Chamber const cylinder{.shape = Chamber::Shape::revolution, .profile = {{0, 0.1}, {0.5, 0.1}}};
    auto settings = plain(1.2, 0);
    double const flow = 1.2 * 0.7 * cylinder.area(0);
    settings.inlets = {gas::Inlet{.mass_flow = flow}};
    ChamberWithGas run(cylinder, {12, 12, 20}, {}, settings, 293.15, 0, {0, 0, 0.7});
    for (int step = 0; step < 20; ++step) run.step(5e-3);
    double worst = 0, sideways = 0;
    auto const u = run.solver.cell_velocity(run.state);
    grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) {
        if (!run.grid.open(c)) return;
        worst = std::max(worst, std::abs(u[2][c] / 0.7 - 1));
        sideways = std::max(sideways, std::abs(u[0][c]));
    });
    // The open areas of plate and planes agree to the slivers that were closed.
    EXPECT_LT(worst, 1e-3);
    EXPECT_LT(sideways, 1e-3);
}

TEST(Momentum, mass_is_conserved_through_a_cone_and_every_plane_passes_the_inlet_flow)
{
    auto settings = plain(1.1, 1.8e-5);
    settings.inlets = {gas::Inlet{.mass_flow = 0.04}};
    ChamberWithGas run(gas::laboratory_chamber(), {12, 12, 40}, {}, settings);
    double const dt = 2e-3;
    for (int step = 0; step < 50; ++step) {
        double const before = run.sum(run.state.mass);
        auto const balance = run.step(dt);
        EXPECT_NEAR(run.sum(run.state.mass), before + balance.mass_in - balance.mass_out, 1e-12 * before);
        EXPECT_NEAR(balance.mass_in / (0.04 * dt), 1, 1e-12);
    }
    for (int k = 0; k <= 40; ++k) {
        double through = 0;
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i) through += run.at(run.state.mass_flux[2], i, j, k);
        EXPECT_NEAR(through / 0.04, 1, 1e-6) << "plane " << k;
    }
    // Continuity: the cross-section grows from 180 to 250 mm, the mean speed falls with its square.
    auto const u = run.solver.cell_velocity(run.state);
    double flow = 0, volume = 0;
    for (int j = 0; j < 12; ++j)
        for (int i = 0; i < 12; ++i) {
            flow += u[2][run.grid.at(i, j, 38)] * run.at(run.grid.open_volume, i, j, 38);
            volume += run.at(run.grid.open_volume, i, j, 38);
        }
    EXPECT_NEAR(flow / volume, 0.04 / 1.1 / (math::pi * 0.125 * 0.125), 0.01);
}

TEST(Momentum, gas_at_rest_carries_its_weight)
{
    gas::Settings const settings{.inlets = {gas::Inlet{.mass_flow = 0}}, .density = 1.2, .viscosity = 1.8e-5};
    ChamberWithGas run(gas::laboratory_chamber(), {12, 12, 20}, {}, settings);
    for (std::size_t c = 0; c < run.voidage.size(); ++c) run.voidage[c] = 1;
    for (int step = 0; step < 20; ++step) run.step(1e-2);
    auto const slope = run.solver.cell_pressure_gradient(run.state);
    grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) {
        if (!run.grid.open(c) || run.solver.weights().lower[2][c] + run.solver.weights().upper[2][c] == 0) return;
        EXPECT_NEAR(slope[2][c], -1.2 * 9.81, 1e-6);
        EXPECT_NEAR(run.state.velocity[2][c], 0, 1e-8);
    });
}

TEST(Momentum, fixed_bed_has_ergun_pressure_drop)
{
    double const eps = 0.42, diameter = 1e-3, superficial = 0.3, mu = 1.8e-5, density = 1.2;
    auto settings = plain(density, mu);
    Chamber const box{.size = {0.02, 0.02, 0.1}};
    settings.inlets = {gas::Inlet{.mass_flow = density * superficial * box.area(0)}};
    ChamberWithGas run(box, {4, 4, 20}, {}, settings);
    std::fill(run.voidage.begin(), run.voidage.end(), eps);
    run.state = run.solver.start(run.voidage, run.grid.make_field(293.15), 0, {0, 0, superficial / eps});
    double const coefficient = ergun(eps, diameter, superficial, mu, density);
    grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) {
        run.sources.drag_coefficient[c] = coefficient * run.grid.open_volume[c];
    });
    for (int step = 0; step < 200; ++step) run.step(1e-3);
    auto const slope = run.solver.cell_pressure_gradient(run.state);
    // Walls are felt by the gas in the cells along them, not in the middle of the bed.
    EXPECT_NEAR(-slope[2][run.grid.at(2, 2, 10)], 5157.43, 5.157);
    EXPECT_NEAR(run.solver.cell_velocity(run.state)[2][run.grid.at(2, 2, 10)], superficial / eps, 1e-3);
}

TEST(Momentum, porous_step_gives_bernoulli_pressure_change)
{
    // Voidage falls from 1 to 0.4 over ten cells without drag: p2 - p1 = -(rho U^2 / 2)(1/eps2^2 - 1/eps1^2) = -3.15
    // Pa.
    auto run_with = [](int cells) {
        auto settings = plain(1.2, 0);
        Chamber const box{.size = {0.1, 0.1, 1}};
        settings.inlets = {gas::Inlet{.mass_flow = 1.2 * 1.0 * box.area(0)}};
        ChamberWithGas run(box, {1, 1, cells}, {true, true, false}, settings);
        for (int k = 0; k < cells; ++k) {
            double const t = std::clamp((k + 0.5) / cells * 4 - 1.5, 0.0, 1.0);
            run.voidage[run.grid.at(0, 0, k)] = 1 - 0.6 * t * t * (3 - 2 * t);
        }
        run.state = run.solver.start(run.voidage, run.grid.make_field(293.15), 0, {0, 0, 1});
        for (int step = 0; step < 10 * cells; ++step) run.step(0.3 / cells);
        double worst = 0;
        for (int k = 1; k <= cells; ++k)
            worst = std::max(worst, std::abs(run.at(run.state.mass_flux[2], 0, 0, k) / (1.2 * 0.01) - 1));
        EXPECT_LT(worst, 1e-6);
        return run.at(run.state.pressure, 0, 0, cells - 2) - run.at(run.state.pressure, 0, 0, 1);
    };
    double const coarse = run_with(40) + 3.15, fine = run_with(80) + 3.15;
    EXPECT_LT(std::abs(coarse), 0.35);
    EXPECT_LT(std::abs(fine), 0.18);  // first-order upwind: the error falls with the cell
}

TEST(Momentum, plane_poiseuille_profile)
{
    // Between walls at x = 0 and x = H driven by a body force f: u = f x (H - x) / (2 mu), largest 1.5 times the mean.
    auto settings = plain(1.0, 0.01);
    settings.outlets = {};
    int const n = 20;
    double const height = 0.1, push = 1;
    ChamberWithGas run(Chamber{.size = {height, 0.05, 0.05}}, {n, 1, 1}, {false, true, true}, settings);
    grid::for_each_cell(
        run.grid, [&](int, int, int, grid::Index c) { run.sources.force[2][c] = push * run.grid.open_volume[c]; });
    for (int step = 0; step < 300; ++step) run.step(0.02);
    auto const u = run.solver.cell_velocity(run.state);
    double mean = 0, largest = 0;
    for (int i = 0; i < n; ++i) {
        double const x = (i + 0.5) * height / n, value = u[2][run.grid.at(i, 0, 0)];
        EXPECT_NEAR(value, push * x * (height - x) / (2 * 0.01), 0.01 * push * height * height / (8 * 0.01));
        mean += value / n;
        largest = std::max(largest, value);
    }
    EXPECT_NEAR(largest / mean, 1.5, 0.015);
}

TEST(Momentum, gas_and_granules_exchange_momentum_without_loss)
{
    // Uniform suspension in a periodic box: the granules get exactly what the gas gives, and the slip relaxes at
    // coefficient (1/mass of granules + 1/mass of gas).
    auto settings = plain(1.2, 1.8e-5);
    settings.outlets = {};
    ChamberWithGas run(Chamber{.size = {0.04, 0.04, 0.04}}, {4, 4, 4}, {true, true, true}, settings);
    std::fill(run.voidage.begin(), run.voidage.end(), 0.6);
    run.state = run.solver.start(run.voidage, run.grid.make_field(293.15), 0, {0.3, 0, -1});
    double const volume = run.grid.volume(0, 0, 0), solid = 0.4 * 2.0 * volume, air = 0.6 * 1.2 * volume,
                 coefficient = 50 * volume;
    std::vector<Vec3> v(run.grid.size(), {0, 0.2, 1});
    auto total = [&] {
        Vec3 sum = run.solver.momentum(run.state);
        grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) { sum += solid * v[c]; });
        return sum;
    };
    Vec3 const before = total();
    double const dt = 1e-5;
    auto const cell = run.grid.at(1, 2, 3);
    double const slip0 = v[cell].z + 1;
    for (int step = 0; step < 1000; ++step) {
        grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) {
            run.sources.drag_coefficient[c] = coefficient;
            for (std::size_t d = 0; d < 3; ++d) run.sources.drag_momentum[d][c] = coefficient * v[c][d];
        });
        run.step(dt);
        auto const u = run.solver.cell_velocity(run.state);
        grid::for_each_cell(run.grid, [&](int, int, int, grid::Index c) {
            v[c] += dt * coefficient / solid * (Vec3{u[0][c], u[1][c], u[2][c]} - v[c]);
        });
        ASSERT_LT(norm(total() - before), 1e-12 * norm(before));
    }
    double const slip = v[cell].z - run.solver.cell_velocity(run.state)[2][cell];
    EXPECT_NEAR(std::log(slip0 / slip) / (1000 * dt), coefficient * (1 / solid + 1 / air), 0.01 * coefficient / air);
}

TEST(Momentum, drag_on_faces_and_on_cells_is_the_same_sum)
{
    // Granules at rest in some cells only: what the gas loses is what cell_velocity says they take.
    auto settings = plain(1.2, 0);
    settings.outlets = {};
    ChamberWithGas run(Chamber{.size = {0.08, 0.08, 0.08}}, {8, 8, 8}, {true, true, true}, settings, 293.15, 0,
                       {0, 0, 1});
    grid::for_each_cell(run.grid, [&](int i, int j, int k, grid::Index c) {
        if ((i + 2 * j + 3 * k) % 5 < 2) run.sources.drag_coefficient[c] = 30 * run.grid.volume(0, 0, 0);
    });
    double const dt = 1e-3;
    for (int step = 0; step < 5; ++step) {
        double const before = run.solver.momentum(run.state).z;
        run.step(dt);
        auto const u = run.solver.cell_velocity(run.state);
        double taken = 0;
        grid::for_each_cell(run.grid,
                            [&](int, int, int, grid::Index c) { taken += run.sources.drag_coefficient[c] * u[2][c]; });
        // Fluxes are divergence-free to the tolerance of the pressure only.
        EXPECT_NEAR(before - run.solver.momentum(run.state).z, dt * taken, 1e-7 * before);
    }
}

TEST(Momentum, a_jet_keeps_the_momentum_it_was_given)
{
    // A force J upwards in one cell of an empty, wide, slip-walled box with outlet: far from the walls the flux of
    // momentum plus pressure through planes downstream is J.
    auto settings = plain(1.2, 0);
    settings.inlets = {gas::Inlet{.mass_flow = 1.2 * 0.05 * 0.25}};
    ChamberWithGas run(Chamber{.size = {0.5, 0.5, 0.5}}, {16, 16, 20}, {true, true, false}, settings, 293.15, 0,
                       {0, 0, 0.05});
    double const force = 0.02;
    run.sources.force[2][run.grid.at(8, 8, 4)] = force;
    auto passing = [&](int k) {
        double sum = 0;
        for (int j = 0; j < 16; ++j)
            for (int i = 0; i < 16; ++i) {
                auto const c = run.grid.at(i, j, k), up = run.grid.at(i, j, k + 1);
                double const flux = 0.5 * (run.state.mass_flux[2][c] + run.state.mass_flux[2][up]);
                sum += flux * 0.5 * (run.state.velocity[2][c] + run.state.velocity[2][up]);
                sum += run.state.pressure[c] * run.grid.area(2, {0, 0, 0});
            }
        return sum;
    };
    // The jet flutters: its mean over a while.
    std::array<double, 3> through{};
    for (int step = 0; step < 600; ++step) {
        run.step(std::min(run.solver.courant_step(run.state, 0.8), 5e-3));
        for (std::size_t k = 0; k < 3 && step >= 200; ++k)
            through[k] += (passing(std::array{7, 10, 14}[k]) - passing(2)) / 400;
    }
    for (double const mean : through) EXPECT_NEAR(mean, force, 0.03 * force);
}

TEST(Momentum, courant_step_is_the_time_to_cross_a_cell)
{
    auto settings = plain(1.2, 0);
    settings.outlets = {};
    ChamberWithGas run(Chamber{.size = {0.1, 0.1, 0.2}}, {10, 10, 10}, {true, true, true}, settings, 293.15, 0,
                       {0.5, 0, 2});
    EXPECT_NEAR(run.solver.courant_step(run.state, 0.5), 0.5 * 0.01, 1e-12);
    run.state = run.solver.start(run.voidage, run.grid.make_field(293.15), 0, {});
    EXPECT_TRUE(std::isinf(run.solver.courant_step(run.state, 0.5)));
}
