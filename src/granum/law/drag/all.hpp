// The drag laws: a new one adds its name here.
#pragma once

#include "granum/law/drag/beetstra.hpp"
#include "granum/law/drag/di_felice.hpp"
#include "granum/law/drag/ergun.hpp"
#include "granum/law/drag/gidaspow.hpp"
#include "granum/law/drag/koch_hill.hpp"
#include "granum/law/drag/rong.hpp"
#include "granum/law/drag/schiller_naumann.hpp"
#include "granum/law/drag/stokes.hpp"
#include "granum/law/drag/tang.hpp"
#include "granum/law/drag/wen_yu.hpp"

namespace granum::law::drag
{
using All = base::TypeList<Stokes, SchillerNaumann, WenYu, Ergun, Gidaspow, DiFelice, Rong, KochHill, Beetstra, Tang>;
using Any = All::Any;

//! F of the law held by `law`.
inline double force_ratio(Any const& law, Flow const& flow)
{
    return std::visit([&](auto const& chosen) { return chosen(flow); }, law);
}
}
