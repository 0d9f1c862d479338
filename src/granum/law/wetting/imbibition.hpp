// What of a deposit enters the pores of a bare core before it is dry.
#pragma once

#include <algorithm>
#include <cmath>

namespace granum::law::wetting
{
//! Pores of a core, and the liquid that finds them.
struct Pores
{
    double share = 0;   //!< of the core's volume that liquid can enter; 0: no pores
    double radius = 0;  //!< effective, m
    double viscosity = 0, surface_tension = 0, contact_angle = 0;  //!< of the liquid as it lands, SI
};

//! s until a drop of `volume` m3 at rest has gone into the pores: 1.35 V^(2/3) mu / (eps^2 R gamma cos theta). Source:
//! Hapgood, Litster, Biggs, Howes, J. Colloid Interface Sci. 253 (2002) 353 (recalled). Infinite where the liquid does
//! not wet.
inline double penetration_time(double volume, Pores const& pores)
{
    double const pull = pores.surface_tension * std::cos(pores.contact_angle);
    if (pores.share <= 0 || pull <= 0) return INFINITY;
    return 1.35 * std::cbrt(volume * volume) * pores.viscosity / (pores.share * pores.share * pores.radius * pull);
}

//! Share of a deposit that has entered after `time` s: as the root of time, from a base that stays as wide.
inline double entered(double time, double penetration)
{
    return std::min(1.0, std::sqrt(time / penetration));
}

//! Share of deposits that fall on the bare core where a layer of mean `thickness` lies already, made at random places
//! of deposits `one` thick each (Poisson).
inline double bare(double thickness, double one)
{
    return std::exp(-thickness / one);
}
}
