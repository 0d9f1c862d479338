// Correlations for the Sauter diameter of the spray of a two-fluid nozzle. For trends only: the scatter of such
// correlations among nozzles is larger than most effects one would study with them.
#pragma once

#include "granum/base/type_list.hpp"

#include <cmath>

namespace granum::law::atomising
{
//! A nozzle at work, SI units.
struct Atomisation
{
    double liquid_flow, air_flow;                //!< kg/s
    double air_excess_pressure;                  //!< Pa above the chamber's
    double air_density, air_velocity;            //!< kg/m3, m/s at the mouth, relative to the liquid
    double density, viscosity, surface_tension;  //!< of the liquid
    double bore;                                 //!< m, diameter of the liquid's mouth

    double liquid_over_air() const { return liquid_flow / air_flow; }
    double ohnesorge() const { return viscosity / std::sqrt(density * surface_tension * bore); }
};

struct Walzel
{
    static constexpr base::Card card{.name = "walzel",
                                     .title = "Walzel's form",
                                     .source = "Walzel, Chem. Ing. Tech. 62 (1990) 983 (recalled, unverified)",
                                     .valid = "trends with pressure, air and viscosity; external mixing"};

    //! Sauter diameter, m.
    double operator()(Atomisation const& at) const
    {
        double const less = 1 + at.liquid_over_air();
        double const pressure = at.air_excess_pressure * at.bore / (at.surface_tension * less * less);
        return 0.35 * at.bore * std::pow(pressure, -0.4) * (1 + 2.5 * at.ohnesorge());
    }
};

struct LorenzettoLefebvre
{
    static constexpr base::Card card{.name = "lorenzetto-lefebvre",
                                     .title = "Lorenzetto and Lefebvre",
                                     .source = "Lorenzetto, Lefebvre, AIAA J. 15 (1977) 1006 (recalled, unverified)",
                                     .valid = "trends with flows and velocity; plain jet in air"};

    //! Sauter diameter, m.
    double operator()(Atomisation const& at) const
    {
        double const more = std::pow(1 + at.liquid_over_air(), 1.7);
        double const inertia = std::pow(at.surface_tension * at.liquid_flow, 0.33) /
                               (at.air_velocity * std::pow(at.density, 0.37) * std::pow(at.air_density, 0.30));
        double const viscous = at.viscosity * std::sqrt(at.bore / (at.density * at.surface_tension));
        return (0.95 * inertia + 0.13 * viscous) * more;
    }
};

using Droplets = base::TypeList<Walzel, LorenzettoLefebvre>;
}
