// The shape a droplet takes on a granule: a spherical cap at rest, a flat disc at its widest during impact.
//
// The granule is flat at the scale of a droplet. The contact line of a solution is pinned where it has been, so the
// footprint is the wider of the two. Lengths in m, angles in rad, within (0, pi).
#pragma once

#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::wetting
{
//! Base radius of the spherical cap with the volume of a droplet of `diameter`.
inline double cap_base_radius(double diameter, double contact_angle)
{
    double const cosine = std::cos(contact_angle), sine = std::sin(contact_angle);
    double const shape = 4 * sine * sine * sine / ((1 - cosine) * (1 - cosine) * (2 + cosine));
    return 0.5 * diameter * std::cbrt(shape);
}

//! Height of the cap on a base of `base_radius`.
inline double cap_height(double base_radius, double contact_angle)
{
    return base_radius * std::tan(0.5 * contact_angle);
}

//! m2 of the cap's surface to the gas.
inline double cap_area(double base_radius, double contact_angle)
{
    return 2 * math::pi * base_radius * base_radius / (1 + std::cos(contact_angle));
}

//! Contact angle, rad, of the cap of `volume` m3 on a pinned base: less liquid, flatter. Inverse of the cap's volume
//! pi a^3 / 6 * t (3 + t^2) with t = tan(angle / 2).
inline double pinned_angle(double volume, double base_radius)
{
    double const s = 6 * volume / (math::pi * base_radius * base_radius * base_radius);
    double const q = std::cbrt(0.5 * s + std::sqrt(0.25 * s * s + 1));  // Cardano for t^3 + 3 t = s
    return 2 * std::atan(std::max(q - 1 / q, 0.0));
}

//! Widest diameter during impact over the droplet's. Source: Pasandideh-Fard et al., Phys. Fluids 8 (1996) 650
//! (recalled, unverified).
inline double maximum_spread(double weber, double reynolds, double contact_angle)
{
    return std::sqrt((weber + 12) / (3 * (1 - std::cos(contact_angle)) + 4 * weber / std::sqrt(reynolds)));
}

//! Radius that stays wet: the wider of the impact's disc and the cap at rest.
inline double footprint_radius(double diameter, double contact_angle, double weber, double reynolds)
{
    double const rest = cap_base_radius(diameter, contact_angle);
    return weber > 0 ? std::max(rest, 0.5 * diameter * maximum_spread(weber, reynolds, contact_angle)) : rest;
}
}
