// A loose bed of five sizes, ratio 10, each with the same share of the volume: what neighbour lists find hard.
#pragma once

#include "peers/state.hpp"

namespace granum::peers
{
//! About `granules` spheres of 1500 kg/m3 with radii 1 mm to 10 mm in equal ratios, placed at random without overlap at
//! a solid fraction of 0.42 in a box of square floor, at rest. The same on every machine.
State five_sizes(long granules);
}
