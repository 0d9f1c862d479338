// Gunn's form of heat transfer, with coefficients from runs that resolve the flow between spheres.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/heat/flow.hpp"

namespace granum::law::heat
{
struct Deen
{
    static constexpr base::Card card{.name = "deen",
                                     .title = "Gunn, refitted by Deen, Peters, Padding and Kuipers",
                                     .source = "Deen et al., Chem. Eng. Sci. 116 (2014) 710 (recalled)",
                                     .valid = "voidage 0.5 to 1, Reynolds number up to about 100 (recalled)"};

    double operator()(Flow const& flow) const
    {
        double const eps = flow.eps(), root = std::cbrt(flow.prandtl);
        return (7 - 10 * eps + 5 * eps * eps) * (1 + 0.17 * std::pow(flow.re(), 0.2) * root) +
               (1.33 - 2.31 * eps + 1.16 * eps * eps) * std::pow(flow.re(), 0.7) * root;
    }
};
}
