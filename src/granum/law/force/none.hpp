// Granules without lift or without rotational drag.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/force/motion.hpp"

namespace granum::law::force
{
struct None
{
    static constexpr base::Card card{.name = "none", .title = "Left out", .source = "", .valid = "always"};

    math::Vec3 operator()(Motion const&) const { return {}; }
};
}
