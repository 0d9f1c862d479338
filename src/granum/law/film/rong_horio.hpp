// Conduction through the lens of gas between two granules, in closed form.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/film/pair.hpp"
#include "granum/math/constants.hpp"

namespace granum::law::film
{
//! integral from inner to outer of 2 pi r dr / max(way(r), shortest), m: ways are parallel to the line of centres.
//!
//! With p and q the roots sqrt(R^2 - r^2) of the two spheres, s = p + q and D = (R_i - R_j)(R_i + R_j):
//! the way is L - s and r dr = -(s - D^2/s^3) ds / 4, so that the integral of unequal spheres is elementary as well.
struct RongHorio
{
    static constexpr base::Card card{
        .name = "rong-horio",
        .title = "Lens of gas of Rong and Horio",
        .source =
            "Rong, Horio, 2nd Int. Conf. CFD Minerals Process Ind. (1999) 65 (recalled; integral and lens as in "
            "MFIX); closed form: own",
        .valid = "granules that conduct far better than the gas; lens up to about half a radius"};

    double operator()(Pair const& pair) const
    {
        double const inner = pair.inner(), outer = pair.outer();
        if (outer <= inner) return 0;
        // The way grows with r: up to `even` it is held at the shortest.
        double const even = std::clamp(radius_of(pair, pair.shortest), inner, outer);
        double const flat = math::pi * (even - inner) * (even + inner) / pair.shortest;
        return flat + (pair.wall() ? to_wall(pair, even, outer) : between(pair, even, outer));
    }

  private:
    //! Radius at which the way is `way`, m; 0 where it is longer everywhere.
    static double radius_of(Pair pair, double way)
    {
        pair.gap -= way;
        return pair.inner();
    }

    static double to_wall(Pair const& pair, double from, double to)
    {
        double const height = pair.smaller() + pair.gap, first = pair.way(from), last = pair.way(to);
        // Of p = height - way: integral of 2 pi p dp / (height - p).
        return 2 * math::pi * (height * std::log(last / first) - (last - first));
    }

    static double between(Pair const& pair, double from, double to)
    {
        double const L = pair.distance(), D = (pair.radius - pair.other) * (pair.radius + pair.other);
        double const first = pair.way(from), last = pair.way(to), s1 = L - first, s2 = L - last;
        double const logarithm = std::log(last / first);
        double const spheres = L * logarithm - (last - first);
        if (D == 0) return math::pi / 2 * spheres;
        // Integral of D^2 / (s^3 (L - s)) from s2 to s1, by partial fractions.
        double const unequal =
            D / L * D / L * ((1 / s2 - 1 / s1) * ((1 / s2 + 1 / s1) * L / 2 + 1) + (std::log(s1 / s2) + logarithm) / L);
        return math::pi / 2 * (spheres - unequal);
    }
};
}
