// Large eddies resolved; a viscosity that vanishes in pure shear, and with the cube of the distance at walls.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/turbulence/local.hpp"

#include <cmath>

namespace granum::law::turbulence
{
//! (C width)^2 (D:D)^(3/2) / ((S:S)^(5/2) + (D:D)^(5/4)), D the traceless symmetric part of the gradient's square.
struct Wale
{
    static constexpr base::Card card{
        .name = "wale",
        .title = "WALE, large eddies",
        .source = "Nicoud, Ducros, Flow Turbul. Combust. 62 (1999) 183 (recalled; form and constant as in OpenFOAM)",
        .valid = "cells that resolve the large eddies, walls included"};
    static constexpr bool transports = false;

    double constant = 0.325;

    template <class Visit>
    void each_constant(Visit&& visit)
    {
        visit("constant", constant);
    }

    //! Eddy viscosity, m2/s.
    double operator()(Local const& at) const
    {
        Slopes square{};
        for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t e = 0; e < 3; ++e)
                for (std::size_t f = 0; f < 3; ++f) square[d][e] += at.slopes[d][f] * at.slopes[f][e];
        double const third = (square[0][0] + square[1][1] + square[2][2]) / 3;
        double turning = 0, straining = 0;
        for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t e = 0; e < 3; ++e) {
                double const a = 0.5 * (square[d][e] + square[e][d]) - (d == e ? third : 0);
                double const s = 0.5 * (at.slopes[d][e] + at.slopes[e][d]);
                turning += a * a, straining += s * s;
            }
        double const below = std::pow(straining, 2.5) + std::pow(turning, 1.25), length = constant * at.width;
        return below > 0 ? length * length * std::pow(turning, 1.5) / below : 0;
    }
};
}
