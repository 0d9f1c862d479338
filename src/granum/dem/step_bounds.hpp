// Bounds on the granule step for granules of several kinds.
#pragma once

#include "granum/dem/engine.hpp"

#include <span>

namespace granum::dem
{
//! Granules of one material and size.
struct Grains
{
    std::uint32_t material = 0;
    double radius = 0;   //!< m
    double density = 0;  //!< kg/m3
};

//! Bounds where each of `kinds` may meet each other, its like and every wall's material with `speed` (m/s): for the
//! Hertz laws 0.2 of the time a Rayleigh wave takes around each granule and 1/20 of the duration of each elastic
//! contact, for the linear law 1/20 of pi sqrt(m* / k_n), and 0.2 sqrt(I / k_r) of the rolling spring at the overlap of
//! that contact. The partners' R* is taken as the radius of the smaller, so that a smaller or stiffer granule of the
//! same density never raises the least of the bounds. With several sizes of one material the smallest is enough.
//! Sources as `step_bounds`.
std::vector<StepBound> step_bounds(Laws const& laws, std::span<Grains const> kinds, double speed);
}
