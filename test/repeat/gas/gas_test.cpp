// The same gas on one rank and on several: equal to the tolerance of the pressure, ledgers closed on each number of
// ranks.
#include "unit/gas/chamber_with_gas.hpp"

#include "granum/grid/halo.hpp"
#include "granum/material/moist_air.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;
using gas::ChamberWithGas;

namespace
{
//! A bed that moves, takes heat, evaporates water and is stirred by a jet; sources by global index.
gas::Balance bed_step(ChamberWithGas& run, int step)
{
    auto const& grid = run.grid;
    grid::for_each_cell(grid, [&](int local_i, int local_j, int local_k, grid::Index c) {
        int const i = local_i + grid.shift[0], j = local_j + grid.shift[1], k = local_k + grid.shift[2];
        bool const bed = k < 6 && grid.open(c);
        double const wave = std::sin(0.1 * step + 0.6 * i) * std::cos(0.5 * j);
        run.voidage[c] = bed ? 0.6 + 0.1 * wave : 1;
        run.sources.drag_coefficient[c] = bed ? 2000 * grid.open_volume[c] : 0;
        run.sources.drag_momentum[0][c] = run.sources.drag_coefficient[c] * 0.2 * wave;
        run.sources.heat_coefficient[c] = bed ? 1e4 * grid.open_volume[c] : 0;
        run.sources.heat_value[c] = 40 * run.sources.heat_coefficient[c];
        run.sources.mass[c] = run.sources.vapour[c] = bed ? 0.05 * grid.open_volume[c] : 0;
        run.sources.enthalpy[c] = run.sources.vapour[c] * material::vapour_enthalpy(315);
        run.sources.force[2][c] = i == 6 && j == 5 && k == 9 ? -0.01 : 0;
    });
    return run.step(1e-3);
}
}

TEST(GasOnRanks, cut_chamber_agrees_with_one_rank)
{
    gas::Settings settings;
    settings.inlets = {gas::Inlet{.mass_flow = 0.04, .temperature = 353.15, .vapour_fraction = 0.008}};
    settings.tolerance = 1e-11;
    std::array<int, 3> const cells{12, 12, 24};
    ChamberWithGas alone(gas::laboratory_chamber(), cells, {}, settings, 320, 0.01);
    ChamberWithGas shared(gas::laboratory_chamber(), cells, {}, settings, 320, 0.01, {}, MPI_COMM_WORLD);
    double mass = shared.sum(shared.state.mass), enthalpy = shared.sum(shared.state.enthalpy);
    for (int step = 0; step < 40; ++step) {
        bed_step(alone, step);
        auto const balance = bed_step(shared, step);
        mass += shared.comm.sum(balance.mass_in - balance.mass_out) + 1e-3 * shared.sum(shared.sources.mass);
        enthalpy += shared.comm.sum(balance.enthalpy_in - balance.enthalpy_out);
        double heat = 0;
        grid::for_each_cell(shared.grid, [&](int, int, int, grid::Index c) {
            auto const& s = shared.sources;
            heat += s.enthalpy[c] + s.heat_value[c] -
                    s.heat_coefficient[c] * (shared.solver.exchanged_temperature()[c] - 273.15);
        });
        enthalpy += 1e-3 * shared.comm.sum(heat);
    }
    EXPECT_NEAR(shared.sum(shared.state.mass), mass, 1e-12 * mass);
    EXPECT_NEAR(shared.sum(shared.state.enthalpy), enthalpy, 1e-12 * enthalpy);

    double speed = 0, pressure = 0, temperature = 0, vapour = 0;
    grid::for_each_cell(shared.grid, [&](int i, int j, int k, grid::Index c) {
        auto const there = alone.grid.at(i + shared.grid.shift[0], j + shared.grid.shift[1], k + shared.grid.shift[2]);
        for (std::size_t d = 0; d < 3; ++d)
            speed = std::max(speed, std::abs(shared.state.velocity[d][c] - alone.state.velocity[d][there]));
        pressure = std::max(pressure, std::abs(shared.state.pressure[c] - alone.state.pressure[there]));
        temperature = std::max(temperature, std::abs(shared.state.temperature[c] - alone.state.temperature[there]));
        vapour = std::max(vapour, std::abs(shared.state.vapour_fraction[c] - alone.state.vapour_fraction[there]));
    });
    EXPECT_LT(speed, 1e-4);
    EXPECT_LT(pressure, 0.1);
    EXPECT_LT(temperature, 1e-3);
    EXPECT_LT(vapour, 1e-7);
}

