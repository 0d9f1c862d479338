// What every law of droplet capture by one granule is given.
#pragma once

namespace granum::law::capture
{
struct Flow
{
    double stokes;    //!< rho_d d_d^2 u / (18 mu d_p)
    double reynolds;  //!< rho u d_p / mu
};

//! Stokes number of a droplet of `density` kg/m3 that passes a granule with `slip` m/s; diameters m, viscosity Pa s.
inline double stokes_number(double density, double droplet_diameter, double slip, double viscosity,
                            double particle_diameter)
{
    return density * droplet_diameter * droplet_diameter * slip / (18 * viscosity * particle_diameter);
}
}
