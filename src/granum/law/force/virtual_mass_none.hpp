// Granules that need not push gas aside when they speed up.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/force/crowd.hpp"

namespace granum::law::force
{
struct NoVirtualMass
{
    static constexpr base::Card card{.name = "none", .title = "Left out", .source = "", .valid = "always"};

    double operator()(Crowd const&) const { return 0; }
};
}
