#include "granum/geometry/triangle_corners.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

namespace granum::geometry
{
namespace
{
struct Place
{
    std::int64_t x, y, z;
    bool operator==(Place const&) const = default;
};

struct PlaceHash
{
    std::size_t operator()(Place const& at) const
    {
        std::uint64_t hash = 0x9E3779B97F4A7C15u;
        for (std::int64_t const v : {at.x, at.y, at.z}) {
            hash ^= static_cast<std::uint64_t>(v);
            hash *= 0xBF58476D1CE4E5B9u;
            hash ^= hash >> 31;
        }
        return hash;
    }
};
}

Corners join_corners(std::span<Triangle const> triangles, double together)
{
    Corners out;
    out.of.reserve(triangles.size());
    // Points by cells four times as wide as `together`: a corner near the border of its cell looks beyond it as well.
    std::unordered_map<Place, std::vector<std::uint32_t>, PlaceHash> cells;
    cells.reserve(triangles.size());
    double const width = together > 0 ? 4 * together : 1e-12;
    auto const cell = [&](double v) { return static_cast<std::int64_t>(std::floor(v / width)); };
    auto const look = [&](Place const& at, Vec3 const& x) -> std::int64_t {
        auto const found = cells.find(at);
        if (found == cells.end()) return -1;
        for (std::uint32_t const point : found->second)
            if (out.points[point] == x || norm2(out.points[point] - x) < together * together) return point;
        return -1;
    };
    auto const point_of = [&](Vec3 const& x) {
        Place const home{cell(x.x), cell(x.y), cell(x.z)};
        Place const low{cell(x.x - together), cell(x.y - together), cell(x.z - together)};
        Place const high{cell(x.x + together), cell(x.y + together), cell(x.z + together)};
        if (auto const point = look(home, x); point >= 0) return static_cast<std::uint32_t>(point);
        for (std::int64_t i = low.x; i <= high.x; ++i)
            for (std::int64_t j = low.y; j <= high.y; ++j)
                for (std::int64_t k = low.z; k <= high.z; ++k)
                    if (auto const point = look({i, j, k}, x); point >= 0) return static_cast<std::uint32_t>(point);
        out.points.push_back(x);
        auto const point = static_cast<std::uint32_t>(out.points.size() - 1);
        cells[home].push_back(point);
        return point;
    };
    for (auto const& [a, b, c] : triangles) {
        std::uint32_t const i = point_of(a), j = point_of(b), k = point_of(c);
        out.of.push_back({i, j, k});
    }
    return out;
}

Edges find_edges(Corners const& corners)
{
    struct OneSide
    {
        std::uint32_t from, to;
        EdgeUse use;
    };
    std::vector<OneSide> sides;
    sides.reserve(3 * corners.of.size());
    for (std::uint32_t t = 0; t < corners.of.size(); ++t)
        for (std::uint8_t s = 0; s < 3; ++s) {
            std::uint32_t const a = corners.of[t][s], b = corners.of[t][(s + 1u) % 3];
            if (a != b) sides.push_back({std::min(a, b), std::max(a, b), {t, s, a < b}});
        }
    std::sort(sides.begin(), sides.end(), [](OneSide const& a, OneSide const& b) {
        return std::tie(a.from, a.to, a.use.triangle, a.use.side) < std::tie(b.from, b.to, b.use.triangle, b.use.side);
    });
    Edges out;
    out.uses.reserve(sides.size());
    for (auto const& side : sides) {
        if (out.edges.empty() || out.edges.back().from != side.from || out.edges.back().to != side.to)
            out.edges.push_back({side.from, side.to, static_cast<std::uint32_t>(out.uses.size()), 0});
        ++out.edges.back().count;
        out.uses.push_back(side.use);
    }
    return out;
}
}
