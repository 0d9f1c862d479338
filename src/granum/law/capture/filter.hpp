// A cloud of granules as a filter for droplets: how soon a droplet is captured, from the solid fraction alone.
//
// It counts the real granules a parcel stands for, so it holds for any parcel size; a droplet's position samples the
// gas and the granules alike (exponent 0 of the voidage in filter theory).
#pragma once

#include "granum/law/capture/loeffler.hpp"

#include <limits>

namespace granum::law::capture
{
//! Share of the droplets in a granule's way that strike it, by Loeffler.
inline double efficiency(double stokes, double reynolds)
{
    return Loeffler{}(Flow{stokes, reynolds});
}

//! m that a droplet flies relative to the granules before it is captured; diameters in m. Infinite where nothing can.
inline double mean_free_path(double solid_fraction, double particle_diameter, double droplet_diameter,
                             double efficiency)
{
    double const reach = 1 + droplet_diameter / particle_diameter;
    double const blocked = 3 * solid_fraction * efficiency * reach * reach;
    return blocked > 0 ? 2 * particle_diameter / blocked : std::numeric_limits<double>::infinity();
}

//! Captures per second of a droplet with `slip` m/s; the chance within dt is 1 - exp(-rate dt).
inline double path_rate(double solid_fraction, double particle_diameter, double droplet_diameter, double slip,
                        double efficiency)
{
    return slip / mean_free_path(solid_fraction, particle_diameter, droplet_diameter, efficiency);
}
}
