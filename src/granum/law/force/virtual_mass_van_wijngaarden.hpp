// Virtual mass in a dilute crowd, to first order in the solid fraction.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/force/crowd.hpp"

namespace granum::law::force
{
struct VanWijngaarden
{
    static constexpr base::Card card{.name = "van-wijngaarden",
                                     .title = "van Wijngaarden",
                                     .source = "van Wijngaarden, J. Fluid Mech. 77 (1976) 27 (recalled)",
                                     .valid = "solid fraction far below 1"};

    double operator()(Crowd const& crowd) const { return 0.5 * (1 + 2.78 * crowd.phi()); }
};
}
