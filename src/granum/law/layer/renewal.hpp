// How the mass of the layer differs among granules that pass a spray zone again and again.
//
// Source: Mann 1983 (recalled): a renewal process of cycles.
#pragma once

#include <cmath>

namespace granum::law::layer
{
//! Standard deviation over mean of the layer's mass after `time` s, for cycles of `cycle` s (mean) with variations of
//! their length and of the mass that a pass leaves.
inline double renewal_variation(double time, double cycle, double of_mass, double of_cycle)
{
    return std::sqrt(cycle / time * (of_mass * of_mass + of_cycle * of_cycle));
}

//! The variation at `later` s where it is known at `time` s and passes are many: it falls with the root of time.
inline double later_variation(double variation, double time, double later)
{
    return variation * std::sqrt(time / later);
}
}
