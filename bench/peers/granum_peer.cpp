// Granum's side of the comparison with other programs: loads a state, does the same steps, prints one line to be read
// by bench/peers/programs.py. Runs on as many ranks as mpirun starts.
//
//   peer_granum time   STATE [--tiles X Y] [--warm N] [--steps N]      seconds of the timed steps and what came out
//   peer_granum forces STATE --out FILE [--steps N] [laws]             forces and torques, to be held against LAMMPS
//   peer_granum sizes  --out FILE [--granules N] [--settle N]          a settled bed of five sizes, ratio 10
#include "granum/base/error.hpp"
#include "peers/box.hpp"
#include "peers/size_mix.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

using namespace granum;

namespace
{
struct Options
{
    std::string state, out;
    std::vector<long> tiles{1, 1};
    long warm = 0, steps = 0, granules = 20000, settle = 25000;
    double dt = 1e-5;
    peers::Engine engine;
    bool cut_attraction = false, lever_radius = false, no_rolling = false;
    double friction = 0.3;

    peers::Touching touching() const
    {
        return {.attraction = cut_attraction ? law::contact::Attraction::cut : law::contact::Attraction::keep,
                .lever = lever_radius ? dem::Lever::radius : dem::Lever::contact_point,
                .rolling = !no_rolling,
                .sliding_friction = friction};
    }
};

//! Peak of resident memory of this process, bytes; 0 where the system does not tell.
long peak_memory()
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::stol(line.substr(6));
    return 0;
}

void advance(peers::Box& box, double dt, long steps)
{
    box.engine->advance(box.granules, dt, static_cast<int>(steps));
}

void time_steps(Options const& options, par::Communicator const& comm)
{
    auto const state = peers::read_state(options.state);
    peers::Box box(state, options.tiles[0], options.tiles[1], options.touching(), options.engine, comm);
    advance(box, options.dt, options.warm);
    long const built_before = box.engine->watch().rebuilds;
    comm.barrier();
    double const start = MPI_Wtime();
    advance(box, options.dt, options.steps);
    comm.barrier();
    double const seconds = MPI_Wtime() - start;
    // Read before anything is counted, so that counting does not enter it.
    long const memory = comm.sum(peak_memory());
    double const energy = box.kinetic_energy(comm), coordination = box.coordination(comm);
    if (comm.root())
        fmt::print(
            "peer=granum granules={} ranks={} steps={} loop={:.6f} builds={} coordination={:.4f} ke={:.6g} "
            "memory={} kernel={}\n",
            box.total, comm.size(), options.steps, seconds, box.engine->watch().rebuilds - built_before, coordination,
            energy, memory, box.engine->kernel());
}

void write_forces(Options const& options, par::Communicator const& comm)
{
    base::require(comm.size() == 1, "forces are written on one rank, not on {}", comm.size());
    auto const state = peers::read_state(options.state);
    peers::Box box(state, 1, 1, options.touching(), options.engine, comm);
    advance(box, options.dt, options.steps);
    std::vector<std::size_t> rows(box.granules.owned);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = k;
    std::sort(rows.begin(), rows.end(), [&](auto a, auto b) { return box.granules.id[a] < box.granules.id[b]; });
    std::ofstream file(options.out);
    file << "id,fx,fy,fz,tx,ty,tz\n";
    for (auto const row : rows) {
        // The column is of contacts alone; LAMMPS' force has the weight in it.
        auto const f = box.granules.force[row] + box.granules.mass[row] * box.engine->settings().gravity;
        auto const& t = box.granules.torque[row];
        file << fmt::format("{},{},{},{},{},{},{}\n", box.granules.id[row], f.x, f.y, f.z, t.x, t.y, t.z);
    }
    if (!file.flush()) throw base::IoError(fmt::format("{}: cannot be written", options.out));
}

void make_sizes(Options const& options, par::Communicator const& comm)
{
    base::require(comm.size() == 1, "a state is made on one rank, not on {}", comm.size());
    auto state = peers::five_sizes(options.granules);
    peers::Touching slippery = options.touching();
    slippery.restitution = 0.3, slippery.sliding_friction = 0.05, slippery.rolling = false;
    peers::Box box(state, 1, 1, slippery, options.engine, comm);
    advance(box, options.dt, options.settle);
    for (std::size_t row = 0; row < box.granules.owned; ++row) {
        auto& sphere = state.spheres[box.granules.id[row] - 1];
        sphere.position = box.granules.position[row];  // at rest: no velocities
    }
    peers::write_state(state, options.out);
    fmt::print("peer=granum granules={} coordination={:.4f} ke={:.6g}\n", box.total, box.coordination(comm),
               box.kinetic_energy(comm));
}

int run(int argc, char** argv)
{
    Options options;
    CLI::App program("Granum's side of the comparison with other programs");
    program.require_subcommand(1);
    auto* const time = program.add_subcommand("time", "seconds of the timed steps");
    auto* const forces = program.add_subcommand("forces", "forces and torques as CSV");
    auto* const sizes = program.add_subcommand("sizes", "a settled bed of five sizes");
    for (auto* const verb : {time, forces}) {
        verb->add_option("state", options.state, "CSV file of spheres")->required()->check(CLI::ExistingFile);
        verb->add_option("--steps", options.steps, "steps (timed)")->check(CLI::NonNegativeNumber);
        verb->add_flag("--cut", options.cut_attraction, "no pull at the end of a contact; the peers keep it");
        verb->add_flag("--no-rolling", options.no_rolling, "without rolling resistance");
        verb->add_option("--friction", options.friction, "sliding friction")->check(CLI::NonNegativeNumber);
    }
    time->add_option("--tiles", options.tiles, "repeat the state along x and y")
        ->expected(2)
        ->check(CLI::PositiveNumber);
    time->add_option("--warm", options.warm, "steps before the timed ones")->check(CLI::NonNegativeNumber);
    time->add_flag("--ledger", options.engine.energy_ledger, "account for the energy of contacts, as no peer does");
    forces->add_flag("--lever-radius", options.lever_radius, "forces act at the radius, not at the contact point");
    sizes->add_option("--granules", options.granules, "how many")->check(CLI::Range(1000, 200000));
    sizes->add_option("--settle", options.settle, "steps to settle")->check(CLI::NonNegativeNumber);
    for (auto* const verb : {time, forces})
        verb->add_option("--kernel", options.engine.kernel, "avx512, avx2, sse4, scalar or reference");
    for (auto* const verb : {forces, sizes}) verb->add_option("--out", options.out, "file to write")->required();
    for (auto* const verb : {time, forces, sizes}) {
        verb->add_option("--dt", options.dt, "step, s")->check(CLI::PositiveNumber);
        verb->add_option("--skin", options.engine, "of the neighbour list, m; 0: chosen by the engine")
            ->check(CLI::NonNegativeNumber);
    }
    CLI11_PARSE(program, argc, argv);
    par::Communicator const comm;
    try {
        if (*time) time_steps(options, comm);
        if (*forces) write_forces(options, comm);
        if (*sizes) make_sizes(options, comm);
    } catch (base::Error const& error) {
        fmt::print(stderr, "peer_granum: {}\n", error.what());
        if (comm.size() > 1) MPI_Abort(comm.handle(), static_cast<int>(error.exit));
        return static_cast<int>(error.exit);
    }
    return 0;
}
}

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    int const status = run(argc, argv);
    MPI_Finalize();
    return status;
}
