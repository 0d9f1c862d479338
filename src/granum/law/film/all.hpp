// The laws of conduction through the gas between granules: a new one adds its name here.
#pragma once

#include "granum/law/film/none.hpp"
#include "granum/law/film/rong_horio.hpp"

namespace granum::law::film
{
using All = base::TypeList<NoFilm, RongHorio>;
using Any = All::Any;

//! Conductance (W/K) of a gas of this conductivity (W/m/K) between two granules, by the law held by `law`.
inline double conductance(Any const& law, Pair const& pair, double gas_conductivity)
{
    return gas_conductivity * std::visit([&](auto const& chosen) { return chosen(pair); }, law);
}
}
