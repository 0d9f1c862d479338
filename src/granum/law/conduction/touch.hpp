// What a law of heat conduction through a contact is given.
#pragma once

namespace granum::law::conduction
{
//! Two spheres that touch.
struct Touch
{
    double radius;   //!< R* = R_i R_j / (R_i + R_j), m
    double overlap;  //!< m, > 0, of spheres with their real elasticity
};
}
