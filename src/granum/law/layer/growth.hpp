// Growth of granules by the layer that dried deposits leave.
#pragma once

#include "granum/math/constants.hpp"

#include <cmath>

namespace granum::law::layer
{
//! m3 of layer, pores included, from `solids_mass` kg of solids of `solids_density` kg/m3 (without pores).
inline double layer_volume(double solids_mass, double solids_density, double porosity)
{
    return solids_mass / (solids_density * (1 - porosity));
}

//! m, the diameter of a granule of `diameter` m after `volume` m3 of layer has come on evenly.
inline double grown_diameter(double diameter, double volume)
{
    return std::cbrt(diameter * diameter * diameter + 6 * volume / math::pi);
}

//! m/s by which every diameter grows where the solids come down in proportion to surface. `solids_rate` kg/s,
//! `overspray` the share that does not reach the granules, `layer_density` kg/m3 with pores, `surface` m2 of all.
inline double growth_rate(double solids_rate, double overspray, double layer_density, double surface)
{
    return 2 * solids_rate * (1 - overspray) / (layer_density * surface);
}

//! m, the diameter of a batch of equal cores (`core_mass` kg in all, `core_density` kg/m3) after `solids_mass` kg of
//! solids have become a layer of `layer_density` kg/m3: the exact answer a simulated batch must reach.
inline double batch_diameter(double core_diameter, double core_mass, double core_density, double solids_mass,
                             double layer_density)
{
    double const ratio = solids_mass / layer_density / (core_mass / core_density);
    return core_diameter * std::cbrt(1 + ratio);
}
}
