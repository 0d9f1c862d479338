#include "granum/sim/run.hpp"

#include "granum/base/bandwidth.hpp"
#include "granum/io/checkpoint.hpp"
#include "granum/io/folder_lock.hpp"
#include "granum/sim/case_reader.hpp"
#include "granum/sim/continuation.hpp"
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
#include <cstring>
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

//! When checkpoints are due by the wall clock: the first after two minutes, or sooner where the interval is shorter.
class WallClock
{
  public:
    explicit WallClock(double interval) : interval_(interval), due_(std::min(120.0, interval)) {}
    bool due() const { return seconds_since(start_) >= due_; }
    void written() { due_ = seconds_since(start_) + interval_; }

  private:
    Clock::time_point start_ = Clock::now();
    double interval_, due_;
};

//! When the next row, picture and checkpoint are due, in simulated time, and the wall time of the legs before.
struct Schedule
{
    double next_sample = 0, next_picture = 0, sampled = -1, pictured = -1, next_checkpoint = 0, wall = 0;
};

//! The state at the moment of a failure, for whoever looks for its cause: complete where all ranks still answer.
void write_failed_state(std::string const& folder, Simulation& simulation, io::CheckpointLabel const& label,
                        bool all_here)
{
    auto const path = folder + "/checkpoint/failed";
    try {
        if (all_here) {
            io::CheckpointFolder(path, simulation.comm()).write(label, simulation.save());
        } else {
            std::filesystem::create_directories(path);
            io::write_sections(io::SystemCalls::real(), fmt::format("{}/rank_{:05d}", path, simulation.comm().rank()),
                               simulation.save());
        }
    } catch (std::exception const&) {
        // The failure itself is what is told; a state that cannot be written any more must not hide it.
    }
}

