// The elastic contact of spheres that several normal laws share.
#pragma once

#include "granum/law/contact/pair.hpp"

namespace granum::law::contact
{
//! Slope k_n = 2 E* sqrt(R* overlap) of Hertz's force 2/3 k_n overlap at `overlap` (m), a Real of at least zero.
//!
//! All three members come from one fourth root, z = (k_n m*)^(-1/2), of (k_n m*)^2 = (2 E* m*)^2 R* overlap.
template <class Real>
Slope<Real> hertz_slope(Pair<Real> const& pair, Approach<Real> const& at, Real overlap)
{
    Real const rigid = Real(2) * pair.youngs_modulus * at.mass;
    Real const fourth_power = max(rigid * rigid * (at.radius * overlap), Real(tiny));
    Real const z = inverse_fourth_root(fourth_power), z2 = z * z, square = fourth_power * z2;
    return {square * at.inverse_mass, at.mass * z2, square * z};
}
}
