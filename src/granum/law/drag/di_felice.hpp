// Drag as one sphere's times a power of the voidage that depends on the Reynolds number.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/drag/flow.hpp"

#include <cmath>

namespace granum::law::drag
{
//! Dallavalle's Cd Re / 24 with Cd = (0.63 + 4.8 / sqrt(Re))^2; 0.96 in creeping flow, not 1.
inline double dallavalle(double reynolds)
{
    double const root = 0.63 * std::sqrt(reynolds) + 4.8;
    return root * root / 24;
}

struct DiFelice
{
    static constexpr base::Card card{.name = "di-felice",
                                     .title = "Di Felice",
                                     .source = "Di Felice, Int. J. Multiphase Flow 20 (1994) 153",
                                     .valid = "all voidages, Reynolds number up to 1e4"};

    double operator()(Flow const& flow) const
    {
        double const off = 1.5 - std::log10(std::max(flow.re(), 1e-6));
        double const xi = 3.7 - 0.65 * std::exp(-0.5 * off * off);
        return dallavalle(flow.re()) * std::pow(flow.eps(), -xi);
    }
};
}
