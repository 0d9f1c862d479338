// Lines of sight in a region, by steps that no wall can be within.
#include "granum/geometry/region.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
bool Region::blocked(Vec3 const& a, Vec3 const& b) const
{
    // On a seam of joined solids the distance is 0 without a wall: round-off is no wall, and the line hops over it.
    double const round_off = 1e-12 * size_;
    double const from = distance(a), to = distance(b);
    if (from < -round_off || to < -round_off) return true;
    double const length = norm(b - a);
    if (from + to > length) return false;
    double const end = length - to;  // the rest is open
    double hop = 1e-9 * size_;
    double gone = from;
    for (int step = 0; gone < end; ++step) {
        double const free = distance(a + (gone / length) * (b - a));
        if (free < -round_off) return true;
        if (step == 10000) hop = std::max(hop, 1e-4 * length);
        // A line within a seam has no free step at all: it looks at ever wider distances.
        if (free <= round_off) hop = std::min(2 * hop, std::max(hop, 2e-4 * length));
        gone += std::max(free, hop);
    }
    return false;
}

std::optional<Vec3> open_place(Region const& region, Vec3 const& low, Vec3 const& high)
{
    Vec3 const size = high - low, middle = 0.5 * (low + high);
    Vec3 const start = middle + Vec3{0.013 * size.x, 0.023 * size.y, 0.019 * size.z};
    auto const within = [&](Vec3 const& x) {
        for (std::size_t d = 0; d < 3; ++d)
            if (x[d] < low[d] || x[d] > high[d]) return false;
        return true;
    };
    Vec3 x = start;
    for (int step = 0; step < 8; ++step) {
        auto const wall = region.at(x);
        if (wall.distance > 0) return x;
        x += (-wall.distance + 0.01 * std::min({size.x, size.y, size.z})) * wall.normal;
        if (!within(x)) break;
    }
    // The way out of the wall leads out of the box: the last place within it, or the most open of a few.
    for (std::size_t d = 0; d < 3; ++d) x[d] = std::clamp(x[d], low[d] + 1e-3 * size[d], high[d] - 1e-3 * size[d]);
    if (region.distance(x) > 0) return x;
    std::optional<Vec3> best;
    double farthest = 0;
    for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
            for (int k = -1; k <= 1; ++k) {
                Vec3 const at = middle + 0.45 * Vec3{i * size.x, j * size.y, k * size.z};
                double const free = region.distance(at);
                if (free > farthest) farthest = free, best = at;
            }
    return best;
}
}
