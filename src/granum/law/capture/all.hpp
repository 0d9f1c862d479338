// The laws of droplet capture: a new one adds its name here.
#pragma once

#include "granum/law/capture/loeffler.hpp"
#include "granum/law/capture/simple.hpp"

namespace granum::law::capture
{
using All = base::TypeList<Loeffler, Simple>;
using Any = All::Any;
}
