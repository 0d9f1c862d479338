// granum run CASE: checks the case, starts the ranks, and writes the report when they are done.
#include "verbs.hpp"

#include "cores.hpp"
#include "granum/base/error.hpp"
#include "granum/io/folder_lock.hpp"
#include "granum/report/report.hpp"
#include "granum/sim/case_reader.hpp"
#include "granum/sim/continuation.hpp"
#include "granum/sim/run.hpp"
#include "granum/sim/stop.hpp"
#include "launcher.hpp"
#include "option_quantity.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace granum::app
{
namespace
{
namespace fs = std::filesystem;

constexpr char const* go_on_word = "GRANUM_GO_ON";  // from the program to its ranks

struct Wish
{
    std::string path, folder, until;
    int ranks = 0;
    bool json = false, quiet = false, fresh = false;
};

//! Where the results go, and whether a run that is there goes on.
struct Place
{
    std::string folder;
    bool go_on = false;
};

//! A folder that the user names must be free, or hold a run of this case; otherwise `<case>-run`, or the first
//! `<case>-run-2`, -3 ... that is free.
Place choose_place(Wish const& wish, sim::ResolvedCase const& resolved)
{
    if (wish.folder.empty()) {
        auto const stem = fs::path(wish.path).stem().string() + "-run";
        auto folder = stem;
        for (int i = 2; fs::exists(folder); ++i) folder = fmt::format("{}-{}", stem, i);
        return {folder, false};
    }
    auto const& folder = wish.folder;
    if (!fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder))) return {folder, false};
    if (!sim::is_run_folder(folder))
        throw base::CaseError(
            {{folder, 0, "", "exists already and holds no run to go on with", {"choose another folder with -o"}}});
    if (wish.fresh) {
        io::FolderLock const nobody_at_work(folder + "/checkpoint", 0);
        fs::remove_all(folder + "/checkpoint");
        fs::remove_all(folder + "/vtk");
        fs::remove(folder + "/summary.json");
        return {folder, false};
    }
    sim::refuse_other_case(folder, resolved);
    return {folder, true};
}

std::optional<double> read_until(Wish const& wish)
{
    if (wish.until.empty()) return std::nullopt;
    return option_quantity("--until", wish.until, io::Dimension::time);
}

