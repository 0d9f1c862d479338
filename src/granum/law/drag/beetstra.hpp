// Drag in random arrays of equal spheres, fitted to lattice-Boltzmann results up to Reynolds numbers of 1000.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/drag/flow.hpp"

#include <cmath>

namespace granum::law::drag
{
struct Beetstra
{
    static constexpr base::Card card{.name = "beetstra",
                                     .title = "Beetstra, van der Hoef and Kuipers",
                                     .source = "Beetstra, van der Hoef, Kuipers, AIChE J. 53 (2007) 489",
                                     .valid = "solid fraction 0.1 to 0.6, Reynolds number up to 1000"};

    double operator()(Flow const& flow) const
    {
        double const phi = flow.phi(), eps = flow.eps(), re = flow.re();
        double const creeping = 10 * phi / (eps * eps) + eps * eps * (1 + 1.5 * std::sqrt(phi));
        if (re <= 0) return creeping;  // the inertial part vanishes with Re
        double const above = re * (1 / eps + 3 * eps * phi) + 8.4 * std::pow(re, 0.657);
        double const below = 1 + std::pow(10, 3 * phi) * std::pow(re, -0.5 * (1 + 4 * phi));
        return creeping + 0.413 / (24 * eps * eps) * above / below;
    }
};
}
