// granum run CASE: checks the case, starts the ranks, and writes the report when they are done.
#include "verbs.hpp"

#include "cores.hpp"
#include "granum/base/error.hpp"
#include "granum/io/units.hpp"
#include "granum/report/report.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/case_reader.hpp"
#include "granum/sim/run.hpp"
#include "granum/sim/stop.hpp"
#include "launcher.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace granum::app
{
namespace
{
namespace fs = std::filesystem;

struct Wish
{
    std::string path, folder, until;
    int ranks = 0;
    bool json = false, quiet = false;
};

//! `<case>-run`, or the first `<case>-run-2`, -3 ... that is free; a folder that the user names must be free.
std::string choose_folder(Wish const& wish)
{
    if (!wish.folder.empty()) {
        bool const free = !fs::exists(wish.folder) || (fs::is_directory(wish.folder) && fs::is_empty(wish.folder));
        if (!free) throw base::CaseError({{wish.folder, 0, "", "exists already", {"choose another folder with -o"}}});
        return wish.folder;
    }
    auto const stem = fs::path(wish.path).stem().string() + "-run";
    auto folder = stem;
    for (int i = 2; fs::exists(folder); ++i) folder = fmt::format("{}-{}", stem, i);
    return folder;
}

std::optional<double> read_until(Wish const& wish)
{
    if (wish.until.empty()) return std::nullopt;
    try {
        double const until = io::read_quantity(wish.until, io::Dimension::time);
        if (until > 0) return until;
        throw base::CaseError({{"", 0, fmt::format("--until \"{}\"", wish.until), "is not above 0", {}}});
    } catch (io::QuantityError const& wrong) {
        throw base::CaseError({{"", 0, fmt::format("--until \"{}\"", wish.until), wrong.what(), {wrong.hint}}});
    }
}

//! As many ranks as there are cores, but each with at least two layers of cells of its slab.
int choose_ranks(Wish const& wish, sim::Case const& data)
{
    int const most = sim::cells(data)[0];
    if (wish.ranks > most && wish.ranks > 1)
        throw base::CaseError({{"",
                                0,
                                fmt::format("-n {}", wish.ranks),
                                "is more than the cells along x",
                                {fmt::format("allowed: 1 to {}", most)}}});
    return wish.ranks > 0 ? wish.ranks : std::clamp(cores(), 1, std::max(1, most / 2));
}

//! The simulation in this process, as a rank or alone. A failure of one rank must end all, and only once be told.
int run_here(sim::ResolvedCase const& resolved, sim::RunOptions const& options)
{
    MPI_Init(nullptr, nullptr);
    sim::install_stop_signals();
    int status = 0;
    try {
        status = static_cast<int>(sim::run(resolved, options, par::Communicator(MPI_COMM_WORLD)));
        tell_launcher(status);
    } catch (base::Error const& error) {
        status = static_cast<int>(error.exit);
        if (tell_launcher(status)) fmt::print(stderr, "granum: {}\n", error.what());
        if (started_by_launcher()) MPI_Abort(MPI_COMM_WORLD, status);
    } catch (std::exception const& error) {
        status = static_cast<int>(base::Exit::numerics);
        if (tell_launcher(status)) fmt::print(stderr, "granum: {}\n", error.what());
        if (started_by_launcher()) MPI_Abort(MPI_COMM_WORLD, status);
    }
    MPI_Finalize();
    return started_by_launcher() ? 0 : status;
}

//! False for a run that was cut off at once: its last summary is of a run still going.
bool ended(std::string const& folder)
{
    std::ifstream summary(folder + "/summary.json");
    std::string const text(std::istreambuf_iterator<char>(summary), {});
    return !text.empty() && text.find("\"ended\": \"running\"") == std::string::npos;
}

//! The report belongs to every run that left results, also to one that failed or was stopped.
void report(Wish const& wish, std::string const& folder)
{
    if (!fs::is_directory(folder)) return;
    auto const path = report::write(folder);
    if (wish.json)
        std::cout << std::ifstream(folder + "/summary.json").rdbuf();
    else if (!wish.quiet)
        fmt::print("report: {}\n", path);
}

int run(Wish const& wish)
{
    auto const resolved = sim::read_case(wish.path);
    auto const until = read_until(wish);
    if (started_by_launcher()) return run_here(resolved, {wish.folder, until, wish.json, wish.quiet});

    auto const folder = choose_folder(wish);
    int const ranks = choose_ranks(wish, resolved.data);
    if (!wish.quiet && !wish.json)
        for (auto const& warning : resolved.warnings) fmt::print(stderr, "warning: {}\n", warning);
    int status = 0;
    if (ranks == 1) {
        status = run_here(resolved, {folder, until, wish.json, wish.quiet});
    } else {
        std::vector<std::string> words{"run", wish.path, "-o", folder};
        if (!wish.until.empty()) words.insert(words.end(), {"--until", wish.until});
        if (wish.json) words.push_back("--json");
        if (wish.quiet) words.push_back("--quiet");
        std::fflush(nullptr);
        status = launch_ranks(ranks, words);
    }
    if (status == static_cast<int>(base::Exit::interrupted) && !ended(folder)) return status;
    try {
        report(wish, folder);
    } catch (std::exception const& error) {
        fmt::print(stderr, "granum: the report could not be written: {}\n", error.what());
        if (status == 0) status = static_cast<int>(base::Exit::io);
    }
    return status;
}
}

void add_run(CLI::App& program, Action& action)
{
    auto* verb = program.add_subcommand("run", "simulate a case");
    auto wish = std::make_shared<Wish>();
    verb->add_option("CASE", wish->path, "case file")->required();
    verb->add_option("-o", wish->folder, "folder of the results; otherwise <case>-run here");
    verb->add_option("-n", wish->ranks, "number of ranks; otherwise one per core")->check(CLI::Range(1, 100000));
    verb->add_option("--until", wish->until, "simulated time to stop at, e.g. \"0.5 s\"");
    verb->add_flag("--json", wish->json, "print summary.json at the end and nothing else");
    verb->add_flag("--quiet", wish->quiet, "print only errors");
    verb->callback([wish, &action] { action = [wish] { return run(*wish); }; });
}
}
