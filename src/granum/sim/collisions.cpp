// What granules collided since the last step of the gas: told to their wet deposits, and rubbed off their layers.
#include "granum/drying/drying.hpp"
#include "granum/math/constants.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace granum::sim
{
void Simulation::take_collisions()
{
    auto const& abrasion = drying_->settings().abrasion;
    for (std::size_t const row : mapping_->order()) {
        if (granules_.collisions[row] == 0 && granules_.wall_collisions[row] == 0) continue;
        // Parcels of granules, l^3 in each, meet others l times more rarely than granules do, and walls as often.
        double const count = granules_.count[row], ratio = std::cbrt(count);
        auto const all = [&](auto& pairs, auto& walls) {
            return ratio * std::exchange(pairs[row], 0.0) + std::exchange(walls[row], 0.0);
        };
        double const met = all(granules_.collisions, granules_.wall_collisions);
        double const impulse =
            all(granules_.collision_speed, granules_.wall_collision_speed) * granules_.mass[row] / count;
        double const dissipated = all(granules_.collision_wear, granules_.wall_collision_wear);
        for (auto& deposit : deposits_->on(granules_.id[row])) deposit.contacts += met, deposit.impulse += impulse;

        double const lost =
            granules_.mass[row] * std::visit([&](auto const& law) { return law(dissipated); }, abrasion);
        double& layer = granules_.layer_mass[row];
        if (!(lost > 0) || !(layer > 0)) continue;
        double const before = exchange_->heat_capacity(granules_, row), dust = std::min(lost, layer);
        granules_.layer_volume[row] *= 1 - dust / layer;
        layer -= dust;
        drying::resize_granule(granules_, row);
        double const heat =
            (before - exchange_->heat_capacity(granules_, row)) * (granules_.temperature[row] - math::zero_celsius);
        granules_.enthalpy[row] -= heat;
        mine_.abraded += dust;
        out_[0] += dust;
        out_[2] += heat;
    }
}
}
