// Heat and mass transfer of one sphere.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/heat/flow.hpp"

namespace granum::law::heat
{
struct RanzMarshall
{
    static constexpr base::Card card{.name = "ranz-marshall",
                                     .title = "Ranz and Marshall",
                                     .source = "Ranz, Marshall, Chem. Eng. Prog. 48 (1952) 141 (recalled)",
                                     .valid = "one sphere, Reynolds number up to 200"};

    double operator()(Flow const& flow) const { return 2 + 0.6 * std::sqrt(flow.re()) * std::cbrt(flow.prandtl); }
};
}
