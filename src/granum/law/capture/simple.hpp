// Share of the droplets in a granule's way that strike it, for potential flow about the granule.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/capture/flow.hpp"

namespace granum::law::capture
{
struct Simple
{
    static constexpr base::Card card{.name = "simple",
                                     .title = "(St / (St + 0.25))^2 at any Reynolds number",
                                     .source = "limit of the impaction formula at high Reynolds number (recalled)",
                                     .valid = "one granule, Reynolds number above 90"};

    double operator()(Flow const& flow) const
    {
        if (flow.stokes <= 0) return 0;
        double const share = flow.stokes / (flow.stokes + 0.25);
        return share * share;
    }
};
}
