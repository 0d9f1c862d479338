#include "granum/particle/overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace granum::particle
{
Overlaps overlaps(std::span<math::Vec3 const> centres, std::span<double const> radii)
{
    Overlaps out;
    if (centres.empty()) return out;
    double const edge = 2 * *std::max_element(radii.begin(), radii.end());
    using Cell = std::array<std::int64_t, 3>;
    struct Entry
    {
        Cell cell;
        std::size_t at;
    };
    std::vector<Entry> sorted(centres.size());
    for (std::size_t k = 0; k < centres.size(); ++k) {
        for (std::size_t d = 0; d < 3; ++d)
            sorted[k].cell[d] = static_cast<std::int64_t>(std::floor(centres[k][d] / edge));
        sorted[k].at = k;
    }
    std::sort(sorted.begin(), sorted.end(), [](auto const& a, auto const& b) { return a.cell < b.cell; });
    auto const begin_of = [&](Cell const& cell) {
        return std::lower_bound(sorted.begin(), sorted.end(), cell,
                                [](auto const& e, auto const& c) { return e.cell < c; });
    };
    for (auto const& one : sorted)
        for (std::int64_t i = -1; i <= 1; ++i)
            for (std::int64_t j = -1; j <= 1; ++j) {
                // The three cells along the last axis lie one after the other in the order.
                Cell const low{one.cell[0] + i, one.cell[1] + j, one.cell[2] - 1};
                Cell const high{low[0], low[1], one.cell[2] + 1};
                for (auto other = begin_of(low); other != sorted.end() && other->cell <= high; ++other) {
                    if (other->at <= one.at) continue;
                    double const sum = radii[one.at] + radii[other->at];
                    double const apart2 = norm2(centres[one.at] - centres[other->at]);
                    if (apart2 >= sum * sum) continue;
                    ++out.pairs;
                    double const deep = (sum - std::sqrt(apart2)) / std::min(radii[one.at], radii[other->at]);
                    if (deep > out.deepest) out = {out.pairs, deep, one.at, other->at};
                }
            }
    return out;
}
}
