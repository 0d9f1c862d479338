// How the granules are moved on; private to the engine's sources.
#pragma once

#include "granum/dem/engine_inside.hpp"

namespace granum::dem
{
struct Engine::Inside::Motion
{
    particle::Store& granules;
    double half;  // of a step, s
    bool gas;     // acts on granules in this interval
};
}
