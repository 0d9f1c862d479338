// Root of one equation in one unknown by Brent's method.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace granum::math
{
//! The x in [low, high] where f changes sign, to `tolerance` in x. Throws std::domain_error if the ends agree in sign.
//! Source: Brent, Algorithms for Minimization without Derivatives (1973), chapter 4.
template <class Function>
double brent_root(Function&& f, double low, double high, double tolerance)
{
    double a = low, b = high, fa = f(a), fb = f(b);
    if (fa == 0) return a;
    if (fb == 0) return b;
    if (fa * fb > 0) throw std::domain_error("brent_root: no change of sign between the ends");
    double c = a, fc = fa, d = b - a, e = d;
    for (int iteration = 0; iteration < 200; ++iteration) {
        if (fb * fc > 0) {
            c = a, fc = fa;
            d = e = b - a;
        }
        if (std::abs(fc) < std::abs(fb)) {
            a = b, b = c, c = a;
            fa = fb, fb = fc, fc = fa;
        }
        double const enough = 4e-16 * std::abs(b) + 0.5 * tolerance;
        double const half = 0.5 * (c - b);
        if (std::abs(half) <= enough || fb == 0) return b;
        if (std::abs(e) >= enough && std::abs(fa) > std::abs(fb)) {
            double p, q;
            double const s = fb / fa;
            if (a == c) {
                p = 2 * half * s;
                q = 1 - s;
            } else {
                double const r = fb / fc, t = fa / fc;
                p = s * (2 * half * t * (t - r) - (b - a) * (r - 1));
                q = (t - 1) * (r - 1) * (s - 1);
            }
            if (p > 0) q = -q;
            p = std::abs(p);
            if (2 * p < std::min(3 * half * q - std::abs(enough * q), std::abs(e * q))) {
                e = d;
                d = p / q;
            } else {
                d = e = half;
            }
        } else {
            d = e = half;
        }
        a = b, fa = fb;
        b += std::abs(d) > enough ? d : std::copysign(enough, half);
        fb = f(b);
    }
    return b;
}
}
