// Drag of one sphere, up to the fully turbulent wake.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/drag/flow.hpp"

#include <cmath>

namespace granum::law::drag
{
struct SchillerNaumann
{
    static constexpr base::Card card{.name = "schiller-naumann",
                                     .title = "Schiller and Naumann",
                                     .source = "Schiller, Naumann, Z. VDI 77 (1935) 318 (recalled)",
                                     .valid = "one sphere, Reynolds number up to 2e5"};

    double operator()(Flow const& flow) const
    {
        double const re = flow.re();
        return re <= 1000 ? 1 + 0.15 * std::pow(re, 0.687) : 0.44 * re / 24;
    }
};
}
