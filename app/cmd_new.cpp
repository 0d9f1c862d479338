// granum new TEMPLATE: a commented case to start from.
#include "unknown_name.hpp"
#include "verbs.hpp"

#include "granum/base/error.hpp"
#include "granum/base/type_list.hpp"
#include "templates.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace granum::app
{
namespace
{
int write_new(std::string const& wanted, std::string const& path)
{
    std::vector<std::string> names;
    for (auto const& known : templates) {
        names.emplace_back(known.name);
        if (known.name != wanted) continue;
        if (path.empty()) {
            std::fwrite(known.text.data(), 1, known.text.size(), stdout);
            return 0;
        }
        if (std::filesystem::exists(path))
            throw base::CaseError({{path, 0, "", "exists already", {"choose another name for the new case"}}});
        std::ofstream out(path);
        out << known.text;
        out.close();
        if (!out) throw base::IoError(fmt::format("{}: cannot be written", path));
        fmt::print("wrote {}; look at it, then: granum check {}\n", path, path);
        return 0;
    }
    throw unknown_name(wanted, "is not a template", names);
}
}

void add_new(CLI::App& program, Action& action)
{
    std::string known;
    for (auto const& entry : templates) known += (known.empty() ? "" : ", ") + std::string(entry.name);
    auto* verb = program.add_subcommand("new", "write a commented case: " + known);
    auto name = std::make_shared<std::string>();
    auto path = std::make_shared<std::string>();
    verb->add_option("TEMPLATE", *name, known)->required();
    verb->add_option("-o", *path, "file to write; without it, to the screen");
    verb->callback([name, path, &action] { action = [name, path] { return write_new(*name, *path); }; });
}
}
