// Drag in random arrays of equal spheres, from runs that resolve the flow between them.
//
// It lies far below all other laws for phi >= 0.5 and Re >= 100, so it is not a default. Its polynomial falls and turns
// negative far above its range; beyond Re = 1000 the inertial part grows in proportion to Re instead.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/drag/flow.hpp"

#include <cmath>

namespace granum::law::drag
{
struct Tang
{
    static constexpr base::Card card{.name = "tang",
                                     .title = "Tang, Peters, Kuipers, Kriebitzsch and van der Hoef",
                                     .source = "Tang et al., AIChE J. 61 (2015) 688",
                                     .valid = "solid fraction up to 0.6, Reynolds number up to 1000"};

    double operator()(Flow const& flow) const
    {
        double const phi = flow.phi(), eps = flow.eps(), re = flow.re();
        double const eps2 = eps * eps, eps4 = eps2 * eps2;
        double const creeping = 10 * phi / eps2 + eps2 * (1 + 1.5 * std::sqrt(phi));
        double const fitted = std::min(re, 1000.0);
        if (fitted <= 0) return creeping;
        double const slope =
            0.11 * phi * (1 + phi) - 0.00456 / eps4 + (0.169 * eps + 0.0644 / eps4) * std::pow(fitted, -0.343);
        return creeping + slope * re;
    }
};
}
