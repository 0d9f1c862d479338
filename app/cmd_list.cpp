// granum list [FAMILY]: the laws, from their cards, with the key by which a case may name them.
#include "unknown_name.hpp"
#include "verbs.hpp"

#include "granum/base/error.hpp"
#include "granum/sim/law_families.hpp"

#include <fmt/core.h>

namespace granum::app
{
namespace
{
void print_family(sim::LawFamily const& family)
{
    fmt::print("{} ({}): {}\n", family.name, family.key.empty() ? "not in a case yet" : family.key, family.title);
    for (auto const& card : family.cards) {
        fmt::print("  {:<24} {}\n", card.name, card.title);
        if (!card.source.empty()) fmt::print("  {:<24}   source: {}\n", "", card.source);
        if (!card.valid.empty()) fmt::print("  {:<24}   valid: {}\n", "", card.valid);
    }
}

int list(std::string const& wanted)
{
    std::vector<std::string> names;
    for (auto const& family : sim::law_families()) {
        names.push_back(family.name);
        if (wanted.empty() || wanted == family.name) print_family(family);
        if (wanted == family.name) return 0;
    }
    if (wanted.empty()) return 0;
    throw unknown_name(wanted, "is not a family of laws", names);
}
}

void add_list(CLI::App& program, Action& action)
{
    auto* verb = program.add_subcommand("list", "show the laws to choose from");
    auto family = std::make_shared<std::string>();
    verb->add_option("FAMILY", *family, "one family only");
    verb->callback([family, &action] { action = [family] { return list(*family); }; });
}
}
