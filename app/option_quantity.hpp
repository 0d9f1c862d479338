// A quantity with its unit on the command line.
#pragma once

#include "granum/base/error.hpp"
#include "granum/io/units.hpp"

#include <string>

namespace granum::app
{
//! SI value of what was given to `option`, above 0. Throws base::CaseError naming the option and what was typed.
inline double option_quantity(std::string const& option, std::string const& text, io::Dimension dimension)
{
    auto const shown = fmt::format("{} \"{}\"", option, text);
    try {
        double const value = io::read_quantity(text, dimension);
        if (value > 0) return value;
        throw base::CaseError({{"", 0, shown, "is not above 0", {}}});
    } catch (io::QuantityError const& wrong) {
        throw base::CaseError({{"", 0, shown, wrong.what(), {wrong.hint}}});
    }
}
}
