#include "granum/geometry/cut_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::geometry
{
std::vector<std::array<double, 2>> cut_outline(Region const& region, double y, int squares)
{
    Vec3 const low = region.lower(), high = region.upper();
    double const edge = std::max(high.x - low.x, high.z - low.z) / squares;
    // One square more on every side: what bounds the region is crossed.
    int const nx = static_cast<int>(std::ceil((high.x - low.x) / edge)) + 2;
    int const nz = static_cast<int>(std::ceil((high.z - low.z) / edge)) + 2;
    auto const x_at = [&](int i) { return low.x + (i - 0.5) * edge; };
    auto const z_at = [&](int k) { return low.z + (k - 0.5) * edge; };
    auto const spot = [&](int i, int k) {
        return static_cast<std::size_t>(k) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
    };
    std::vector<double> distance(spot(0, nz));
    for (int k = 0; k < nz; ++k)
        for (int i = 0; i < nx; ++i) distance[spot(i, k)] = region.distance({x_at(i), y, z_at(k)});
    using Corner = std::array<double, 2>;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<Corner> out;
    for (int k = 0; k + 1 < nz; ++k)
        for (int i = 0; i + 1 < nx; ++i) {
            // Corners in turn, and where the wall crosses the sides between them.
            std::array<std::array<int, 2>, 4> const corners{{{i, k}, {i + 1, k}, {i + 1, k + 1}, {i, k + 1}}};
            std::vector<Corner> met;
            for (std::size_t c = 0; c < 4; ++c) {
                auto const &a = corners[c], &b = corners[(c + 1) % 4];
                double const from = distance[spot(a[0], a[1])], to = distance[spot(b[0], b[1])];
                if ((from > 0) == (to > 0)) continue;
                double const share = from / (from - to);
                met.push_back({std::lerp(x_at(a[0]), x_at(b[0]), share), std::lerp(z_at(a[1]), z_at(b[1]), share)});
            }
            for (std::size_t m = 0; m + 1 < met.size(); m += 2)
                out.insert(out.end(), {met[m], met[m + 1], Corner{none, none}});
        }
    return out;
}
}
