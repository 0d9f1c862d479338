// What slows a deposit as it dries: a family of laws. Each takes what the surface would be at (its water activity by
// the law of solutions) and how moist the deposit is, and gives the activity that drives evaporation and a factor on
// the rate.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/deposit/rates.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::deposit
{
//! A deposit at one moment.
struct Stage
{
    double activity;           //!< of water in the solution
    double moisture;           //!< kg water per kg solids
    double equilibrium;        //!< moisture that stays
    double relative_humidity;  //!< of the gas
    double gas_over_surface;   //!< absolute temperature of the gas over that of the deposit
};

//! Drive of a deposit's evaporation.
struct Drive
{
    double activity;  //!< of the surface
    double factor;    //!< on the rate
};

//! Free evaporation down to a critical moisture, from there in proportion to a power of what is above equilibrium.
struct FallingRate
{
    static constexpr base::Card card{.name = "falling-rate",
                                     .title = "constant rate, then a falling one",
                                     .source = "textbook; the critical moisture is measured",
                                     .valid = "deposits whose critical moisture is known"};

    double critical = 0;  //!< kg/kg; 0: the rate never falls
    double exponent = 1;

    Drive operator()(Stage const& at) const
    {
        return {at.activity, falling_rate(at.moisture, critical, at.equilibrium, exponent)};
    }
};

//! Whatever the solution: the activation energy of evaporation rises as moisture falls: DE / DE_inf = a exp(-b (X -
//! X_eq)^c), DE_inf that of the moisture in equilibrium with the gas.
struct ReactionEngineering
{
    static constexpr base::Card card{
        .name = "reaction-engineering",
        .title = "reaction engineering approach",
        .source = "Chen, Drying Technol. 26 (2008) 627 (recalled); defaults: skim milk, 20 %",
        .valid = "materials whose three numbers have been fitted to one drying curve"};

    double a = 0.998, b = 1.405, c = 0.930;

    Drive operator()(Stage const& at) const
    {
        double const above = std::max(at.moisture - at.equilibrium, 0.0);
        double const share = std::min(1.0, a * std::exp(-b * std::pow(above, c)));
        // exp(-share DE_inf / (R T)) with DE_inf = -R T_gas ln(relative humidity).
        double const humidity = std::clamp(at.relative_humidity, 1e-9, 1.0);
        return {std::pow(humidity, share * at.gas_over_surface), 1};
    }
};

using Stages = base::TypeList<FallingRate, ReactionEngineering>;
using AnyStages = Stages::Any;
}
