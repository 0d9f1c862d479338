// A gas of its own for each granule, drawn from the granule's id: every column that the engine reads.
#pragma once

#include "granum/base/random.hpp"
#include "granum/particle/store.hpp"

#include <cmath>

namespace granum::scene
{
//! Of six granules one feels nothing, one no drag, one no spin; rates up to 10,000 1/s, added mass up to the own.
inline void blow_at_random(particle::Store& granules)
{
    for (std::size_t row = 0; row < granules.owned; ++row) {
        base::Random random(6, base::Purpose::test, granules.id[row], 1);
        auto const draw = [&] { return math::Vec3{random.normal(), random.normal(), random.normal()}; };
        auto const rate = [&] { return std::pow(10, 4 * random.uniform()); };
        auto const kind = granules.id[row] % 6;
        granules.gas_velocity[row] = 0.3 * draw();
        granules.drag_rate[row] = kind < 2 ? 0 : rate();
        granules.gas_force[row] = kind == 0 ? math::Vec3{} : (10 * granules.mass[row]) * draw();
        granules.drag_impulse[row] = kind < 2 ? math::Vec3{} : (0.1 * granules.mass[row]) * draw();
        if (granules.groups.added_mass)
            granules.added_mass[row] = kind == 0 ? 0 : random.uniform() * granules.mass[row];
        if (!granules.groups.turning) continue;
        granules.gas_spin[row] = 50 * draw();
        granules.spin_rate[row] = kind == 0 || kind == 2 ? 0 : rate();
        granules.spin_impulse[row] = {};
    }
}
}
