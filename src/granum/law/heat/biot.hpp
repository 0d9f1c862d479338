// Whether one temperature is enough for a granule: the resistance inside it against that of the film around it.
//
// A lumped granule follows the gas too fast. To first order its rate is too high by 3/5 of the Biot number below (the
// first eigenvalue of the sphere is z^2 = 3 B (1 - B/5) with B = h R / k), so that a limit of 0.1 means some 6 %.
#pragma once

namespace granum::law::heat
{
//! h R / (3 k) of a sphere of `diameter` m and `conductivity` W/m/K in a film of `coefficient` W/m2/K.
inline double biot(double coefficient, double diameter, double conductivity)
{
    return coefficient * diameter / (6 * conductivity);
}

//! Above it a run ought to warn that its granules have more than one temperature.
inline constexpr double largest_lumped_biot = 0.1;

//! How much too fast, relatively, a lumped granule follows its gas. Source: the series solution of the sphere
//! (textbook).
inline double lumped_rate_error(double biot)
{
    return 0.6 * biot;
}

//! Film coefficient that gives a lumped granule the rate of a real one to first order, W/m2/K.
inline double lumped_coefficient(double coefficient, double biot)
{
    return coefficient / (1 + lumped_rate_error(biot));
}
}
