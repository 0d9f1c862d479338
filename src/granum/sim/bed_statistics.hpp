// The bed as a packing: who touches whom, how deeply, and where its energy is.
#pragma once

#include "granum/par/communicator.hpp"
#include "granum/particle/store.hpp"
#include "granum/sim/mover.hpp"

#include <array>

namespace granum::sim
{
struct BedStatistics
{
    long contacts = 0;                    //!< pairs of granules that touch
    long wall_contacts = 0;               //!< granules on walls, each contact counted
    double coordination = 0;              //!< mean number of granules that a granule touches
    std::array<double, 16> neighbours{};  //!< share of the granules that touch k others; the last: 15 or more
    //! @{ Overlaps of all contacts over the radius of the smaller partner.
    double overlap_mean = 0, overlap_p99 = 0, overlap_largest = 0;
    double overlap_beyond = 0;  //!< share of the contacts above the criterion
    //! @}
    double translation = 0, rotation = 0;  //!< kinetic energy, J
    double potential = 0;                  //!< against gravity, from the origin, J
    double elastic = 0;                    //!< stored in contacts, J
    double dissipated = 0;                 //!< lost in contacts since the start, J
    double wall_work = 0;                  //!< done by moving walls since the start, J
    math::Vec3 wall_force;                 //!< of all granules on all walls, N
    long collisions = 0;                   //!< of pairs of hard spheres since the start

    double energy() const { return translation + rotation + potential + elastic; }
};

//! Collective. Contacts whose overlap is above the share `criterion` of a radius are counted. The percentile is that of
//! a histogram with classes 1 % wide. Sums are exact: of the same state, the same bits on any number of ranks.
BedStatistics bed_statistics(particle::Store const& granules, Mover& mover, par::Communicator const& comm,
                             double criterion);
}
