// The laws of turbulent dispersion: a new one adds its name here.
#pragma once

#include "granum/law/dispersion/discrete_walk.hpp"
#include "granum/law/dispersion/langevin.hpp"
#include "granum/law/dispersion/none.hpp"

namespace granum::law::dispersion
{
using All = base::TypeList<NoDispersion, DiscreteWalk, Langevin>;
using Any = All::Any;

//! u' of the gas that a droplet sees, m/s, by the law held by `law`; `normals` are three standard normal numbers.
inline math::Vec3 fluctuation(Any const& law, Eddy& eddy, Turbulence const& gas, double step, math::Vec3 const& normals)
{
    return std::visit([&](auto const& chosen) { return chosen(eddy, gas, step, normals); }, law);
}
}