std::vector<std::string> run_warnings(Simulation& simulation, std::vector<std::string> warnings)
{
    auto& watch = simulation.mover().watch();
    double const overlap = simulation.comm().max(watch.largest_overlap);
    long const steps = simulation.comm().max(watch.warned_overlaps);
    if (steps > 0)
        warnings.push_back(
            fmt::format("overlaps above 10 % of a radius on {} granule steps (largest {:.1f} %): granules are "
                        "soft for the speeds met; a larger contact.youngs_modulus hardens them",
                        steps, 100 * overlap));
    if (long const late = simulation.comm().max(watch.late_lists); late > 0)
        warnings.push_back(
            fmt::format("granules got so fast within a few steps that contacts may have been seen late, {} times: a "
                        "shorter time.granule_step helps",
                        late));
    if (auto const& settling = simulation.settling(); settling.end > 0 && !settling.enough)
        warnings.push_back(fmt::format(
            "what is wet in the bed had not settled in the {:.3g} s of start.settling: the bed may be too warm or "
            "too cold; a longer start.settling helps",
            settling.end));
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
    install_stop_signals();

    std::optional<io::FolderLock> lock;  // ranks of a run that was killed may still be on their way out
    std::string refused;
    if (root) {
        try {
            std::filesystem::create_directories(options.folder + "/checkpoint");
            lock.emplace(options.folder + "/checkpoint", 20);
        } catch (std::exception const& error) {
            refused = error.what();
        }
    }
    if (comm.max(refused.empty() ? 0L : 1L) > 0)
        throw base::IoError(root ? refused : "stopped: rank 0 cannot use the folder");
    io::CheckpointFolder const checkpoints(options.folder + "/checkpoint", comm);
    std::optional<io::Checkpoint> found;
    std::vector<std::string> passed_over;
    if (options.go_on) {
        checkpoints.sweep();
        found = checkpoints.newest(passed_over);
    }
    auto log = std::make_shared<spdlog::logger>("run");
    if (root) {
        std::filesystem::create_directories(options.folder);
        remember_case(options.folder, resolved);
        write_case(options.folder, resolved);
        log->sinks().push_back(
            std::make_shared<spdlog::sinks::basic_file_sink_mt>(options.folder + "/granum.log", !options.go_on));
        log->flush_on(spdlog::level::info);
        log->info("{} on {} ranks, {} s of process", data.title, comm.size(), end);
        for (auto const& warning : resolved.warnings) log->warn("{}", warning);
        for (auto const& reason : passed_over) log->warn("{}", reason);
        auto const begin =
            found ? fmt::format("continues from checkpoint {:06d} at {:.6g} s", found->number, found->label.time)
                  : std::string("no checkpoint yet: begins at 0 s");
        if (options.go_on) {
            log->info("{}", begin);
            if (!options.quiet && !options.json) {
                for (auto const& reason : passed_over) fmt::print(stderr, "warning: {}\n", reason);
                fmt::print(stderr, "{}\n", begin);
            }
        }
    }
    comm.barrier();

    io::Sections const written = found && root ? found->read(0) : io::Sections{};
    if (found && root) Output::check(written);
    Simulation simulation(data, comm, found ? &*found : nullptr);
    Output output(options.folder, simulation, found ? &written : nullptr);
    Schedule schedule;
    if (found) {
        std::vector<Schedule> all;
        if (root) all = io::values_of<Schedule>(io::find_section(written, "schedule"));
        std::vector<std::byte> bytes(all.size() * sizeof(Schedule));
        if (root) std::memcpy(bytes.data(), all.data(), bytes.size());
        comm.broadcast(bytes);
        if (bytes.size() != sizeof schedule) throw base::IoError("a checkpoint without a schedule");
        std::memcpy(&schedule, bytes.data(), sizeof schedule);
        output.look_at_granules();
    }
    if (root)
        log->info("{} parcels, granule step {:.3g} s, set up in {:.1f} s", simulation.data().granules.parcels,
                  simulation.granule_dt(), seconds_since(start));
    LiveLine live(root && !options.quiet, end);
    auto const& time = data.time;
    WallClock wall_clock(time.checkpoint_interval);
    bool stopped = false;
    // The summary is there from the first picture on, so that a run that is killed, or still going, can be reported.
    auto const save_summary = [&](std::string const& ended) {
        Performance performance;
        performance.wall = schedule.wall + seconds_since(start);
        for (std::size_t s = 0; s < performance.seconds.size(); ++s) {
            auto const stage = static_cast<base::Stage>(s);
            performance.seconds[s] =
                simulation.stopwatch().seconds(stage) + simulation.mover().stopwatch().seconds(stage);
        }
        comm.sum(performance.seconds);
        performance.granule_steps = simulation.granule_steps();
        performance.lists = simulation.mover().watch().rebuilds;
        if (simulation.has_gas()) performance.heat = simulation.heat();
        auto const& gas = simulation.gas_work();
        std::array<double, 4> work{gas.cell_steps, gas.bytes, gas.iterations, gas.sweeps};
        comm.sum(work);
        performance.gas = {work[0], work[1], work[2], work[3]};
        if (simulation.has_gas() && ended == "done") performance.triad_rate = -comm.max(-base::Triad().rate());
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
        if (now >= schedule.next_sample * (1 - 1e-12) || (last && schedule.sampled < now)) {
            output.sample();
            schedule.sampled = now;
            schedule.next_sample = now + time.series_interval;
            if (root) live.update(simulation, output.samples().back());
        }
        if (now >= schedule.next_picture * (1 - 1e-12) || (last && schedule.pictured < now)) {
            output.events();
            output.picture();
            save_summary("running");
            schedule.pictured = now;
            schedule.next_picture = now + time.output_interval;
        }
    };
    auto const label = [&] {
        return io::CheckpointLabel{options.program, case_hash(resolved), simulation.time(), simulation.steps(), 0};
    };
    double checkpointed = found ? found->label.time : -1;
    auto const checkpoint = [&] {
        auto const scope = simulation.stopwatch().time(base::Stage::output);
        auto const begin = Clock::now();
        auto sections = simulation.save();
        for (auto& section : output.save()) sections.push_back(std::move(section));
        auto saved = schedule;
        saved.wall += seconds_since(start);
        sections.push_back(io::section_of("schedule", std::vector<Schedule>{saved}));
        double bytes = 0;
        for (auto const& section : sections) bytes += static_cast<double>(section.bytes.size());
        int const number = checkpoints.write(label(), sections);
        bytes = comm.sum(bytes);
        if (root)
            log->info("checkpoint {:06d} at {:.6g} s: {:.1f} MB in {:.2f} s", number, simulation.time(), 1e-6 * bytes,
                      seconds_since(begin));
        checkpointed = simulation.time();
        wall_clock.written();
    };
    try {
        look(false);
        while (simulation.time() < end * (1 - 1e-12)) {
            long const wish = comm.max(stop_requested()                                       ? 2L
                                       : checkpoint_requested() || (root && wall_clock.due()) ? 1L
                                                                                              : 0L);
            stopped = wish == 2;
            if (stopped) break;
            bool const due = time.checkpoint_every && simulation.time() >= schedule.next_checkpoint * (1 - 1e-12);
            if (due) schedule.next_checkpoint = simulation.time() + *time.checkpoint_every;
            if (wish == 1 || (due && simulation.time() > 0)) checkpoint();
            // Goals are the same whether or not a run ends on one of them, so that a run in two legs has the same
            // steps.
            double goal = std::min(schedule.next_sample, schedule.next_picture);
            if (end < goal * (1 - 1e-12)) goal = end;
            simulation.step(goal - simulation.time());
            look(false);
        }
        if (checkpointed != simulation.time()) checkpoint();
        look(true);
    } catch (base::Error const& error) {
        live.end();
        log->error("{}", error.what());
        bool const all_here = comm.meet(5);
        if (error.exit == base::Exit::numerics) write_failed_state(options.folder, simulation, label(), all_here);
        try {
            if (all_here) save_summary("failed");
        } catch (base::Error const&) {
            // A full disk or a state that cannot be summed up: whoever started the ranks marks the summary.
        }
        throw;
    }
    std::string const ended = stopped ? "stopped" : "done";
    auto const warnings = save_summary(ended);
    if (root) {
        for (std::size_t w = resolved.warnings.size(); w < warnings.size(); ++w) log->warn("{}", warnings[w]);
        log->info("{}", ended);
        live.end();
        if (!options.quiet && !options.json) {
            std::ifstream text(options.folder + "/summary.json");
            fmt::print("{}", closing_words(std::string(std::istreambuf_iterator<char>(text), {})));
            if (stopped) fmt::print("to continue: granum run {}\n", options.folder);
        }
    }
    return stopped ? base::Exit::interrupted : base::Exit::done;
}
}
