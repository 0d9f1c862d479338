// What to say about a name on the command line that nobody knows: the known ones, and the nearest.
#pragma once

#include "granum/base/error.hpp"
#include "granum/base/type_list.hpp"

#include <string>
#include <vector>

namespace granum::app
{
//! The error for `wanted`, which `what` it should have been ("is not a template").
inline base::CaseError unknown_name(std::string const& wanted, std::string const& what,
                                    std::vector<std::string> const& names)
{
    base::Mistake mistake{"", 0, fmt::format("\"{}\"", wanted), what, {}};
    std::string known;
    for (auto const& name : names) known += (known.empty() ? "known: " : ", ") + name;
    mistake.hints.push_back(known);
    if (auto const near = base::nearest_name(wanted, names); !near.empty())
        mistake.hints.push_back(fmt::format("did you mean \"{}\"?", near));
    return base::CaseError({mistake});
}
}
