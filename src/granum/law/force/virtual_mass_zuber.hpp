// Virtual mass in a crowd, by the cell around each sphere.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/force/crowd.hpp"

namespace granum::law::force
{
struct Zuber
{
    static constexpr base::Card card{.name = "zuber",
                                     .title = "Zuber",
                                     .source = "Zuber, Chem. Eng. Sci. 19 (1964) 897 (recalled)",
                                     .valid = "solid fraction up to about 0.3"};

    double operator()(Crowd const& crowd) const { return 0.5 * (1 + 2 * crowd.phi()) / (1 - crowd.phi()); }
};
}
