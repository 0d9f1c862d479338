#include "granum/geometry/ball_in_box.hpp"

#include "granum/math/constants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace granum::geometry
{
namespace
{
using math::Vec3;

// Half of the chord of a circle at x, and the area of the circle left of x.
double half_chord(double radius, double x)
{
    return std::sqrt(std::max(0.0, radius * radius - x * x));
}
double left_of(double radius, double x)
{
    if (x <= -radius) return 0;
    if (x >= radius) return math::pi * radius * radius;
    return radius * radius * (math::pi / 2 + std::asin(x / radius)) + x * half_chord(radius, x);
}

// Area of a circle about the origin left of x and below y.
double left_and_below(double radius, double x, double y)
{
    if (x <= -radius || y <= -radius) return 0;
    if (x >= radius) return left_of(radius, y);
    if (y >= radius) return left_of(radius, x);
    if (x * x + y * y < radius * radius) {
        auto const side = [&](double at) {
            return 0.5 * (at * half_chord(radius, at) + radius * radius * std::asin(at / radius));
        };
        return x * y + side(x) + side(y) + 0.25 * math::pi * radius * radius;
    }
    if (x < 0 && y < 0) return 0;
    if (x < 0) return left_of(radius, x);
    if (y < 0) return left_of(radius, y);
    return left_of(radius, x) + left_of(radius, y) - math::pi * radius * radius;
}

// Gauss and Legendre's five points on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<std::pair<double, double>, 5> gauss{{{0, 0.568888888888889},
                                                          {-0.538469310105683, 0.478628670499366},
                                                          {0.538469310105683, 0.478628670499366},
                                                          {-0.906179845938664, 0.236926885056189},
                                                          {0.906179845938664, 0.236926885056189}}};
}

double ball_in_box(Vec3 const& centre, double radius, Vec3 const& lower, Vec3 const& upper)
{
    Vec3 low = lower - centre, high = upper - centre;
    std::size_t cut = 0, last_cut = 2;
    for (std::size_t d = 0; d < 3; ++d) {
        if (high[d] <= -radius || low[d] >= radius) return 0;
        if (low[d] > -radius || high[d] < radius) ++cut, last_cut = d;
        low[d] = std::max(low[d], -radius), high[d] = std::min(high[d], radius);
    }
    std::swap(low[2], low[last_cut]), std::swap(high[2], high[last_cut]);
    if (cut <= 1) {
        auto const below = [&](double z) { return math::pi * (radius * radius * z - z * z * z / 3); };
        return below(high[2]) - below(low[2]);
    }
    // The area of a slice is smooth between the heights at which its circle leaves a side or a corner.
    std::array<double, 18> ends{low[2], high[2]};
    std::size_t count = 2;
    auto const leaves_at = [&](double distance) {
        double const z = half_chord(radius, distance);
        for (double const end : {-z, z})
            if (end > low[2] && end < high[2]) ends[count++] = end;
    };
    for (double const x : {low.x, high.x}) {
        leaves_at(x);
        for (double const y : {low.y, high.y}) leaves_at(std::min(radius, std::hypot(x, y)));
    }
    for (double const y : {low.y, high.y}) leaves_at(y);
    std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count));
    double volume = 0;
    for (std::size_t k = 0; k + 1 < count; ++k)
        for (auto const& [at, weight] : gauss) {
            // Points are drawn towards both ends, where the area may rise as a root of the height; what is quadratic in
            // the height stays exact.
            double const half = 0.5 * (ends[k + 1] - ends[k]), z = 0.5 * at * (3 - at * at);
            double const circle = half_chord(radius, 0.5 * (ends[k] + ends[k + 1]) + half * z);
            double const area = left_and_below(circle, high.x, high.y) - left_and_below(circle, low.x, high.y) -
                                left_and_below(circle, high.x, low.y) + left_and_below(circle, low.x, low.y);
            volume += weight * area * half * 1.5 * (1 - at * at);
        }
    return std::max(0.0, volume);
}
}
