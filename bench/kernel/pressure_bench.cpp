// Time of a pressure solve by each method, on systems like those of a bubbling bed, to 1e-6 from a guess of zero:
// microseconds per cell and solve and iterations. Methods take turns, so that a busy machine is unfair to none; median
// and extremes. "kept": hypre's set-up is that of an earlier solve of the same system, the best case for keeping it.
// For the own multigrid also the bytes that its loops ask for, against the triad of STREAM (McCalpin) in this process.
//
// bench_pressure [REPETITIONS], or on several ranks tools/mpi 2 bench_pressure [REPETITIONS].
#include "granum/base/bandwidth.hpp"
#include "granum/solve/pressure.hpp"
#include "granum/solve/traffic.hpp"
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

struct Candidate
{
    char const* name;
    bool anew;  // the set-up, in each solve
    std::unique_ptr<solve::Pressure> pressure;
    std::vector<double> times{};  // us per cell
    int iterations = 0;
};

double median(std::vector<double>& values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

void measure(Size const& size, par::Communicator const& comm, int repetitions)
{
    math::Vec3 upper;
    for (std::size_t d = 0; d < 3; ++d) upper[d] = size.cells[d] * size.width[d];
    geometry::Chamber const chamber{.size = upper};
    auto const grid = cut_evenly(chamber, grid::uniform_lines({}, upper, size.cells), {}, comm);
    auto const system = bed_system(grid);
    double const cells = static_cast<double>(size.cells[0]) * size.cells[1] * size.cells[2];

    std::vector<Candidate> candidates;
    auto const add = [&](char const* name, Method method, bool anew) {
        candidates.push_back({name, anew, std::make_unique<solve::Pressure>(grid, comm, method)});
    };
    add("multigrid", Method::multigrid, false);
    add("pfmg", Method::pfmg, true);
    add("pfmg, kept", Method::pfmg, false);
    add("smg", Method::smg, true);
    add("smg, kept", Method::smg, false);
    add("diagonal", Method::diagonal, false);
    std::vector<double> rates;
    for (int k = -1; k < repetitions; ++k) {  // the first turn only warms up
        for (auto& candidate : candidates) {
            auto x = grid.make_field();
            if (candidate.anew) candidate.pressure->recall({});
            comm.barrier();
            double const start = MPI_Wtime();
            candidate.iterations = candidate.pressure->solve(system, x, 1e-6).iterations;
            double const taken = comm.max(MPI_Wtime() - start);
            if (k >= 0) candidate.times.push_back(1e6 * taken / cells);
        }
        comm.barrier();
        rates.push_back(1e-9 * base::Triad().rate());
    }
    if (!comm.root()) return;
    for (auto& candidate : candidates) {
        double const middle = median(candidate.times);
        fmt::print("{:22} {:10} {:5} iterations {:9.4f} us per cell ({:.4f} to {:.4f})\n", size.name, candidate.name,
                   candidate.iterations, middle, candidate.times.front(), candidate.times.back());
    }
    auto const& own = candidates.front();
    double const bytes = solve::traffic::per_solve + own.iterations * solve::traffic::per_iteration;
    double const seconds = own.times[own.times.size() / 2] * 1e-6 * comm.size();  // of a rank, per cell
    fmt::print(
        "{:22} multigrid  {:.0f} bytes per cell and iteration, {:.0f} per solve: {:.1f} GB/s a rank; triad {:.1f}\n",
        size.name, solve::traffic::per_iteration, bytes, 1e-9 * bytes / seconds, median(rates));
}
}

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    {
        par::Communicator const comm;
        int const repetitions = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 15;
        measure({"5,400 (2x30x90)", {2, 30, 90}, {7.5e-3, 5e-3, 5e-3}}, comm, repetitions);
        measure({"131,072 (32x32x128)", {32, 32, 128}, {5e-3, 5e-3, 5e-3}}, comm, repetitions);
        measure({"1,048,576 (64x64x256)", {64, 64, 256}, {5e-3, 5e-3, 5e-3}}, comm, std::max(repetitions / 3, 3));
    }
    MPI_Finalize();
    return 0;
}
