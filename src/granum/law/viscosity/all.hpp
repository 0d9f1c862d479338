// The laws of viscosity: a new one adds its name here.
#pragma once

#include "granum/law/viscosity/carreau.hpp"
#include "granum/law/viscosity/newtonian.hpp"

namespace granum::law::viscosity
{
using All = base::TypeList<Newtonian, Carreau>;
using Any = All::Any;

//! Pa s, by the law held by `law`.
inline double viscosity(Any const& law, Shear const& shear)
{
    return std::visit([&](auto const& chosen) { return chosen(shear); }, law);
}
}
