// Heat transfer in random arrays of spheres, from runs that resolve the flow between them.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/heat/flow.hpp"

namespace granum::law::heat
{
struct Sun
{
    static constexpr base::Card card{
        .name = "sun",
        .title = "Sun, Tenneti and Subramaniam",
        .source = "Sun, Tenneti, Subramaniam, Int. J. Heat Mass Transfer 86 (2015) 898 (recalled)",
        .valid = "solid fraction 0.1 to 0.5, Reynolds number up to 100; not for one sphere"};

    double operator()(Flow const& flow) const
    {
        double const eps = flow.eps();
        return (-0.46 + 1.77 * eps + 0.69 * eps * eps) / (eps * eps * eps) +
               (1.37 - 2.4 * eps + 1.2 * eps * eps) * std::pow(flow.re(), 0.7) * std::cbrt(flow.prandtl);
    }
};
}
