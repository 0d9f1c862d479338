// The inner loops of the granule engine, compiled once for each instruction set and chosen when the program starts.
//
// What they work on is laid out for them, not for reading: one row of 192 bytes per granule with all that a contact
// asks for and its forces, and blocks of eight contacts whose histories stand side by side.
//
// Sums do not depend on their order. Every contribution to a force is rounded to a multiple of the granule's quantum, a
// power of two small enough not to matter and large enough that the sums have no rounding of their own: so neither the
// order of the list, nor the number of ranks, nor the moment of a rebuild or a restart is seen in the bits of a result.
#pragma once

#include "granum/law/contact/all.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace granum::dem::kernel
{
//! A granule as contacts see it: m, m/s, 1/kg, rad/s. `rounder` is 1.5 * 2^52 times the quantum of its force, N: adding
//! and subtracting it rounds to a multiple of the quantum.
struct alignas(64) Body
{
    double position[3], radius;
    double velocity[3], inverse_mass;
    double spin[3], rounder;
    double built[3], per_room2;  //!< where it was when the neighbour list was made, and one over the square of how far
                                 //!< it may go before the next one is
    double force[4], torque[4];  //!< of its contacts, N and N m; the fourth numbers stay zero
};

//! A row as contacts name it: the distance of its first number from that of row 0, so that an address is one addition.
inline constexpr std::uint32_t stride = sizeof(Body) / sizeof(double);
inline std::uint32_t place_of(std::size_t row)
{
    return static_cast<std::uint32_t>(row) * stride;
}
inline std::uint32_t row_of(std::uint32_t place)
{
    return place / stride;
}

inline constexpr std::size_t block = 8;  // contacts that share a block, whatever the width of a register

//! Places (place_of) of the partners with the lower and with the higher id. Where there is no pair stand two that never
//! meet.
struct alignas(64) PairBlock
{
    std::uint32_t low[block], high[block];
};

//! The laws of a pass: places in the three lists of law/contact, the laws themselves, and per pairing of materials what
//! they need (law::contact::Pair, `pairings` squared of them).
struct Rules
{
    std::size_t normal_index = 0, tangential_index = 0, rolling_index = 0;
    void const *normal = nullptr, *tangential = nullptr, *rolling = nullptr;
    law::contact::Pair<double> const* pairs = nullptr;
    std::size_t materials = 1;
    double lever_shift = 0.5;  //!< lever of the contact point: radius less this part of the overlap
    bool inertia = false;      //!< a law asks for Approach::inertia
    bool ledger = false;       //!< account for energies: two more columns of history
    //! Energies are summed in two parts, each in multiples of a power of two, so that these sums know no order either:
    //! 1.5 * 2^52 times the coarse and the fine one, J.
    double coarse_energy = 0, fine_energy = 0;
    std::size_t columns = 6;              //!< of history
    double const* restitution = nullptr;  //!< per pairing, of collisions that are counted
    double wear_threshold = 0;            //!< J/kg
};

//! Collisions (contacts that began) since somebody looked. All in whole multiples of powers of two, so that sums know
//! no order.
struct Blows
{
    double count = 0;
    double speed = 0;  //!< sum of the changes of the granule's velocity, m/s
    double wear = 0;   //!< sum of what they dissipate in it beyond Rules::wear_threshold, J per kg of it
};

//! Those of a granule.
struct Collisions
{
    Blows granules, walls;
};

//! Energies of contacts, J, summed in two parts, each in multiples of its quantum (Rules::coarse_energy): neither the
//! order nor who counts which half of a contact is seen in the bits of either. Exact for the contacts of one step.
struct Energy
{
    double coarse = 0, fine = 0;

    //! `share` is one half for each side of a contact that two ranks know, else one.
    void add(Rules const& rules, double energy, double share)
    {
        double const half = 0.5 * energy, rough = (half + rules.coarse_energy) - rules.coarse_energy;
        coarse += 2 * share * rough;
        fine += 2 * share * (((half - rough) + rules.fine_energy) - rules.fine_energy);
    }
    double value() const { return coarse + fine; }
};

//! What passes saw, summed. With a partner that another rank owns, each side counts one half of the energies.
struct Seen
{
    double largest_overlap = 0;  //!< over the radius of the smaller partner
    long contacts = 0;
    Energy dissipated, elastic;  //!< in this step; stored now
};

//! The lengths of a periodic domain, m: a difference beyond half a length is shortened by one. Where it is not
//! periodic, zero and infinite.
struct Images
{
    bool any = false;
    double length[3]{}, half[3]{infinite, infinite, infinite};

    static constexpr double infinite = std::numeric_limits<double>::infinity();
};

struct PairPass
{
    Rules const* rules;
    Body* bodies;
    std::uint8_t const* material;  //!< of each row; null where all are one
    std::size_t pairing;           //!< the one of all pairs then
    std::size_t blocks;
    PairBlock const* pairs;
    Images images;
    double* history;         //!< [blocks][columns][block]
    std::uint8_t* touching;  //!< one bit per contact
    std::size_t owned;       //!< rows from here on belong to other ranks
    double dt;               //!< s; 0 leaves histories as they are
    Collisions* collisions;  //!< of each row; null: not counted
};

//! Contacts with walls, whose geometry was found before: everything per place, padded to whole blocks.
struct WallPass
{
    Rules const* rules;
    Body* bodies;
    std::uint8_t const* material;
    std::size_t blocks;
    std::uint32_t const* granule;  //!< its place
    std::uint8_t const* wall_material;
    double const* overlap;      //!< m; not above zero: no touch
    double const* normal[3];    //!< to the granule
    double const* velocity[3];  //!< of the surface at the contact, m/s
    double const* spin[3];      //!< of the wall, rad/s
    double* history;
    std::uint8_t* touching;
    double dt;
    double* force[3];   //!< on the granule, N
    double* torque[3];  //!< on the granule about its centre, N m
    Collisions* collisions;
};

//! What the held gas and gravity do to the velocity of a granule in a kick, or the gas to its spin: with the force F of
//! the contacts, w = v + push F, then v = w + (pull - share w). In the terms of dem/held_gas.hpp,
//! share = h r / (1 + h r), pull = share u + h A / (1 + h r), push = h / (m + a).
struct alignas(64) Drag
{
    double pull[3], share;
    double given[3];  //!< sum of all pull - share w
    double push;
};

//! A pass over `count` of the rows that moves them on: `kicks` half steps of velocity, then a drift of position. All
//! kernels round alike here, and a gas that does nothing leaves the bits of no gas.
struct Motion
{
    Body* bodies;
    std::uint32_t const* rows;
    std::size_t count;
    double gravity[3];     //!< m/s2; in `gas` already
    double half;           //!< s, of one kick
    double drift;          //!< s
    int kicks;             //!< 1 or 2
    bool clear;            //!< sets forces and torques to zero behind it
    Drag* gas = nullptr;   //!< of each row on velocities, or none
    Drag* turn = nullptr;  //!< of each row on spins; only with `gas`
};
struct MotionSeen
{
    double hastiest2 = 0;  //!< an upper bound of what rows use up of their room per time, squared, 1/s2
    bool finite = true;
};

//! Places [begin, end) of a search.
struct Span
{
    std::uint32_t begin, end;
};

//! Looks from one place at others: which are closer, surface to surface, than `skin`, and of these which than `close`.
//! The numbers of places stand side by side and are padded by a block.
struct Look
{
    double const *x, *y, *z, *radius;
    double at[3], own_radius, skin, close;  //!< m
    Images images;
    std::uint32_t *near, *far;  //!< room for all places of the spans
    std::size_t near_count, far_count;
};

struct Kernel
{
    std::string_view name;
    void (*pairs)(PairPass const&, Seen&);
    void (*walls)(WallPass const&, Seen&);
    void (*move)(Motion const&, MotionSeen&);
    void (*look)(Look&, Span const*, std::size_t spans);
};

//! Those that this processor can run, the fastest first; the last is the plain one.
std::span<Kernel const* const> kernels();
//! The kernel called `name`, or null.
Kernel const* find_kernel(std::string_view name);

Kernel const& scalar();
Kernel const& sse4();
Kernel const& avx2();
Kernel const& avx512();

//! The largest power of two not above x > 0.
inline double power_of_two_below(double x)
{
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7FF0000000000000u);
}
}
