// What collisions rub off the layers of granules.
#pragma once

#include "granum/base/type_list.hpp"

namespace granum::law::layer
{
struct NoAbrasion
{
    static constexpr base::Card card{.name = "none", .title = "layers do not wear", .source = "", .valid = ""};

    double operator()(double) const { return 0; }
};

//! Proportional to what collisions dissipate in a granule beyond a threshold each, as wear to work in Archard's law.
struct CollisionEnergy
{
    static constexpr base::Card card{.name = "collision-energy",
                                     .title = "proportional to dissipated energy above a threshold",
                                     .source = "after Archard, J. Appl. Phys. 24 (1953) 981 (recalled)",
                                     .valid = "coefficient and threshold from an attrition test of the product"};

    double coefficient = 0;  //!< kg of layer per J

    //! Share of the granule's mass that it loses from its layer for `dissipated`, J per kg of granule beyond the
    //! thresholds of its collisions (dem::Settings::wear_threshold).
    double operator()(double dissipated) const { return coefficient * dissipated; }
};

using Abrasion = base::TypeList<NoAbrasion, CollisionEnergy>;
using AnyAbrasion = Abrasion::Any;
}
