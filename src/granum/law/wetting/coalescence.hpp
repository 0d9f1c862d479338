// Whether granules that meet on a liquid film stay together.
//
// Source: Ennis, Tardos, Pfeffer, Powder Technol. 65 (1991) 257 (recalled): the film's viscosity takes up what they
// move with. Equal spheres; no capillary force.
#pragma once

#include <cmath>

namespace granum::law::wetting
{
//! 8 rho r U / (9 mu), 1: `speed` m/s is half of that at which they approach each other.
inline double viscous_stokes(double density, double radius, double speed, double viscosity)
{
    return 8 * density * radius * speed / (9 * viscosity);
}

//! (1 + 1/e) ln(h / h_a), 1, below which they stay together: `film` and `roughness` m, `restitution` when dry. 0 where
//! the film lies between the asperities.
inline double critical_stokes(double restitution, double film, double roughness)
{
    return film > roughness ? (1 + 1 / restitution) * std::log(film / roughness) : 0;
}
}
