// granum explain CASE: every value of the case and where it came from.
#include "verbs.hpp"

#include "granum/sim/case_reader.hpp"

#include <fmt/core.h>

namespace granum::app
{
void add_explain(CLI::App& program, Action& action)
{
    auto* verb = program.add_subcommand("explain", "print every value of a case with its origin");
    auto path = std::make_shared<std::string>();
    verb->add_option("CASE", *path, "case file")->required();
    verb->callback([path, &action] {
        action = [path] {
            fmt::print("{}", sim::explain(sim::read_case(*path)));
            return 0;
        };
    });
}
}
