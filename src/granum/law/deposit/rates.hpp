// How fast a deposit on a granule dries: the two limits between which it lies, and what slows it at the end.
//
// A cap much smaller than the granule's boundary layer evaporates as if alone in still air; a wholly wet granule is
// limited by its boundary layer. The drying times of the two differ by a factor of 3 to 5, so the choice between them
// (deposit/all.hpp) is open to calibration. Stefan's factor stands in both.
#pragma once

#include "granum/law/vapour/film.hpp"
#include "granum/math/constants.hpp"

#include <cmath>

namespace granum::law::deposit
{
using vapour::Film;
using vapour::film;

//! kg/s from an isolated cap on a base of `base_radius` m with `contact_angle` rad below pi/2.
//! Source: Hu and Larson, J. Phys. Chem. B 106 (2002) 1334 (recalled, unverified).
inline double cap_rate(double base_radius, double contact_angle, Film const& film)
{
    double const shape = 0.27 * contact_angle * contact_angle + 1.30;
    return math::pi * base_radius * film.diffusivity * film.density * film.driving() * shape;
}

//! kg/s through the granule's boundary layer over `area` m2 of its surface.
inline double boundary_layer_rate(double sherwood, double particle_diameter, double area, Film const& film)
{
    return sherwood * film.diffusivity / particle_diameter * area * film.density * film.driving();
}

//! Factor on the rate below the critical moisture (kg water per kg solids): ((X - X_eq) / (X_cr - X_eq))^exponent,
//! 1 above it and where there is none (`critical` not above `equilibrium`), 0 at and below the equilibrium.
inline double falling_rate(double moisture, double critical, double equilibrium = 0, double exponent = 1)
{
    if (moisture <= equilibrium) return 0;
    if (critical <= equilibrium || moisture >= critical) return 1;
    return std::pow((moisture - equilibrium) / (critical - equilibrium), exponent);
}
}
