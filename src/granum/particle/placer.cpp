#include "granum/particle/placer.hpp"

#include <algorithm>
#include <cmath>

namespace granum::particle
{
Placer::Placer(Vec3 const& lower, Vec3 const& upper, double smallest, double largest)
    : lower_(lower), smallest_(smallest)
{
    Vec3 const size = upper - lower;
    double const most_cells = 2e6;  // of a level: bounds the memory where few small spheres lie in a large box
    double const least_edge =
        std::cbrt(std::max(size.x, 1e-12) * std::max(size.y, 1e-12) * std::max(size.z, 1e-12) / most_cells);
    for (double radius = smallest;; radius *= 2) {
        Level level;
        level.largest = std::min(2 * radius, std::max(largest, smallest)) * (1 + 1e-12);
        level.edge = std::max(2 * level.largest, least_edge);
        std::size_t count = 1;
        for (std::size_t d = 0; d < 3; ++d) {
            level.cells[d] = std::max(1L, static_cast<long>(size[d] / level.edge));
            count *= static_cast<std::size_t>(level.cells[d]);
        }
        level.first.assign(count, -1);
        levels_.push_back(std::move(level));
        if (2 * radius >= largest) break;
    }
}

std::array<long, 3> Placer::cell_of(Level const& level, Vec3 const& x) const
{
    std::array<long, 3> cell{};
    for (std::size_t d = 0; d < 3; ++d)
        cell[d] = std::clamp(static_cast<long>(std::floor((x[d] - lower_[d]) / level.edge)), 0L, level.cells[d] - 1);
    return cell;
}

void Placer::add(Vec3 const& centre, double radius)
{
    auto const octave = static_cast<long>(std::floor(std::log2(std::max(1.0, radius / smallest_))));
    auto at = static_cast<std::size_t>(std::clamp(octave, 0L, static_cast<long>(levels_.size()) - 1));
    auto& level = levels_[at];
    level.largest = std::max(level.largest, radius);
    auto const [i, j, k] = cell_of(level, centre);
    auto& first = level.first[static_cast<std::size_t>((k * level.cells[1] + j) * level.cells[0] + i)];
    spheres_.push_back({centre, radius, first});
    first = static_cast<std::int32_t>(spheres_.size()) - 1;
}

bool Placer::free(Vec3 const& centre, double radius) const
{
    for (auto const& level : levels_) {
        double const reach = radius + level.largest;
        auto const low = cell_of(level, centre - Vec3{reach, reach, reach});
        auto const high = cell_of(level, centre + Vec3{reach, reach, reach});
        for (long k = low[2]; k <= high[2]; ++k)
            for (long j = low[1]; j <= high[1]; ++j)
                for (long i = low[0]; i <= high[0]; ++i)
                    for (auto at = level.first[static_cast<std::size_t>((k * level.cells[1] + j) * level.cells[0] + i)];
                         at >= 0; at = spheres_[static_cast<std::size_t>(at)].next) {
                        auto const& other = spheres_[static_cast<std::size_t>(at)];
                        double const sum = radius + other.radius;
                        if (norm2(centre - other.centre) <= sum * sum) return false;
                    }
    }
    return true;
}

std::optional<Vec3> Placer::place(double radius, Vec3 const& low, Vec3 const& high, base::Random& random, int trials,
                                  std::function<bool(Vec3 const&)> const& accepted)
{
    for (int trial = 0; trial < trials; ++trial) {
        Vec3 centre;
        for (std::size_t d = 0; d < 3; ++d) centre[d] = low[d] + random.uniform() * (high[d] - low[d]);
        if (!free(centre, radius) || !accepted(centre)) continue;
        add(centre, radius);
        return centre;
    }
    return std::nullopt;
}
}
