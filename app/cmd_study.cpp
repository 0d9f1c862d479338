// granum study STUDY: runs a campaign of operating points, each until its statistics are good enough.
#include "verbs.hpp"

#include "cores.hpp"
#include "granum/base/error.hpp"
#include "granum/study/study.hpp"

#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace granum::app
{
void add_study(CLI::App& program, Action& action)
{
    struct Wish
    {
        std::string path, folder;
        int ranks = 0, jobs = 0;
    };
    auto* verb = program.add_subcommand("study", "run a campaign of operating points; goes on where it was");
    auto wish = std::make_shared<Wish>();
    verb->add_option("STUDY", wish->path, "file of the study")->required();
    verb->add_option("-o,--output", wish->folder, "folder of the campaign (default: STUDY without its ending)");
    verb->add_option("-n,--ranks", wish->ranks, "ranks of each run (default: cores over jobs)")
        ->check(CLI::Range(1, 1024));
    verb->add_option("-j,--jobs", wish->jobs, "points that run beside each other (default: as many as cores have room)")
        ->check(CLI::Range(1, 1024));
    verb->callback([wish, &action] {
        action = [wish] {
            namespace fs = std::filesystem;
            auto const study = study::read_study(wish->path);
            auto const folder =
                wish->folder.empty() ? fs::path(wish->path).replace_extension("").string() : wish->folder;
            auto const points = static_cast<int>(study.points.size());
            int const jobs =
                std::min(points, wish->jobs > 0 ? wish->jobs : std::max(1, cores() / std::max(1, wish->ranks)));
            int const ranks = wish->ranks > 0 ? wish->ranks : std::max(1, cores() / jobs);
            auto const runner = [&](std::string const& file, std::string const& place, double until) {
                return run_case(file, place, until, ranks);
            };
            auto const said = [](std::string const& line) {
                fmt::print("{}\n", line);
                std::fflush(stdout);
            };
            study::write_cases(study, folder);
            // Others like this one take points that nobody is at.
            std::vector<pid_t> others;
            for (int k = 1; k < jobs; ++k) {
                pid_t const other = fork();
                if (other < 0) throw base::IoError(fmt::format("cannot start a process: {}", std::strerror(errno)));
                if (other == 0) {
                    prctl(PR_SET_PDEATHSIG, SIGTERM);
                    return study::run(study, folder, runner, said).stopped ? static_cast<int>(base::Exit::interrupted)
                                                                           : 0;
                }
                others.push_back(other);
            }
            auto campaign = study::run(study, folder, runner, said);
            for (pid_t const other : others)
                if (campaign.stopped) kill(other, SIGTERM);
            int failed = 0;
            for (pid_t const other : others) {
                int status = 0;
                while (waitpid(other, &status, 0) < 0 && errno == EINTR) {
                }
                campaign.stopped = campaign.stopped || WEXITSTATUS(status) == static_cast<int>(base::Exit::interrupted);
                if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
                    failed = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
            }
            if (!others.empty() && !campaign.stopped && failed == 0)
                campaign = study::run(study, folder, runner, [](std::string const&) {});
            auto const& outcomes = campaign.outcomes;
            if (outcomes.empty()) return static_cast<int>(base::Exit::interrupted);
            study::write(study, outcomes, folder);
            fmt::print("{} of {} points: {}/study.csv, {}/study.html\n", outcomes.size(), study.points.size(), folder,
                       folder);
            if (failed != 0) return failed;
            return outcomes.size() == study.points.size() ? 0 : static_cast<int>(base::Exit::interrupted);
        };
    });
}
}
