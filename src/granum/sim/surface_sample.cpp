#include "granum/sim/surface_sample.hpp"

#include <algorithm>

namespace granum::sim
{
namespace
{
constexpr std::size_t panels = 1000;  // of 1100 um2 on a granule of 0.6 mm: a fourth of a droplet's footprint
}

SurfaceSample::SurfaceSample(std::uint32_t seed, long parcels, long granules)
    : seed_(seed), index_(static_cast<std::size_t>(std::max(parcels, 0l)), -1)
{
    long const count = std::min(granules, parcels);
    for (long n = 0; n < count; ++n) index_[static_cast<std::size_t>(n * parcels / count)] = n;
    if (count > 0) surfaces_.assign(static_cast<std::size_t>(count), product::Surface(panels));
    events_.assign(surfaces_.size(), 0);
}

void SurfaceSample::take(drying::Event const& event, double solids_density)
{
    auto const parcel = static_cast<std::size_t>(event.granule);
    if (parcel >= index_.size() || index_[parcel] < 0 || event.initial >= 1) return;
    auto const n = static_cast<std::size_t>(index_[parcel]);
    // A stream for each event of each granule: what falls does not depend on ranks or restarts.
    base::Random random(seed_, base::Purpose::surface, parcel, events_[n]++);
    product::fall(
        surfaces_[n],
        {.per_granule = event.per_granule,
         .radius = 0.5 * event.granule_diameter,
         .base_radius = event.footprint,
         .volume = event.solids * (1 - event.imbibed) / event.weight / (solids_density * (1 - event.porosity))},
        random);
}
}
