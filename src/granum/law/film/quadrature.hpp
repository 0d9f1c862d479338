// The integral over the lens of gas between two spheres, done by quadrature: the plain version with which
// rong_horio.hpp is compared.
#pragma once

#include "granum/law/film/pair.hpp"
#include "granum/math/constants.hpp"

namespace granum::law::film
{
//! integral from inner to outer of 2 pi r dr / max(way(r), shortest), m, by Simpson's rule in `intervals` (even) of the
//! logarithm of r^2, shifted by the square of the radius at which the way begins to grow.
inline double by_quadrature(Pair const& pair, int intervals = 20000)
{
    double const inner = pair.inner(), outer = pair.outer();
    if (outer <= inner) return 0;
    double const reduced = pair.wall() ? pair.smaller() : pair.radius * pair.other / (pair.radius + pair.other);
    double const start = 2 * reduced * std::max(pair.gap, pair.shortest);
    double const width = std::log1p((outer * outer - inner * inner) / start) / intervals;
    double sum = 0;
    for (int i = 0; i <= intervals; ++i) {
        double const beyond = std::expm1(i * width);
        double const r = std::min(std::sqrt(inner * inner + start * beyond), outer);
        double const value = start * (1 + beyond) / std::max(pair.way(r), pair.shortest);
        sum += (i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2) * value;
    }
    return math::pi * sum * width / 3;
}
}
