#include "granum/geometry/chamber.hpp"

#include "granum/geometry/region.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
//! Antiderivative of sqrt(r^2 - x^2).
double under_arc(double r, double x)
{
    double const t = std::clamp(x, -r, r);
    return 0.5 * (t * std::sqrt(r * r - t * t) + r * r * std::asin(t / r));
}

//! Area of the disc's part in [0, a] x [0, b]; odd in a and in b.
double quadrant(double r, double a, double b)
{
    double const sign = (a < 0 ? -1.0 : 1.0) * (b < 0 ? -1.0 : 1.0);
    double const x = std::min(std::abs(a), r), y = std::min(std::abs(b), r);
    if (x * x + y * y <= r * r) return sign * x * y;
    double const meet = std::sqrt(r * r - y * y);  // where the arc leaves the upper edge
    return sign * (y * meet + under_arc(r, x) - under_arc(r, meet));
}

//! Integral of f over [z0, z1], five Gauss points on each piece between profile points.
template <class Function>
double integrate(std::vector<ProfilePoint> const& profile, double z0, double z1, Function&& f)
{
    static constexpr double node[5]{-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                    0.9061798459386640};
    static constexpr double weight[5]{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                      0.2369268850561891};
    double sum = 0, low = z0;
    auto piece = [&](double high) {
        double const half = 0.5 * (high - low), middle = 0.5 * (high + low);
        for (int g = 0; g < 5; ++g) sum += half * weight[g] * f(middle + half * node[g]);
        low = high;
    };
    for (auto const& point : profile)
        if (point.height > low && point.height < z1) piece(point.height);
    if (z1 > low) piece(z1);
    return sum;
}

//! Integral over a height `rise` of min(t, half chord) in a plane at a distance `p` from the axis, where the radius
//! goes from r0 to r1 (all at least 0) at a constant rate.
double under_chord(double r0, double r1, double rise, double p, double t)
{
    double const low = std::min(r0, r1), high = std::max(r0, r1), full = std::hypot(p, t);  // the chord is 2 t long
    if (high <= p) return 0;
    if (high - low < 1e-7 * high) {
        double const half2 = low * low - p * p;
        return half2 > 0 ? rise * std::min(t, std::sqrt(half2)) : 0;
    }
    // Antiderivative of sqrt(r^2 - p^2).
    auto const area = [&](double r) {
        double const half = std::sqrt(std::max(0.0, r * r - p * p));
        return 0.5 * (r * half - (p > 0 ? p * p * std::log((r + half) / p) : 0));
    };
    double const from = std::clamp(low, p, full), to = std::clamp(high, p, full);
    return rise / (high - low) * (area(to) - area(from) + t * std::max(0.0, high - std::max(low, full)));
}

double overlap(double low0, double high0, double low1, double high1)
{
    return std::max(0.0, std::min(high0, high1) - std::max(low0, low1));
}
}

double circle_rectangle_area(double radius, double x0, double x1, double y0, double y1)
{
    if (radius <= 0) return 0;
    double const near_x = x0 > 0 ? x0 : x1 < 0 ? x1 : 0, near_y = y0 > 0 ? y0 : y1 < 0 ? y1 : 0;
    double const far_x = std::max(std::abs(x0), std::abs(x1)), far_y = std::max(std::abs(y0), std::abs(y1));
    double const r2 = radius * radius;
    if (near_x * near_x + near_y * near_y >= r2) return 0;
    if (far_x * far_x + far_y * far_y <= r2) return (x1 - x0) * (y1 - y0);
    double const area =
        quadrant(radius, x1, y1) - quadrant(radius, x0, y1) - quadrant(radius, x1, y0) + quadrant(radius, x0, y0);
    return std::max(0.0, area);
}

double Chamber::radius(double z) const
{
    if (profile.empty()) return 0;
    if (z <= profile.front().height) return profile.front().radius;
    for (std::size_t i = 1; i < profile.size(); ++i) {
        auto const &a = profile[i - 1], &b = profile[i];
        if (z <= b.height) return a.radius + (b.radius - a.radius) * (z - a.height) / (b.height - a.height);
    }
    return profile.back().radius;
}

Vec3 Chamber::lower() const
{
    if (shape == Shape::solids) return region ? region->lower() : Vec3{};
    if (shape == Shape::box) return {0, 0, 0};
    double widest = 0;
    for (auto const& point : profile) widest = std::max(widest, point.radius);
    return {-widest, -widest, 0};
}

Vec3 Chamber::upper() const
{
    if (shape == Shape::solids) return region ? region->upper() : Vec3{};
    if (shape == Shape::box) return size;
    Vec3 const low = lower();
    return {-low.x, -low.y, profile.empty() ? 0 : profile.back().height};
}

