// When a polynomial of time first falls through zero: the instant at which a gap that closes has closed.
//
// "Falls" is part of the question. A gap that is zero to round-off and opens (two spheres that have just bounced) is no
// event; one that is zero to round-off and closes is an event at once. Both must not depend on the sign of a rounding
// error, so that the answer is the first t >= 0 at which the polynomial is at or below zero while it falls.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace granum::math
{
inline constexpr double never = std::numeric_limits<double>::infinity();

//! First t >= 0 with f(t) <= 0 and f falling, f = c0 + c1 t + c2 t^2; `never` if there is none.
inline double first_fall(double c0, double c1, double c2)
{
    if (c1 < 0) {
        if (c0 <= 0) return 0;
        double const discriminant = c1 * c1 - 4 * c2 * c0;
        if (discriminant < 0) return never;
        return 2 * c0 / (std::sqrt(discriminant) - c1);
    }
    if (c2 >= 0) return never;
    double const peak = -c1 / (2 * c2);
    if (c0 + 0.5 * c1 * peak <= 0) return peak;
    return -(c1 + std::sqrt(c1 * c1 - 4 * c2 * c0)) / (2 * c2);
}

namespace detail
{
template <std::size_t Terms>
double value(std::array<double, Terms> const& c, double x)
{
    double sum = c[Terms - 1];
    for (std::size_t k = Terms - 1; k-- > 0;) sum = sum * x + c[k];
    return sum;
}

//! The x in [a, b] where a polynomial that is monotone there changes sign; f(a) and f(b) differ in sign.
template <std::size_t Terms>
double crossing(std::array<double, Terms> const& c, double a, double b)
{
    bool const falls = value(c, a) > 0;
    double x = 0.5 * (a + b);
    for (int step = 0; step < 200 && b - a > 0; ++step) {
        double const f = value(c, x);
        if (f == 0) return x;
        ((f > 0) == falls ? a : b) = x;
        double slope = 0;
        for (std::size_t k = Terms - 1; k > 0; --k) slope = slope * x + static_cast<double>(k) * c[k];
        double next = x - f / slope;
        if (!(next > a && next < b)) next = 0.5 * (a + b);  // outside, or the slope vanished
        if (next == x || next <= a || next >= b) return x;
        x = next;
    }
    return x;
}

//! Points of [0, 1] between which the polynomial is monotone, in order, both ends included; returns how many.
template <std::size_t Terms>
std::size_t monotone_nodes(std::array<double, Terms> const& c, std::array<double, Terms + 1>& nodes)
{
    std::size_t count = 0;
    nodes[count++] = 0;
    if constexpr (Terms > 2) {
        std::array<double, Terms - 1> slope;
        for (std::size_t k = 1; k < Terms; ++k) slope[k - 1] = static_cast<double>(k) * c[k];
        std::array<double, Terms> inner{};
        std::size_t const inner_count = monotone_nodes(slope, inner);
        for (std::size_t k = 0; k + 1 < inner_count; ++k) {
            double const low = value(slope, inner[k]), high = value(slope, inner[k + 1]);
            if ((low < 0) == (high < 0)) continue;
            double const node = crossing(slope, inner[k], inner[k + 1]);
            if (node > nodes[count - 1] && node < 1) nodes[count++] = node;
        }
    }
    nodes[count++] = 1;
    return count;
}
}

//! First t in [0, longest] with f(t) <= 0 and f falling, f = sum of c_k t^k up to the fourth power; `never` if there is
//! none. `longest` must be finite.
inline double first_fall(std::array<double, 5> c, double longest)
{
    double power = 1;
    for (auto& coefficient : c) coefficient *= power, power *= longest;
    std::array<double, 6> nodes{};
    std::size_t const count = detail::monotone_nodes(c, nodes);
    double before = c[0];
    for (std::size_t k = 1; k < count; ++k) {
        double const after = detail::value(c, nodes[k]);
        if (after < before) {
            if (before <= 0) return nodes[k - 1] * longest;
            if (after <= 0) return detail::crossing(c, nodes[k - 1], nodes[k]) * longest;
        }
        before = after;
    }
    return never;
}
}
