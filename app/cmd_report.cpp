// granum report RUN: writes report.html from what is in a run folder, however its run ended.
#include "verbs.hpp"

#include "granum/base/error.hpp"
#include "granum/report/report.hpp"

#include <fmt/core.h>

#include <filesystem>

namespace granum::app
{
void add_report(CLI::App& program, Action& action)
{
    auto* verb = program.add_subcommand("report", "write the report of a run folder");
    auto folder = std::make_shared<std::string>();
    verb->add_option("RUN", *folder, "run folder")->required();
    verb->callback([folder, &action] {
        action = [folder] {
            if (!std::filesystem::is_directory(*folder))
                throw base::CaseError({{*folder, 0, "", "there is no such run folder", {}}});
            fmt::print("report: {}\n", report::write(*folder));
            return 0;
        };
    });
}
}
