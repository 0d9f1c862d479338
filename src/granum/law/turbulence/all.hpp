// The models of turbulence: a new one adds its name here.
#pragma once

#include "granum/law/turbulence/k_epsilon.hpp"
#include "granum/law/turbulence/k_omega_sst.hpp"
#include "granum/law/turbulence/laminar.hpp"
#include "granum/law/turbulence/smagorinsky.hpp"
#include "granum/law/turbulence/wale.hpp"

namespace granum::law::turbulence
{
using All = base::TypeList<Laminar, KEpsilon, KOmegaSst, Smagorinsky, Wale>;
using Any = All::Any;

//! Kinematic eddy viscosity, m2/s, by the model held by `model`.
inline double eddy_viscosity(Any const& model, Local const& at)
{
    return std::visit([&](auto const& chosen) { return chosen(at); }, model);
}
inline bool is_laminar(Any const& model)
{
    return std::holds_alternative<Laminar>(model);
}
//! Whether k and a rate are transported.
inline bool transports(Any const& model)
{
    return std::visit([](auto const& chosen) { return std::decay_t<decltype(chosen)>::transports; }, model);
}
}
