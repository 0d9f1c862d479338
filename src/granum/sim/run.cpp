#include "granum/sim/run.hpp"

#include "granum/sim/case_reader.hpp"
#include "granum/sim/output.hpp"
#include "granum/sim/simulation.hpp"
#include "granum/sim/state_hash.hpp"
#include "granum/sim/stop.hpp"
#include "granum/sim/summary.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace granum::sim
{
namespace
{
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void write_text(std::string const& path, std::string const& text)
{
    std::string const fresh = path + ".new";
    {
        std::ofstream out(fresh);
        out << text;
        out.flush();
        if (!out) throw base::IoError(fmt::format("cannot write {}", path));
    }
    std::error_code failed;
    std::filesystem::rename(fresh, path, failed);
    if (failed) throw base::IoError(fmt::format("cannot write {}: {}", path, failed.message()));
}

//! The resolved case with the origin of each value, and the file as the user wrote it.
void write_case(std::string const& folder, ResolvedCase const& resolved)
{
    write_text(folder + "/resolved.txt", explain(resolved));
    if (std::ifstream original(resolved.data.file); original)
        write_text(folder + "/case.toml", std::string(std::istreambuf_iterator<char>(original), {}));
}

//! The live line: simulated time, speed, time left, and the readings an operator would look at.
class LiveLine
{
  public:
    LiveLine(bool shown, double end) : shown_(shown), terminal_(isatty(STDERR_FILENO) != 0), end_(end) {}

    void update(Simulation const& simulation, Sample const& sample)
    {
        double const now = seconds_since(start_);
        if (!shown_ || simulation.time() <= 0 || now - last_ < (terminal_ ? 0.5 : 20.0)) return;
        last_ = now;
        double const speed = simulation.time() / now, left = (end_ - simulation.time()) / std::max(speed, 1e-12);
        auto const& readings = sample.readings;
        auto line = fmt::format("{:7.3f} s of {:g} s  {:6.2f} ms/s  {:3.0f}:{:02.0f} left", simulation.time(), end_,
                                1e3 * speed, std::floor(left / 60), std::fmod(left, 60.0));
        if (simulation.has_gas()) line += fmt::format("  bed {:.2f} degC", readings.bed_temperature - 273.15);
        if (std::isfinite(readings.outlet_humidity))
            line += fmt::format("  outlet {:.2f} g/kg", 1e3 * readings.outlet_humidity);
        if (std::isfinite(readings.eta)) line += fmt::format("  eta {:.4f}", readings.eta);
        fmt::print(stderr, fmt::runtime(terminal_ ? "\r{}\033[K" : "{}\n"), line);
        std::fflush(stderr);
        dirty_ = terminal_;
    }
    void end()
    {
        if (dirty_) fmt::print(stderr, "\n");
    }

  private:
    bool shown_, terminal_, dirty_ = false;
    double end_, last_ = -1e9;
    Clock::time_point start_ = Clock::now();
};

//! What this rank had when it failed, for ParaView: one file per rank, since the others may not answer any more.
void write_failed_state(std::string const& folder, Simulation& simulation)
{
    auto const& g = simulation.granules();
    std::vector<io::NamedArray> arrays{{.name = "id", .values = {}, .precision = io::Precision::twice},
                                       {.name = "radius [m]", .values = {}},
                                       {.name = "velocity [m/s]", .values = {}, .components = 3}};
    if (g.groups.process) arrays.push_back({.name = "temperature [K]", .values = g.temperature.values});
    for (std::size_t row = 0; row < g.owned; ++row) {
        arrays[0].values.push_back(static_cast<double>(g.id[row]));
        arrays[1].values.push_back(g.radius[row]);
        auto const v = g.velocity[row];
        arrays[2].values.insert(arrays[2].values.end(), {v.x, v.y, v.z});
    }
    if (g.groups.process) arrays[3].values.resize(g.owned);  // without the ghosts
    io::write_points(fmt::format("{}/vtk/failed_rank_{}.vtp", folder, simulation.comm().rank()),
                     std::span(g.position.values).first(g.owned), arrays);
}

std::vector<std::string> run_warnings(Simulation& simulation, std::vector<std::string> warnings)
{
    auto& watch = simulation.engine().watch();
    double const overlap = simulation.comm().max(watch.largest_overlap);
    long const steps = simulation.comm().max(watch.warned_overlaps);
    if (steps > 0)
        warnings.push_back(
            fmt::format("overlaps above 10 % of a radius on {} granule steps (largest {:.1f} %): granules are "
                        "soft for the speeds met; a larger contact.youngs_modulus hardens them",
                        steps, 100 * overlap));
    if (simulation.unconverged_steps() > 0)
        warnings.push_back(
            fmt::format("the pressure missed its tolerance on {} of {} gas steps: the ledgers hold, but the gas "
                        "velocity of these steps is in doubt; a smaller time.gas_step helps",
                        simulation.unconverged_steps(), simulation.steps()));
    return warnings;
}
}

base::Exit run(ResolvedCase const& resolved, RunOptions const& options, par::Communicator const& comm)
{
    auto const start = Clock::now();
    bool const root = comm.root();
    Case data = resolved.data;
    double const end = options.until ? *options.until : data.time.duration;
    auto log = std::make_shared<spdlog::logger>("run");
    if (root) {
        std::filesystem::create_directories(options.folder);
        write_case(options.folder, resolved);
        log->sinks().push_back(
            std::make_shared<spdlog::sinks::basic_file_sink_mt>(options.folder + "/granum.log", true));
        log->flush_on(spdlog::level::info);
        log->info("{} on {} ranks, {} s of process", data.title, comm.size(), end);
        for (auto const& warning : resolved.warnings) log->warn("{}", warning);
    }
    install_stop_signals();

    Simulation simulation(data, comm);
    Output output(options.folder, simulation);
    if (root)
        log->info("{} parcels, granule step {:.3g} s, set up in {:.1f} s", simulation.data().granules.parcels,
                  simulation.granule_dt(), seconds_since(start));
    LiveLine live(root && !options.quiet, end);
    auto const& time = data.time;
    double next_sample = 0, next_picture = 0, sampled = -1, pictured = -1;
    bool stopped = false;
    // The summary is there from the first picture on, so that a run that is killed, or still going, can be reported.
    auto const save_summary = [&](std::string const& ended) {
        Performance performance;
        performance.wall = seconds_since(start);
        for (std::size_t s = 0; s < performance.seconds.size(); ++s) {
            auto const stage = static_cast<base::Stage>(s);
            performance.seconds[s] =
                simulation.stopwatch().seconds(stage) + simulation.engine().stopwatch().seconds(stage);
        }
        comm.sum(performance.seconds);
        performance.granule_steps = simulation.granule_steps();
        performance.state_hash = state_hash(simulation.granules(), comm);
        auto warnings = run_warnings(simulation, resolved.warnings);
        if (root)
            write_text(options.folder + "/summary.json",
                       summary(simulation, output, performance, warnings, ended) + "\n");
        return warnings;
    };
    auto const look = [&](bool last) {
        auto const scope = simulation.stopwatch().time(base::Stage::output);
        double const now = simulation.time();
        if (now >= next_sample * (1 - 1e-12) || (last && sampled < now)) {
            output.sample();
            sampled = now;
            next_sample = now + time.series_interval;
            if (root) live.update(simulation, output.samples().back());
        }
        if (now >= next_picture * (1 - 1e-12) || (last && pictured < now)) {
            output.events();
            output.picture();
            save_summary("running");
            pictured = now;
            next_picture = now + time.output_interval;
        }
    };
    look(false);
    while (simulation.time() < end * (1 - 1e-12)) {
        stopped = comm.max(stop_requested() ? 1L : 0L) > 0;
        if (stopped) break;
        double const goal = std::min({end, next_sample, next_picture});
        try {
            simulation.step(goal - simulation.time());
        } catch (base::NumericsError const& error) {
            live.end();
            log->error("{}", error.what());
            write_failed_state(options.folder, simulation);
            if (comm.size() == 1) save_summary("failed");  // with others it would wait for them
            throw;
        }
        look(false);
    }
    look(true);
    std::string const ended = stopped ? "stopped" : "done";
    auto const warnings = save_summary(ended);
    if (root) {
        for (std::size_t w = resolved.warnings.size(); w < warnings.size(); ++w) log->warn("{}", warnings[w]);
        log->info("{}", ended);
        live.end();
        if (!options.quiet && !options.json) {
            std::ifstream text(options.folder + "/summary.json");
            fmt::print("{}", closing_words(std::string(std::istreambuf_iterator<char>(text), {})));
        }
    }
    return stopped ? base::Exit::interrupted : base::Exit::done;
}
}
