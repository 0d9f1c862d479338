// What contacts that begin do to their granules, counted once each by every kernel.
//
// Functions of plain numbers with internal linkage: each kernel gets its own, made of instructions that it may use.
#pragma once

#include "granum/dem/kernel/kernel.hpp"

namespace granum::dem::kernel
{
namespace
{
//! A collision in which the granule approaches with `speed` (m/s), its partner making its mass `share` of its own, and
//! bears `part` of what is dissipated.
[[maybe_unused]] void collide(Blows& with, Rules const& rules, double share, double speed, double restitution,
                              double part)
{
    // Multiples of 2^-40: exact sums up to 2^12 m/s or J/kg.
    constexpr double rounder = 1.5 * 0x1p52 * 0x1p-40;
    with.count += 1;
    if (!(speed > 0)) return;
    with.speed += ((1 + restitution) * share * speed + rounder) - rounder;
    double const lost = part * 0.5 * share * speed * speed * (1 - restitution * restitution) - rules.wear_threshold;
    if (lost > 0) with.wear += (lost + rounder) - rounder;
}

//! `lanes`: those of block `b` whose pairs began to touch.
[[maybe_unused]] void collide(PairPass const& in, std::size_t b, unsigned lanes)
{
    for (std::size_t lane = 0; lane < block; ++lane) {
        if ((lanes >> lane & 1u) == 0) continue;
        auto const i = row_of(in.pairs[b].low[lane]), j = row_of(in.pairs[b].high[lane]);
        Body const &low = in.bodies[i], &high = in.bodies[j];
        double along = 0, distance2 = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            double apart = low.position[d] - high.position[d];
            apart -= apart > in.images.half[d]    ? in.images.length[d]
                     : apart < -in.images.half[d] ? -in.images.length[d]
                                                  : 0;
            along += apart * (low.velocity[d] - high.velocity[d]);
            distance2 += apart * apart;
        }
        double const speed = distance2 > 0 ? -along / __builtin_sqrt(distance2) : 0;
        double const masses = low.inverse_mass + high.inverse_mass;
        auto const pairing = in.material ? in.material[i] * in.rules->materials + in.material[j] : in.pairing;
        double const restitution = in.rules->restitution[pairing];
        collide(in.collisions[i].granules, *in.rules, low.inverse_mass / masses, speed, restitution, 0.5);
        collide(in.collisions[j].granules, *in.rules, high.inverse_mass / masses, speed, restitution, 0.5);
    }
}

//! The same of walls, which bear nothing.
[[maybe_unused]] void collide(WallPass const& in, std::size_t b, unsigned lanes)
{
    for (std::size_t lane = 0; lane < block; ++lane) {
        if ((lanes >> lane & 1u) == 0) continue;
        std::size_t const place = b * block + lane, i = row_of(in.granule[place]);
        double along = 0;
        for (std::size_t d = 0; d < 3; ++d)
            along += in.normal[d][place] * (in.bodies[i].velocity[d] - in.velocity[d][place]);
        double const restitution =
            in.rules->restitution[in.material[i] * in.rules->materials + in.wall_material[place]];
        collide(in.collisions[i].walls, *in.rules, 1, -along, restitution, 1);
    }
}
}
}
