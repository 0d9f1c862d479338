// Which of the two limits of deposit/rates.hpp a deposit follows: a family of three laws.
//
// Each is given, in kg/s: the rate of this deposit as an isolated cap, the sum of such rates over all deposits of the
// granule, the rate of the boundary layer over this deposit's wet area, and that over the whole granule.
#pragma once

#include "granum/base/type_list.hpp"

#include <cmath>

namespace granum::law::deposit
{
struct Cap
{
    static constexpr base::Card card{.name = "cap",
                                     .title = "isolated caps",
                                     .source = "Hu, Larson, J. Phys. Chem. B 106 (2002) 1334 (recalled)",
                                     .valid = "few deposits, much smaller than the granule's boundary layer"};

    double operator()(double cap_rate, double, double, double) const { return cap_rate; }
};

struct BoundaryLayer
{
    static constexpr base::Card card{.name = "boundary-layer",
                                     .title = "boundary layer of the granule over the wet area",
                                     .source = "film theory; Sherwood number of the chosen heat law",
                                     .valid = "granules that are wet over most of their surface"};

    double operator()(double, double, double layer_rate_wet_area, double) const { return layer_rate_wet_area; }
};

struct Combined
{
    static constexpr base::Card card{.name = "combined",
                                     .title = "isolated caps that share the boundary layer",
                                     .source = "series of the two resistances, a choice of this program",
                                     .valid = "from few caps (cap) to a wet granule (boundary layer)"};

    //! The share is taken of magnitudes: next to saturation salt deposits may take up water while water would still
    //! leave, and a signed ratio would then pass through -1.
    double operator()(double cap_rate, double sum_of_cap_rates, double, double full_layer_rate) const
    {
        if (full_layer_rate == 0) return 0;  // no driving force, or no way out
        return cap_rate / (1 + std::abs(sum_of_cap_rates / full_layer_rate));
    }
};

using All = base::TypeList<Cap, BoundaryLayer, Combined>;
using Any = All::Any;
}
