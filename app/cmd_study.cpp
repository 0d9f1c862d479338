// granum study STUDY: runs a campaign of operating points, each until its statistics are good enough.
#include "verbs.hpp"

#include "granum/base/error.hpp"
#include "granum/study/study.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <filesystem>

namespace granum::app
{
void add_study(CLI::App& program, Action& action)
{
    struct Wish
    {
        std::string path, folder;
        int ranks = 0;
    };
    auto* verb = program.add_subcommand("study", "run a campaign of operating points; goes on where it was");
    auto wish = std::make_shared<Wish>();
    verb->add_option("STUDY", wish->path, "file of the study")->required();
    verb->add_option("-o,--output", wish->folder, "folder of the campaign (default: STUDY without its ending)");
    verb->add_option("-n,--ranks", wish->ranks, "ranks of each run (default: as granum run chooses)")
        ->check(CLI::Range(1, 1024));
    verb->callback([wish, &action] {
        action = [wish] {
            namespace fs = std::filesystem;
            auto const study = study::read_study(wish->path);
            auto const folder =
                wish->folder.empty() ? fs::path(wish->path).replace_extension("").string() : wish->folder;
            auto const runner = [&](std::string const& file, std::string const& place, double until) {
                return run_case(file, place, until, wish->ranks);
            };
            auto const said = [](std::string const& line) {
                fmt::print("{}\n", line);
                std::fflush(stdout);
            };
            auto const outcomes = study::run(study, folder, runner, said);
            if (outcomes.empty()) return static_cast<int>(base::Exit::interrupted);
            study::write(study, outcomes, folder);
            fmt::print("{} of {} points: {}/study.csv, {}/study.html\n", outcomes.size(), study.points.size(), folder,
                       folder);
            return outcomes.size() == study.points.size() ? 0 : static_cast<int>(base::Exit::interrupted);
        };
    });
}
}