double Chamber::area(double z) const
{
    if (levels) {
        auto const& [bottom, top, below, plate, outlet] = *levels;
        double const step = (top - bottom) / static_cast<double>(below.size() - 1);
        if (z <= bottom) return plate;
        if (z >= top) return outlet;
        auto const level = std::min(static_cast<std::size_t>((z - bottom) / step), below.size() - 2);
        return (below[level + 1] - below[level]) / step;
    }
    if (shape == Shape::box) return size.x * size.y;
    double const r = radius(z);
    return math::pi * r * r;
}

double Chamber::volume(double z0, double z1) const
{
    double const low = std::max(z0, bottom()), high = std::min(z1, top());
    if (high <= low) return 0;
    if (levels) {
        auto const& below = levels->below;
        double const step = (levels->top - levels->bottom) / static_cast<double>(below.size() - 1);
        auto const until = [&](double z) {
            double const at = (z - levels->bottom) / step;
            auto const level = std::min(static_cast<std::size_t>(std::max(at, 0.0)), below.size() - 2);
            return std::lerp(below[level], below[level + 1], at - static_cast<double>(level));
        };
        return until(high) - until(low);
    }
    if (shape == Shape::box) return size.x * size.y * (high - low);
    return integrate(profile, low, high, [this](double z) { return area(z); });  // quadratic: Gauss is exact
}

bool Chamber::inside(Vec3 const& x, double margin) const
{
    if (region) return margin > 0 ? region->distance(x) > margin : region->open(x);
    if (!(x.z > margin && x.z < height() - margin)) return false;
    if (shape == Shape::box) return x.x > margin && x.x < size.x - margin && x.y > margin && x.y < size.y - margin;
    double const r = std::hypot(x.x, x.y);
    if (r >= radius(x.z)) return false;
    // Distance to each straight piece of the generatrix, in the plane through the axis.
    for (std::size_t i = 1; i < profile.size(); ++i) {
        double const r0 = profile[i - 1].radius, z0 = profile[i - 1].height;
        double const dr = profile[i].radius - r0, dz = profile[i].height - z0;
        double const along = std::clamp(((r - r0) * dr + (x.z - z0) * dz) / (dr * dr + dz * dz), 0.0, 1.0);
        if (std::hypot(r - r0 - along * dr, x.z - z0 - along * dz) <= margin) return false;
    }
    return true;
}

bool Chamber::parted(Vec3 const& a, Vec3 const& b) const
{
    return region && region->blocked(a, b);
}

double Chamber::open_volume(Vec3 const& low, Vec3 const& high) const
{
    double const z0 = std::max(low.z, 0.0), z1 = std::min(high.z, height());
    if (z1 <= z0) return 0;
    if (shape == Shape::box) return overlap(low.x, high.x, 0, size.x) * overlap(low.y, high.y, 0, size.y) * (z1 - z0);
    return integrate(profile, z0, z1,
                     [&](double z) { return circle_rectangle_area(radius(z), low.x, high.x, low.y, high.y); });
}

double Chamber::open_area(int direction, Vec3 const& low, Vec3 const& high) const
{
    double const top = height();
    if (shape == Shape::box) {
        auto const d = static_cast<std::size_t>(direction);
        if (low[d] < 0 || low[d] > size[d]) return 0;
        double area = 1;
        for (std::size_t e = 0; e < 3; ++e)
            if (e != d) area *= overlap(low[e], high[e], 0, size[e]);
        return area;
    }
    if (direction == 2) {
        // A plane within round-off of plate or top is that plane.
        if (low.z < -1e-9 * top || low.z > top * (1 + 1e-9)) return 0;
        return circle_rectangle_area(radius(low.z), low.x, high.x, low.y, high.y);
    }
    double const z0 = std::max(low.z, 0.0), z1 = std::min(high.z, top);
    if (z1 <= z0) return 0;
    double const plane = std::abs(direction == 0 ? low.x : low.y);
    double const from = direction == 0 ? low.y : low.x, to = direction == 0 ? high.y : high.x;
    double sum = 0, below = z0;
    auto const piece = [&](double above) {
        auto const until = [&](double edge) {
            return std::copysign(under_chord(radius(below), radius(above), above - below, plane, std::abs(edge)), edge);
        };
        sum += until(to) - until(from);
        below = above;
    };
    for (auto const& point : profile)
        if (point.height > below && point.height < z1) piece(point.height);
    if (z1 > below) piece(z1);
    return sum;
}
}