TEST(GasOnRanks, turbulence_agrees_with_one_rank)
{
    for (char const* name : {"k-epsilon", "k-omega-sst", "wale"}) {
        gas::Settings settings;
        settings.inlets = {gas::Inlet{.mass_flow = 0.04, .temperature = 353.15, .vapour_fraction = 0.008}};
        settings.tolerance = 1e-11;
        settings.turbulence.model = *law::turbulence::All::make(name);
        settings.turbulence.granules = {.on = name[0] == 'k', .wake = 0.1, .solids_density = 1500};
        std::array<int, 3> const cells{12, 12, 24};
        ChamberWithGas alone(gas::laboratory_chamber(), cells, {}, settings, 320, 0.01);
        ChamberWithGas shared(gas::laboratory_chamber(), cells, {}, settings, 320, 0.01, {}, MPI_COMM_WORLD);
        for (int step = 0; step < 20; ++step) bed_step(alone, step), bed_step(shared, step);
        auto const one = alone.solver.eddy_viscosity(alone.state), other = shared.solver.eddy_viscosity(shared.state);
        double largest = 0, difference = 0;
        grid::for_each_cell(shared.grid, [&](int i, int j, int k, grid::Index c) {
            auto const there =
                alone.grid.at(i + shared.grid.shift[0], j + shared.grid.shift[1], k + shared.grid.shift[2]);
            largest = std::max(largest, one[there]);
            difference = std::max(difference, std::abs(other[c] - one[there]));
        });
        largest = shared.comm.max(largest), difference = shared.comm.max(difference);
        EXPECT_GT(largest, 1e-6) << name;
        EXPECT_LT(difference, 1e-7 * largest) << name;
    }
}

TEST(GasOnRanks, momentum_of_a_periodic_box_is_kept)
{
    gas::Settings settings{.outlets = {}, .gravity = {}, .density = 1.2, .viscosity = 1e-4};
    ChamberWithGas run(geometry::Chamber{.size = {0.1, 0.1, 0.1}}, {8, 8, 8}, {true, true, true}, settings, 293.15, 0,
                       {1, 0.3, -0.2}, MPI_COMM_WORLD);
    // A shear layer on top of the mean flow.
    grid::for_each_cell(run.grid, [&](int, int j, int, grid::Index c) {
        run.state.velocity[0][c] += std::sin(0.785398 * (j + run.grid.shift[1]));
    });
    run.step(1e-3);
    auto const before = run.solver.momentum(run.state);
    for (int step = 0; step < 50; ++step) run.step(1e-3);
    EXPECT_LT(norm(run.solver.momentum(run.state) - before), 1e-12 * norm(before));
}

TEST(GasOnRanks, fold_is_the_adjoint_of_refresh)
{
    par::Communicator const comm;
    auto const grid = gas::cut(geometry::Chamber{.size = {0.1, 0.1, 0.1}}, {8, 3, 4}, {true, true, false}, comm);
    auto a = grid.make_field(), b = grid.make_field();
    for (std::size_t c = 0; c < a.size(); ++c) {
        a[c] = std::sin(1.3 * static_cast<double>(c) + comm.rank());
        b[c] = std::cos(0.7 * static_cast<double>(c) - comm.rank());
    }
    auto refreshed = a, folded = b;
    std::array<grid::Field*, 1> const up{&refreshed}, down{&folded};
    grid::refresh(grid, up);
    grid::fold(grid, down);
    double left = 0, right = 0;
    for (std::size_t c = 0; c < a.size(); ++c) left += refreshed[c] * b[c], right += a[c] * folded[c];
    EXPECT_NEAR(comm.sum(left), comm.sum(right), 1e-11);
}
