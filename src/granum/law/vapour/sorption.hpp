// How much water a dry solid holds in equilibrium with the air around it: a family of laws of the relative humidity.
#pragma once

#include "granum/base/type_list.hpp"

#include <algorithm>

namespace granum::law::vapour
{
struct NoSorption
{
    static constexpr base::Card card{
        .name = "none", .title = "no absorbed water", .source = "", .valid = "glass, salts below deliquescence"};

    double operator()(double) const { return 0; }
};

//! Guggenheim, Anderson and de Boer: X = X_m C K a / ((1 - K a) (1 - K a + C K a)), kg water per kg dry solid.
struct Gab
{
    static constexpr base::Card card{.name = "gab",
                                     .title = "Guggenheim, Anderson and de Boer",
                                     .source =
                                         "van den Berg, 1984 (recalled); defaults: placeholders for "
                                         "microcrystalline cellulose",
                                     .valid = "relative humidity up to 0.95, held there above"};

    double monolayer = 0.04, c = 10, k = 0.8;

    double operator()(double relative_humidity) const
    {
        double const a = k * std::clamp(relative_humidity, 0.0, 0.95);
        return monolayer * c * a / ((1 - a) * (1 - a + c * a));
    }
};

using Sorption = base::TypeList<NoSorption, Gab>;
using AnySorption = Sorption::Any;
}
