// How fast the deposit of a melt gives away its heat of fusion: a family of laws. The melt has its melting point until
// it is solid, and the time this takes stands where a solution has its drying time.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/math/constants.hpp"

namespace granum::law::deposit
{
//! A cap of melt at one moment.
struct MeltCap
{
    double base_radius;    //!< m
    double area;           //!< to the gas, m2
    double heat_transfer;  //!< to the gas, W/m2/K
    double conductivity;   //!< of the granule under it, W/m/K
    double above_gas;      //!< K, melting point over the temperature of the gas
    double above_granule;  //!< K, melting point over the temperature of the granule
};

//! W through the cap's surface alone.
struct ToGas
{
    static constexpr base::Card card{.name = "gas",
                                     .title = "heat of fusion through the surface of the cap",
                                     .source = "heat balance of a cap of one temperature",
                                     .valid = "granules as warm as the melt, or of a foam"};

    double operator()(MeltCap const& cap) const { return cap.heat_transfer * cap.area * cap.above_gas; }
};

//! W through the surface, and through the base into the granule, as from a disc of one temperature into half a space.
struct ToGasAndGranule
{
    static constexpr base::Card card{.name = "gas-and-granule",
                                     .title = "heat of fusion through surface and base of the cap",
                                     .source =
                                         "disc on a half-space, 4 k a: Carslaw, Jaeger, Conduction of Heat in "
                                         "Solids, 1959 (recalled)",
                                     .valid =
                                         "caps flat and much smaller than the granule; their own resistance is "
                                         "left out"};

    double operator()(MeltCap const& cap) const
    {
        return ToGas{}(cap) + 4 * cap.conductivity * cap.base_radius * cap.above_granule;
    }
};

using Solidification = base::TypeList<ToGas, ToGasAndGranule>;
using AnySolidification = Solidification::Any;
}
