// No model: the cells resolve the flow, or it is laminar.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/turbulence/local.hpp"

namespace granum::law::turbulence
{
struct Laminar
{
    static constexpr base::Card card{.name = "laminar",
                                     .title = "No model",
                                     .source = "",
                                     .valid = "laminar flow, or cells that resolve all eddies"};
    static constexpr bool transports = false;

    template <class Visit>
    void each_constant(Visit&&)
    {
    }

    double operator()(Local const&) const { return 0; }
};
}
