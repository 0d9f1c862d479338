// Contacts that pass no heat.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/conduction/touch.hpp"

namespace granum::law::conduction
{
struct NoConduction
{
    static constexpr base::Card card{.name = "none", .title = "No conduction", .source = "", .valid = "always"};

    double operator()(Touch const&) const { return 0; }
};
}
