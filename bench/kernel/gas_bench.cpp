// Time of a gas step alone (momentum, pressure, vapour, enthalpy; laminar, solver set-up included) in a bubbling bed
// whose bubbles rise, by number of cells: microseconds per cell and step, median and extremes of blocks of steps.
//
// bench_gas [BLOCKS], or on several ranks tools/mpi 2 bench_gas [BLOCKS].
#include "granum/base/random.hpp"
#include "granum/gas/flow.hpp"
#include "granum/material/moist_air.hpp"
#include "scene/cells.hpp"

#include <fmt/core.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace granum;

namespace
{
struct Size
{
    char const* name;
    std::array<int, 3> cells;
    math::Vec3 width;  // of a cell, m
};

constexpr double dt = 2e-4;
constexpr int steps_of_block = 20;

//! Voidage of a bed that fills 0.45 of the height, with bubbles that rise 0.5 m/s.
double voidage_at(math::Vec3 const& x, math::Vec3 const& size, double time)
{
    if (x.z > 0.45 * size.z) return 1;
    auto const chance = [](std::uint64_t what, std::uint32_t which) {
        return base::Random(5, base::Purpose::test, what, which).uniform();
    };
    double nearest = 2;
    for (std::uint64_t b = 0; b < 12; ++b) {
        double const height = std::fmod(chance(b, 3) * 0.45 * size.z + 0.5 * time, 0.45 * size.z);
        math::Vec3 const centre{chance(b, 1) * size.x, chance(b, 2) * size.y, height};
        double const radius = (0.05 + 0.1 * chance(b, 4)) * std::min(size.y, size.z);
        nearest = std::min(nearest, norm(x - centre) / radius);
    }
    double const within = std::clamp(2 * (1.25 - nearest), 0.0, 1.0);
    return 0.42 + 0.5 * within;
}

void measure(Size const& size, par::Communicator const& comm, int blocks)
{
    math::Vec3 upper;
    for (std::size_t d = 0; d < 3; ++d) upper[d] = size.cells[d] * size.width[d];
    auto const grid = cut_evenly({.size = upper}, grid::uniform_lines({}, upper, size.cells), {}, comm);
    double const cells = static_cast<double>(size.cells[0]) * size.cells[1] * size.cells[2];
    gas::Settings settings;
    settings.inlets = {{.mass_flow = 1.2 * 1.875 * upper.x * upper.y, .temperature = 343.15, .vapour_fraction = 0.008}};
    gas::Solver solver(settings, grid, comm);
    auto voidage = grid.make_field(1);
    double time = 0;
    auto const fill = [&] {
        grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
            voidage[c] = voidage_at(grid.centre(i, j, k), upper, time);
        });
    };
    fill();
    auto state = solver.start(voidage, grid.make_field(320), 0.01, {});
    gas::Sources sources;
    sources.clear(grid);
    std::vector<double> times;
    int iterations = 0;
    for (int block = -2; block < blocks; ++block) {
        double spent = 0;
        for (int step = 0; step < steps_of_block; ++step) {
            time += dt;
            fill();
            grid::for_each_cell(grid, [&](int, int, int, grid::Index c) {
                double const solids = (1 - voidage[c]) * grid.open_volume[c];
                sources.drag_coefficient[c] = 4000 * solids;
                sources.drag_momentum[2][c] = 4000 * solids * 0.1;
                sources.heat_coefficient[c] = 1e4 * solids;
                sources.heat_value[c] = 40 * sources.heat_coefficient[c];
                sources.mass[c] = sources.vapour[c] = 0.05 * solids;
                sources.enthalpy[c] = sources.vapour[c] * material::vapour_enthalpy(315);
            });
            comm.barrier();
            double const start = MPI_Wtime();
            auto const balance = solver.advance(state, sources, voidage, dt);
            spent += comm.max(MPI_Wtime() - start);
            if (block >= 0) iterations += balance.pressure_iterations;
        }
        if (block >= 0) times.push_back(1e6 * spent / (steps_of_block * cells));
    }
    if (!comm.root()) return;
    std::sort(times.begin(), times.end());
    fmt::print("{:22} {:.3f} us per cell and step ({:.3f} to {:.3f}), {:.1f} pressure iterations\n", size.name,
               times[times.size() / 2], times.front(), times.back(),
               static_cast<double>(iterations) / (blocks * steps_of_block));
}
}

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    {
        par::Communicator const comm;
        int const blocks = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 7;
        measure({"5,400 (2x30x90)", {2, 30, 90}, {7.5e-3, 5e-3, 5e-3}}, comm, blocks);
        measure({"131,072 (32x32x128)", {32, 32, 128}, {5e-3, 5e-3, 5e-3}}, comm, std::max(blocks / 2, 3));
    }
    MPI_Finalize();
    return 0;
}
