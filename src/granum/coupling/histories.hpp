// The history of each granule's slip, which Basset's force asks for. It belongs to the granule and travels with it.
#pragma once

#include "granum/law/force/basset.hpp"
#include "granum/particle/attachment.hpp"

#include <optional>
#include <unordered_map>
#include <vector>

namespace granum::coupling
{
using math::Vec3;

class Histories final : public particle::Attachment
{
  public:
    //! A window of `intervals` steps; 0: no histories.
    explicit Histories(std::size_t intervals) : intervals_(intervals) {}

    //! Makes the window ready for an interval of `dt` s; histories are carried over where it was another before.
    void set_step(double dt);
    //! Notes the slip (m/s) that a granule has now and answers the integral that is known one step from now, m/s^1.5.
    Vec3 known(particle::Id id, Vec3 const& slip);
    //! Weight of the change of slip (m/s2) of the coming step in that integral, s^0.5.
    double newest() const { return window_->newest(); }

    void take(particle::Id id, std::vector<std::byte>& bytes) override;
    void give(particle::Id id, std::span<std::byte const> bytes) override;

    //! @{ All that there is, to be saved and taken back: identities, and for each the same number of values.
    double step() const { return window_ ? window_->step() : 0; }
    void save(std::vector<particle::Id>& ids, std::vector<double>& values) const;
    void recall(double step, std::vector<particle::Id> const& ids, std::vector<double> const& values);
    //! @}

  private:
    std::size_t intervals_;
    std::optional<law::force::BassetWindow> window_;
    std::unordered_map<particle::Id, std::vector<double>> states_;  // of the window, then the last slip
};
}
