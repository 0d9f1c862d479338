// The program `granum`: reads the command line and hands over to the verb.
#include "large_pages.hpp"
#include "verbs.hpp"

#include "granum/base/error.hpp"
#include "granum/base/type_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <exception>

namespace granum::app
{
namespace
{
int status(base::Exit code)
{
    return static_cast<int>(code);
}

//! Every mistake of the file that fits a screen; the rest is counted, and comes up once these are put right.
void print(base::CaseError const& error)
{
    constexpr std::size_t screen = 21;
    std::size_t lines = 0, shown = 0;
    for (auto const& mistake : error.mistakes) {
        lines += 1 + mistake.hints.size();
        if (shown > 0 && lines > screen) break;
        fmt::print(stderr, "{}\n", mistake.text());
        ++shown;
    }
    if (shown < error.mistakes.size()) fmt::print(stderr, "... and {} more\n", error.mistakes.size() - shown);
}

//! A wrong first word deserves the right one; CLI11 alone would only say that a subcommand is required.
bool is_unknown_verb(CLI::App const& program, int argc, char** argv)
{
    if (argc < 2 || argv[1][0] == '-') return false;
    std::vector<std::string> verbs;
    for (auto const* verb : program.get_subcommands({})) verbs.push_back(verb->get_name());
    if (std::find(verbs.begin(), verbs.end(), argv[1]) != verbs.end()) return false;
    std::string known;
    for (auto const& verb : verbs) known += (known.empty() ? "" : ", ") + verb;
    fmt::print(stderr, "granum: \"{}\" is not a verb\n  known: {}\n", argv[1], known);
    if (auto const near = base::nearest_name(argv[1], verbs); !near.empty())
        fmt::print(stderr, "  did you mean \"granum {}\"?\n", near);
    return true;
}

int act(Action const& action)
{
    try {
        return action();
    } catch (base::CaseError const& error) {
        print(error);
        return status(error.exit);
    } catch (base::Error const& error) {
        fmt::print(stderr, "granum: {}\n", error.what());
        return status(error.exit);
    } catch (std::exception const& error) {
        fmt::print(stderr, "granum: {}\n", error.what());
        return status(base::Exit::numerics);
    }
}
}
}

int main(int argc, char** argv)
{
    using namespace granum;
    app::use_large_pages(argv);
    CLI::App program("Granum predicts what a fluidised-bed spray granulator makes.", "granum");
    program.set_version_flag("--version", "granum " GRANUM_VERSION);
    program.require_subcommand(1);
    app::Action action;
    app::add_run(program, action);
    app::add_check(program, action);
    app::add_explain(program, action);
    app::add_balance(program, action);
    app::add_list(program, action);
    app::add_new(program, action);
    app::add_report(program, action);
    app::add_map(program, action);
    app::add_scale(program, action);
    app::add_study(program, action);
    app::add_project(program, action);
    app::add_compare(program, action);
    if (app::is_unknown_verb(program, argc, argv)) return app::status(base::Exit::usage);
    try {
        program.parse(argc, argv);
    } catch (CLI::ParseError const& error) {
        return program.exit(error) == 0 ? 0 : app::status(base::Exit::usage);
    }
    return app::act(action);
}
