// What takes back the long contacts of softened granules.
//
// Granules that are softer than real touch in a wider circle, which `overlap_at` takes back, and for longer. A
// collision passes heat in proportion to circle and duration. At the same speed the circle goes with E^(-1/5), the
// duration with E^(-2/5): together E^(-3/5). `overlap_at` works at the force of the softened granules, which is weaker
// than the real one, and so takes back E^(-1/3) already: E^(-4/15) is left, the ratio of durations to the power of 2/3.
// MFIX has the same power.
//
// A contact that stays, in a packing or a slow shear, lasts as long as it does whatever the modulus: there the factor
// is wrong, and so it is never applied unasked.
#pragma once

#include <cmath>

namespace granum::law::conduction
{
//! Duration of a Hertzian collision with the modulus `real` over that with `softened` (Pa, any modulus that both
//! spheres share), at the same speed.
inline double duration_ratio(double softened, double real)
{
    return std::pow(softened / real, 0.4);
}

//! Factor for the conductance of collisions whose circle is that of the real modulus at the force of softened granules.
//! Source: Morris, Pannala, Ma, Hrenya, AIChE J. 62 (2016) 4526 (recalled, unverified); exponent derived as above.
inline double short_contact_factor(double softened, double real)
{
    return std::pow(duration_ratio(softened, real), 2.0 / 3);
}
}
