// Large eddies resolved, small ones dissipate by the strain of the cell.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/turbulence/local.hpp"

#include <cmath>

namespace granum::law::turbulence
{
//! (C width)^2 |S|, |S|^2 = 2 S:S.
struct Smagorinsky
{
    static constexpr base::Card card{.name = "smagorinsky",
                                     .title = "Smagorinsky, large eddies",
                                     .source = "Smagorinsky, Mon. Weather Rev. 91 (1963) 99 (recalled)",
                                     .valid = "cells that resolve the large eddies; too viscous at walls"};
    static constexpr bool transports = false;

    double constant = 0.168;  //!< C: 0.1 to 0.17, this one recalled

    template <class Visit>
    void each_constant(Visit&& visit)
    {
        visit("constant", constant);
    }

    //! Eddy viscosity, m2/s.
    double operator()(Local const& at) const
    {
        double const length = constant * at.width;
        return length * length * std::sqrt(at.strain2());
    }
};
}
