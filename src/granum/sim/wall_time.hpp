// How long a run will take on this machine: work counted in two currencies, what processors and what memory can do.
#pragma once

#include "granum/sim/forecast.hpp"

namespace granum::sim
{
//! What each of some cores can do while all of them work.
struct MachineSpeed
{
    double evaluations;  //!< of a small loop like that over contacts, 1/s
    double bytes;        //!< to and from memory by the triad (base/bandwidth.hpp), bytes/s
};

//! Times `cores` cores (eight at most) for some tenths of a second.
MachineSpeed machine_speed(int cores);

//! Wall time, s, of the case on `ranks` ranks, each on a core of that speed; 0 where nothing is known.
double wall_time(Case const& data, Forecast const& forecast, int ranks, MachineSpeed const& speed);
}
