// The laws of heat and mass transfer between granules and gas: a new one adds its name here.
#pragma once

#include "granum/law/heat/deen.hpp"
#include "granum/law/heat/gunn.hpp"
#include "granum/law/heat/ranz_marshall.hpp"
#include "granum/law/heat/sun.hpp"

namespace granum::law::heat
{
using All = base::TypeList<RanzMarshall, Gunn, Deen, Sun>;
using Any = All::Any;

//! Nusselt number (Sherwood number, with the Schmidt number in `flow.prandtl`) by the law held by `law`.
inline double nusselt(Any const& law, Flow const& flow)
{
    return std::visit([&](auto const& chosen) { return chosen(flow); }, law);
}
}