//! As many ranks as there are cores, but each with at least two layers of cells of its slab or, without gas, with
//! enough granules to be worth its messages.
int choose_ranks(Wish const& wish, sim::ResolvedCase const& resolved)
{
    constexpr long worth_a_rank = 500;
    auto const& data = resolved.data;
    if (data.contact.hard()) {
        if (wish.ranks <= 1) return 1;
        int line = 0;
        for (auto const& origin : resolved.origins)
            if (origin.key == "contact.engine" && origin.origin.starts_with("line "))
                line = std::atoi(origin.origin.c_str() + 5);
        throw base::CaseError({{data.file,
                                line,
                                "contact.engine = \"hard\"",
                                fmt::format("runs on one rank, not on -n {}", wish.ranks),
                                {"leave -n out, or choose contact.engine = \"soft\""}}});
    }
    if (!data.gas.present) {
        if (wish.ranks > 0) return wish.ranks;
        long const parcels = std::max(data.granules.parcels, static_cast<long>(data.granules.given.size()));
        return static_cast<int>(std::clamp(parcels / worth_a_rank, 1L, static_cast<long>(cores())));
    }
    int const most = data.gas.cells[0];
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

//! What the user was told when the run began is told again: the folder is the case.
Wish of_folder(Wish wish)
{
    if (!fs::is_directory(wish.path)) return wish;
    if (!sim::is_run_folder(wish.path))
        throw base::CaseError({{wish.path, 0, "", "is a folder without a run to go on with", {"give a case file"}}});
    if (!wish.folder.empty() && !fs::equivalent(wish.folder, wish.path))
        throw base::CaseError({{wish.path, 0, "", "goes on in its own folder", {"leave out -o " + wish.folder}}});
    wish.folder = wish.path;
    wish.path = sim::case_file_of(wish.folder);
    return wish;
}

int launch(Wish const& wish, Place const& place, int ranks)
{
    std::vector<std::string> words{"run", wish.path, "-o", place.folder};
    if (!wish.until.empty()) words.insert(words.end(), {"--until", wish.until});
    if (wish.json) words.push_back("--json");
    if (wish.quiet) words.push_back("--quiet");
    setenv(go_on_word, place.go_on ? "1" : "0", 1);
    std::fflush(nullptr);
    // A rank that was killed, or left the others waiting, could not say so in the summary.
    try {
        int const status = launch_ranks(ranks, words);
        if (status != 0) sim::mark_failed(place.folder);
        return status;
    } catch (base::Error const&) {
        sim::mark_failed(place.folder);
        throw;
    }
}

int run(Wish const& asked)
{
    auto const wish = of_folder(asked);
    auto const resolved = sim::read_case(wish.path);
    auto const until = read_until(wish);
    sim::RunOptions options{.folder = wish.folder, .until = until, .json = wish.json, .quiet = wish.quiet};
    options.program = GRANUM_VERSION;
    if (started_by_launcher()) {
        auto const* word = std::getenv(go_on_word);
        options.go_on = word && std::string(word) == "1";
        return run_here(resolved, options);
    }

    auto const place = choose_place(wish, resolved);
    if (place.go_on && sim::is_done(place.folder, until.value_or(resolved.data.time.duration))) {
        if (wish.json)
            std::cout << std::ifstream(place.folder + "/summary.json").rdbuf();
        else if (!wish.quiet)
            fmt::print("{} is done; a longer time.duration or --until goes on, --fresh begins anew\n", place.folder);
        return 0;
    }
    options.folder = place.folder, options.go_on = place.go_on;
    int const ranks = choose_ranks(wish, resolved);
    if (!wish.quiet && !wish.json)
        for (auto const& warning : resolved.warnings) fmt::print(stderr, "warning: {}\n", warning);
    int status = ranks == 1 ? run_here(resolved, options) : launch(wish, place, ranks);
    if (status == static_cast<int>(base::Exit::interrupted) && !ended(place.folder)) return status;
    try {
        report(wish, place.folder);
    } catch (std::exception const& error) {
        fmt::print(stderr, "granum: the report could not be written: {}\n", error.what());
        if (status == 0) status = static_cast<int>(base::Exit::io);
    }
    return status;
}
}

int run_case(std::string const& file, std::string const& folder, double until, int ranks)
{
    Wish const wish{
        .path = file, .folder = folder, .until = fmt::format("{:.9g} s", until), .ranks = ranks, .quiet = true};
    auto const resolved = sim::read_case(file);
    auto const place = choose_place(wish, resolved);
    // Always in processes of their own, one rank too: MPI starts only once in a process.
    int const status = launch(wish, place, choose_ranks(wish, resolved));
    if (status == static_cast<int>(base::Exit::interrupted) && !ended(place.folder)) return status;
    report(wish, place.folder);
    return status;
}

void add_run(CLI::App& program, Action& action)
{
    auto* verb = program.add_subcommand("run", "simulate a case");
    auto wish = std::make_shared<Wish>();
    verb->add_option("CASE", wish->path, "case file, or the folder of a run to go on with")->required();
    verb->add_option("-o", wish->folder,
                     "folder of the results, where a run of this case goes on; otherwise a new <case>-run here");
    verb->add_option("-n", wish->ranks, "number of ranks; otherwise one per core")->check(CLI::Range(1, 100000));
    verb->add_option("--until", wish->until, "simulated time to stop at, e.g. \"0.5 s\"");
    verb->add_flag("--fresh", wish->fresh, "discard the run in the folder and begin anew");
    verb->add_flag("--json", wish->json, "print summary.json at the end and nothing else");
    verb->add_flag("--quiet", wish->quiet, "print only errors");
    verb->callback([wish, &action] { action = [wish] { return run(*wish); }; });
}
}
