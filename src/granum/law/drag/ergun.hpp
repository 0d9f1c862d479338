// Drag in packed beds, from their pressure drop.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/drag/flow.hpp"

namespace granum::law::drag
{
struct Ergun
{
    static constexpr base::Card card{.name = "ergun",
                                     .title = "Ergun",
                                     .source = "Ergun, Chem. Eng. Prog. 48 (1952) 89",
                                     .valid = "packed beds, voidage below 0.8; vanishes with the solid fraction"};

    double operator()(Flow const& flow) const
    {
        double const eps = flow.eps();
        return (150 * flow.phi() + 1.75 * flow.re()) / (18 * eps * eps);
    }
};
}
