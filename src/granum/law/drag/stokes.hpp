// Drag of one sphere in creeping flow.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/drag/flow.hpp"

namespace granum::law::drag
{
struct Stokes
{
    static constexpr base::Card card{.name = "stokes",
                                     .title = "Stokes",
                                     .source = "Stokes, Trans. Cambridge Phil. Soc. 9 (1851) 8 (recalled)",
                                     .valid = "one sphere, Reynolds number far below 1"};

    double operator()(Flow const&) const { return 1; }
};
}
