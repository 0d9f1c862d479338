// The contacts of a rank: candidate pairs from the neighbour search and the history of those that touch.
//
// A candidate has a slot for its history as long as the neighbour list lives; when the list is made anew, histories are
// carried over by identity, (low id, high id) or (id, wall), so sorting and migration cannot lose them. A pair of which
// one partner is a ghost is known on both sides, each with its own copy of the same history.
#pragma once

#include "granum/law/contact/pair.hpp"
#include "granum/particle/store.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace granum::dem
{
using math::Vec3;
using particle::Id;

//! What a contact remembers.
struct History
{
    std::array<double, 4> slip{};     //!< what the tangential law keeps, of the partner with the lower id
    std::array<double, 3> rolling{};  //!< what the rolling law keeps, of the partner with the lower id
    double stiffness = 0;             //!< of the tangential spring at the step before, N/m
    double overlap = 0;               //!< m
    double normal_force = 0;          //!< N
    double stored = 0;                //!< energy in the tangential and the rolling spring, J
};

//! A contact as others see it.
struct Contact
{
    Id low, high;  //!< high is the number of the wall for a wall contact
    bool wall;
    History history;
};

//! Candidate pair: rows of the partner with the lower and of that with the higher id.
struct PairRows
{
    std::uint32_t low, high;
};

//! Candidate wall contact.
struct WallRow
{
    std::uint32_t row, wall;
};

struct ContactStore
{
    std::vector<PairRows> pairs;
    std::vector<std::uint8_t> touching;  //!< one per pair
    std::vector<History> history;        //!< one per pair, meaningful where touching

    std::vector<WallRow> wall_rows;  //!< grouped by row
    std::vector<std::uint8_t> wall_touching;
    std::vector<History> wall_history;

    //! All contacts that touch, in list order. `granules` is the store the engine worked on.
    std::vector<Contact> active(particle::Store const& granules) const;
};

//! Histories by identity, between two neighbour lists and on the way to another rank.
class SavedContacts
{
  public:
    static constexpr Id wall_bit = Id{1} << 63;

    struct Entry
    {
        Id first, second;  //!< low and high id, or id and wall_bit | wall
        History history;
    };

    //! Forgets everything and takes the touching contacts of the store.
    void collect(ContactStore const& contacts, particle::Store const& granules);
    //! Adds an entry, or replaces the one of the same identity.
    void add(Entry const& entry);
    History const* find(Id first, Id second) const;
    std::vector<Entry> const& entries() const { return entries_; }

  private:
    std::size_t place(Id first, Id second) const;  // where it is or belongs in index_
    void grow(std::size_t entries);

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> index_;  // open addressing: 1 + position in entries_, 0 where empty
};
}
