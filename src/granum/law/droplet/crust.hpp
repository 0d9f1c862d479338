// A droplet of suspended solids that locks: where the solids at its surface touch each other it shrinks no more, and
// the water that is left dries out through a crust that grows inwards.
//
// Enrichment of the surface: Vehring, Pharm. Res. 25 (2008) 999 (recalled). The crust as a resistance in series with
// the film around the droplet: two spheres, steady diffusion.
#pragma once

#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::droplet
{
//! Solids at the surface over their mean, for K / (8 D_s): K the rate at which the squared diameter falls, D_s the
//! diffusivity of the solids in the liquid. Held at its value for 20 beyond, where the fit ends.
inline double surface_enrichment(double peclet)
{
    double const x = std::clamp(peclet, 0.0, 20.0);
    return 1 + x / 5 + x * x / 100 - x * x * x / 4000;
}

//! Diameter of the wet core over that of the crust, whose pores hold `water` m3 and are the share `porosity` of it.
inline double wet_core(double water, double crust_diameter, double porosity)
{
    double const all = porosity * math::pi / 6 * crust_diameter * crust_diameter * crust_diameter;
    return std::cbrt(std::clamp(water / all, 0.0, 1.0));
}

//! Rate through the crust over that without: `transfer` is Sherwood number times diffusivity in the film, `diffusivity`
//! that in the crust (m2/s), `core` the wet core's diameter over the crust's.
inline double through_crust(double transfer, double diffusivity, double core)
{
    return core > 0 ? 1 / (1 + 0.5 * transfer / diffusivity * (1 / core - 1)) : 0;
}
}
