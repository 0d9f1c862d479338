// Di Felice's form with an exponent from lattice-Boltzmann runs of packed beds.
#pragma once

#include "granum/law/drag/di_felice.hpp"

namespace granum::law::drag
{
struct Rong
{
    static constexpr base::Card card{.name = "rong",
                                     .title = "Rong, Dong and Yu",
                                     .source = "Rong, Dong, Yu, Chem. Eng. Sci. 99 (2013) 44",
                                     .valid = "packed beds of equal spheres, voidage 0.37 to 0.8"};

    double operator()(Flow const& flow) const
    {
        double const eps = flow.eps();
        double const off = 1.5 - std::log10(std::max(flow.re(), 1e-6));
        double const xi = 2.65 * (eps + 1) - (5.3 - 3.5 * eps) * eps * eps * std::exp(-0.5 * off * off);
        return dallavalle(flow.re()) * std::pow(eps, -xi);
    }
};
}
