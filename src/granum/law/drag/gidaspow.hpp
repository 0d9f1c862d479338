// Ergun's drag in the dense bed, Wen and Yu's in the dilute one, joined smoothly about a voidage of 0.8.
//
// The two laws differ by a large factor there (17.8 against 10.3 at Re = 100), so a sharp switch would jump.
#pragma once

#include "granum/law/drag/ergun.hpp"
#include "granum/law/drag/wen_yu.hpp"
#include "granum/math/constants.hpp"

namespace granum::law::drag
{
struct Gidaspow
{
    static constexpr base::Card card{.name = "gidaspow",
                                     .title = "Gidaspow, with the blend of Huilin and Gidaspow",
                                     .source =
                                         "Gidaspow, Multiphase Flow and Fluidization (1994); Huilin, Gidaspow, "
                                         "Chem. Eng. Sci. 58 (2003) 3777 (recalled)",
                                     .valid = "all voidages"};

    double operator()(Flow const& flow) const
    {
        double const dilute = std::atan(262.5 * (flow.eps() - 0.8)) / math::pi + 0.5;
        return dilute * WenYu{}(flow) + (1 - dilute) * Ergun{}(flow);
    }
};
}
