// Virtual mass of one sphere.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/force/crowd.hpp"

namespace granum::law::force
{
struct ConstantVirtualMass
{
    static constexpr base::Card card{.name = "constant",
                                     .title = "One half of the gas displaced",
                                     .source = "potential flow about a sphere; textbook",
                                     .valid = "one sphere"};

    double operator()(Crowd const&) const { return 0.5; }
};
}
