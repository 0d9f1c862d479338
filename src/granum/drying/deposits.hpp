// Open deposits: the droplets on granules that are not dry yet. They belong to a granule and travel with it.
#pragma once

#include "granum/drying/event.hpp"
#include "granum/law/deposit/crystallisation.hpp"
#include "granum/particle/attachment.hpp"

#include <cstring>
#include <vector>

namespace granum::drying
{
using particle::Id;

//! `weight` equal caps on the real granules of one parcel.
struct Deposit
{
    double weight = 0;
    double water = 0, solute = 0;       //!< kg, all caps together
    double water_at_impact = 0;         //!< kg
    double heat = 0;                    //!< J that a melt has to give until it is solid; not in the granule's enthalpy
    double base_radius = 0;             //!< of one cap, m; pinned while it dries
    law::deposit::Crystals crystals{};  //!< in one cap
    double time = 0;                    //!< s on the granule
    double gas_temperature = 0, gas_humidity = 0, drying_potential = 0, granule_temperature = 0,
           slip = 0;                   //!< integrals over time
    double contacts = 0, impulse = 0;  //!< of its granule since, see sim/collisions.cpp
    Event record{};                    //!< impact part filled
};

//! Deposits by granule identity; identities run from 0 to a known number.
class Deposits final : public particle::Attachment
{
  public:
    explicit Deposits(std::size_t granules) : on_(granules) {}

    std::vector<Deposit>& on(Id granule) { return on_[granule]; }
    std::vector<Deposit> const& on(Id granule) const { return on_[granule]; }

    void take(Id id, std::vector<std::byte>& bytes) override
    {
        auto& mine = on_[id];
        std::size_t const at = bytes.size(), length = mine.size() * sizeof(Deposit);
        bytes.resize(at + length);
        if (length > 0) std::memcpy(bytes.data() + at, mine.data(), length);
        mine.clear();
    }

    void give(Id id, std::span<std::byte const> bytes) override
    {
        on_[id].resize(bytes.size() / sizeof(Deposit));
        if (!bytes.empty()) std::memcpy(on_[id].data(), bytes.data(), bytes.size());
    }

  private:
    std::vector<std::vector<Deposit>> on_;
};
}
