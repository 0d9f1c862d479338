#include "granum/geometry/clip.hpp"

#include <cmath>

namespace granum::geometry
{
namespace
{
struct Polygon
{
    std::array<std::array<double, 2>, 8> at;  // a line adds one corner at most
    std::size_t size = 0;

    void add(double u, double v) { at[size++] = {u, v}; }
};

Polygon clip(Polygon const& from, Line const& line)
{
    Polygon out;
    auto const value = [&](std::array<double, 2> const& x) {
        return line.offset + line.slope_u * x[0] + line.slope_v * x[1];
    };
    for (std::size_t k = 0; k < from.size; ++k) {
        auto const &a = from.at[k], &b = from.at[(k + 1) % from.size];
        double const at_a = value(a), at_b = value(b);
        if (at_a > 0) out.add(a[0], a[1]);
        if ((at_a > 0) != (at_b > 0)) {
            double const part = at_a / (at_a - at_b);
            out.add(a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]));
        }
    }
    return out;
}

//! Reach of a box from its middle against a direction.
double reach(Vec3 const& half, Vec3 const& slope)
{
    return std::abs(slope.x) * half.x + std::abs(slope.y) * half.y + std::abs(slope.z) * half.z;
}

SpacePart whole(Vec3 const& half)
{
    return {8 * half.x * half.y * half.z, {}};
}

SpacePart operator-(SpacePart a, SpacePart const& b)
{
    a.volume -= b.volume;
    a.moment -= b.moment;
    return a;
}

//! Pyramids from `apex` over what the planes leave of the six sides. Faces within the planes go through the apex, so
//! that their pyramids have no volume and they need not be known.
SpacePart pyramids(Vec3 const& half, Vec3 const& apex, std::span<Linear const> planes)
{
    SpacePart out;
    std::array<Line, 2> lines;
    for (std::size_t d = 0; d < 3; ++d)
        for (double const sign : {-1.0, 1.0}) {
            std::size_t const u = (d + 1) % 3, v = (d + 2) % 3;
            for (std::size_t k = 0; k < planes.size(); ++k)
                lines[k] = {planes[k].offset + planes[k].slope[d] * sign * half[d], planes[k].slope[u],
                            planes[k].slope[v]};
            auto const base = rectangle_part(half[u], half[v], std::span(lines).first(planes.size()));
            if (base.area <= 0) continue;
            double const volume = (half[d] - sign * apex[d]) * base.area / 3;
            Vec3 middle;
            middle[d] = sign * half[d], middle[u] = base.moment_u / base.area, middle[v] = base.moment_v / base.area;
            out.volume += volume;
            out.moment += volume * (apex + 0.75 * (middle - apex));
        }
    return out;
}
}

PlanePart rectangle_part(double half_u, double half_v, std::span<Line const> lines)
{
    Polygon polygon;
    polygon.add(-half_u, -half_v), polygon.add(half_u, -half_v), polygon.add(half_u, half_v),
        polygon.add(-half_u, half_v);
    for (auto const& line : lines) {
        polygon = clip(polygon, line);
        if (polygon.size == 0) return {};
    }
    PlanePart out;
    auto const& o = polygon.at[0];
    for (std::size_t k = 1; k + 1 < polygon.size; ++k) {
        auto const &a = polygon.at[k], &b = polygon.at[k + 1];
        double const area = 0.5 * ((a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]));
        out.area += area;
        out.moment_u += area * (o[0] + a[0] + b[0]) / 3;
        out.moment_v += area * (o[1] + a[1] + b[1]) / 3;
    }
    return out;
}

SpacePart box_part(Vec3 const& half, Linear const& plane)
{
    double const far = reach(half, plane.slope);
    if (plane.offset >= far) return whole(half);
    if (plane.offset <= -far) return {};
    return pyramids(half, -plane.offset * plane.slope, std::span(&plane, 1));
}

SpacePart box_part(Vec3 const& half, Linear const& one, Linear const& two)
{
    SpacePart const first = box_part(half, one), second = box_part(half, two), all = whole(half);
    if (first.volume <= 0 || second.volume <= 0) return {};
    if (first.volume >= all.volume) return second;
    if (second.volume >= all.volume) return first;
    double const cosine = dot(one.slope, two.slope), sine2 = 1 - cosine * cosine;
    if (sine2 < 1e-6) {  // parallel
        if (cosine > 0) return first.volume < second.volume ? first : second;
        SpacePart slab = first;
        slab += second;
        slab = slab - all;
        return slab.volume > 0 ? slab : SpacePart{};
    }
    // The point of the line where both vanish that is nearest to the middle.
    double const a = (two.offset * cosine - one.offset) / sine2, b = (one.offset * cosine - two.offset) / sine2;
    std::array<Linear, 2> const planes{one, two};
    return pyramids(half, a * one.slope + b * two.slope, planes);
}
}
