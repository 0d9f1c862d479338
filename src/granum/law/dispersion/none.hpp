// Droplets and granules that see the mean gas only.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/dispersion/turbulence.hpp"

namespace granum::law::dispersion
{
struct NoDispersion
{
    static constexpr base::Card card{.name = "none", .title = "Left out", .source = "", .valid = "always"};

    math::Vec3 operator()(Eddy&, Turbulence const&, double, math::Vec3 const&) const { return {}; }
};
}
