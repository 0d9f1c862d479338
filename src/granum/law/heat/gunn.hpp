// Heat and mass transfer in fixed and fluidised beds.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/heat/flow.hpp"

namespace granum::law::heat
{
struct Gunn
{
    static constexpr base::Card card{.name = "gunn",
                                     .title = "Gunn",
                                     .source = "Gunn, Int. J. Heat Mass Transfer 21 (1978) 467",
                                     .valid = "voidage 0.35 to 1, Reynolds number up to 1e5"};

    double operator()(Flow const& flow) const
    {
        double const eps = flow.eps(), root = std::cbrt(flow.prandtl);
        return (7 - 10 * eps + 5 * eps * eps) * (1 + 0.7 * std::pow(flow.re(), 0.2) * root) +
               (1.33 - 2.4 * eps + 1.2 * eps * eps) * std::pow(flow.re(), 0.7) * root;
    }
};
}
