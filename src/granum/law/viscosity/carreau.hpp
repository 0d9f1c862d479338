// A viscosity that thins (or thickens) with the rate of shear, between two plateaus.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/viscosity/shear.hpp"

namespace granum::law::viscosity
{
//! infinite + (at_rest - infinite) (1 + (time rate)^2)^((n - 1) / 2). With `infinite` = 0 it becomes the power law
//! K rate^(n - 1), K = at_rest time^(n - 1), where time * rate is large.
struct Carreau
{
    static constexpr base::Card card{.name = "carreau",
                                     .title = "Carreau",
                                     .source = "Carreau, Trans. Soc. Rheol. 16 (1972) 99 (recalled)",
                                     .valid = "polymer solutions and binders; numbers of the liquid needed"};

    //! Pa s.
    double operator()(Shear const& shear) const
    {
        double const scaled = shear.time * shear.rate;
        return shear.infinite +
               (shear.at_rest - shear.infinite) * std::pow(1 + scaled * scaled, 0.5 * (shear.exponent - 1));
    }
};
}
