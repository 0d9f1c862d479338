// Surfaces of a sample of real granules, laid cap by cap from the events of a run (product/surface.hpp).
#pragma once

#include "granum/drying/event.hpp"
#include "granum/product/surface.hpp"

#include <cstdint>
#include <vector>

namespace granum::sim
{
class SurfaceSample
{
  public:
    //! One real granule of each of `granules` parcels, spread evenly over the identities from 0 to `parcels`; none
    //! where `granules` is 0.
    SurfaceSample(std::uint32_t seed, long parcels, long granules);

    //! Lays what the deposit of an event left. The events of one granule must come in the order of time.
    void take(drying::Event const& event, double solids_density);

    product::SurfaceStatistics statistics() const { return product::statistics(surfaces_); }
    std::vector<product::Surface> const& surfaces() const { return surfaces_; }

  private:
    std::uint32_t seed_;
    std::vector<long> index_;            // of a parcel among the surfaces; -1: not in the sample
    std::vector<std::uint32_t> events_;  // that each surface has had
    std::vector<product::Surface> surfaces_;
};
}
