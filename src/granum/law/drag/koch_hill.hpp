// Drag in random arrays of equal spheres, from lattice-Boltzmann runs.
//
// Published codes differ in one coefficient, 16.14 or 17.14. With 16.14 the two branches nearly meet at phi = 0.4
// (18.33 and 18.52), with 17.14 they do not (19.24).
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/drag/flow.hpp"

#include <cmath>

namespace granum::law::drag
{
struct KochHill
{
    static constexpr base::Card card{.name = "koch-hill",
                                     .title = "Koch and Hill",
                                     .source = "Koch, Hill, Annu. Rev. Fluid Mech. 33 (2001) 619",
                                     .valid = "all voidages, Reynolds number up to 100"};

    double operator()(Flow const& flow) const
    {
        double const phi = flow.phi(), eps = flow.eps();
        double const f3 = 0.0673 + 0.212 * phi + 0.0232 / std::pow(eps, 5);
        return eps * (creeping(phi) + 0.5 * f3 * flow.re());
    }

  private:
    static double creeping(double phi)
    {
        double const eps = 1 - phi;
        if (phi <= 0) return 1;
        if (phi >= 0.4) return 10 * phi / (eps * eps * eps);
        return (1 + 3 * std::sqrt(phi / 2) + 135.0 / 64 * phi * std::log(phi) + 16.14 * phi) /
               (1 + phi * (0.681 + phi * (-8.48 + phi * 8.16)));
    }
};
}
