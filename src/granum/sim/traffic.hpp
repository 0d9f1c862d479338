// Granules that come and go while a run goes on.
#pragma once

#include "granum/sim/case.hpp"

#include <vector>

namespace granum::sim
{
//! A feed and the granules that it still has to bring, in their order; the same on every rank.
struct Feed
{
    FeedCase how;
    std::vector<GranuleCase> granules;
    std::size_t placed = 0;
    double mass = 0;  //!< of those placed, kg

    bool done() const { return placed == granules.size(); }
};

//! What came and went since the start, over all ranks.
struct Traffic
{
    long fed = 0, left = 0;                  //!< parcels
    double fed_mass = 0, left_mass = 0;      //!< kg
    double fed_energy = 0, left_energy = 0;  //!< kinetic and potential, J
};
}
