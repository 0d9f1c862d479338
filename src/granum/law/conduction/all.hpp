// The laws of heat conduction between granules that touch: a new one adds its name here.
#pragma once

#include "granum/law/conduction/hertz.hpp"
#include "granum/law/conduction/lens.hpp"
#include "granum/law/conduction/none.hpp"

namespace granum::law::conduction
{
using All = base::TypeList<NoConduction, Hertz, Lens>;
using Any = All::Any;

//! Radius of the circle that conducts by the law held by `law`, m.
inline double circle(Any const& law, Touch const& touch)
{
    return std::visit([&](auto const& chosen) { return chosen(touch); }, law);
}

//! Conductance (W/K) of a circle of radius `circle` (m) between bodies of these conductivities (W/m/K): the resistances
//! of the two sides, 1/(4 k a) each, in series.
inline double conductance(double circle, double one, double other)
{
    return one + other > 0 ? 4 * one * other / (one + other) * circle : 0;
}

//! Overlap (m) at which spheres of reduced radius `radius` (m) and effective modulus `modulus` (Pa,
//! 1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j) push each other with `force` (N): what takes back the wide circle that
//! softened granules have. Source: Hertz, J. reine angew. Math. 92 (1882) 156 (recalled, unverified).
inline double overlap_at(double force, double radius, double modulus)
{
    return force > 0 ? std::cbrt(std::pow(3 * force / (4 * modulus), 2) / radius) : 0;
}
}
