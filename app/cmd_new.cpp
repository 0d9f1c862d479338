// granum new TEMPLATE: a commented case to start from.
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
    base::Mistake mistake{"", 0, fmt::format("\"{}\"", wanted), "is not a template", {}};
    std::string known;
    for (auto const& name : names) known += (known.empty() ? "known: " : ", ") + name;
    mistake.hints.push_back(known);
    if (auto const near = base::nearest_name(wanted, names); !near.empty())
        mistake.hints.push_back(fmt::format("did you mean \"{}\"?", near));
    throw base::CaseError({mistake});
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
