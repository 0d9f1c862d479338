// Time of a pressure solve by each method, on systems like those of a bed: microseconds per cell and solve (set-up
// included) and iterations. Methods take turns, so that a busy machine is unfair to none; medians and extremes.
// bench_pressure [REPETITIONS]; on several ranks under tools/mpi.
#include "granum/base/timer.hpp"
#include "granum/solve/pressure.hpp"
#include "scene/bed_system.hpp"
#include "scene/cells.hpp"

#include <fmt/core.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>

using namespace granum;
using solve::Method;

namespace
{
struct Size
{
    char const* name;
    std::array<int, 3> cells;
    math::Vec3 width;  // of a cell, m
};

void measure(Size const& size, par::Communicator const& comm, int repetitions)
{
    math::Vec3 upper;
    for (std::size_t d = 0; d < 3; ++d) upper[d] = size.cells[d] * size.width[d];
    geometry::Chamber const chamber{.size = upper};
    auto const grid = cut_evenly(chamber, grid::uniform_lines({}, upper, size.cells), {}, comm);
    auto const system = bed_system(grid);
    double const cells = static_cast<double>(size.cells[0]) * size.cells[1] * size.cells[2];

    struct Candidate
    {
        char const* name;
        bool anew;  // the set-up, in each solve
        std::unique_ptr<solve::Pressure> pressure;
        std::vector<double> times{};
        int iterations = 0;
    };
    std::vector<Candidate> candidates;
    auto const add = [&](char const* name, Method method, bool anew) {
        candidates.push_back({name, anew, std::make_unique<solve::Pressure>(grid, comm, method)});
    };
    add("multigrid", Method::multigrid, false);
    add("pfmg", Method::pfmg, true);
    add("pfmg kept", Method::pfmg, false);
    add("smg", Method::smg, true);
    add("diagonal", Method::diagonal, false);
    for (int k = -1; k < repetitions; ++k)
        for (auto& candidate : candidates) {
            auto x = grid.make_field();
            if (candidate.anew) candidate.pressure->recall({});
            comm.barrier();
            double const start = MPI_Wtime();
            auto const outcome = candidate.pressure->solve(system, x, 1e-6);
            double const taken = comm.max(MPI_Wtime() - start);
            if (k >= 0) candidate.times.push_back(1e6 * taken / cells);
            candidate.iterations = outcome.iterations;
        }
    for (auto& candidate : candidates) {
        std::sort(candidate.times.begin(), candidate.times.end());
        if (comm.root())
            fmt::print("{:20} {:10} {:4} iterations  {:7.4f} us/cell ({:.4f} to {:.4f})\n", size.name, candidate.name,
                       candidate.iterations, candidate.times[candidate.times.size() / 2], candidate.times.front(),
                       candidate.times.back());
    }
}
}

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    {
        par::Communicator const comm;
        int const repetitions = argc > 1 ? std::atoi(argv[1]) : 15;
        measure({"5,400 (2x30x90)", {2, 30, 90}, {7.5e-3, 5e-3, 5e-3}}, comm, repetitions);
        measure({"131,072 (32x32x128)", {32, 32, 128}, {5e-3, 5e-3, 5e-3}}, comm, repetitions);
        measure({"1,048,576 (64x64x256)", {64, 64, 256}, {5e-3, 5e-3, 5e-3}}, comm, std::max(repetitions / 3, 3));
    }
    MPI_Finalize();
    return 0;
}
