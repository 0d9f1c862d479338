#include "granum/particle/generate.hpp"

#include "granum/base/error.hpp"
#include "granum/base/random.hpp"
#include "granum/math/constants.hpp"
#include "granum/particle/placer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace granum::particle
{
namespace
{
using math::Vec3;

// Point in the ball of `size`, uniform.
Vec3 jitter(double size, std::uint32_t seed, std::uint64_t site)
{
    base::Random random(seed, base::Purpose::packing, site, 0);
    double const height = 2 * random.uniform() - 1, angle = 2 * math::pi * random.uniform();
    double const flat = std::sqrt(1 - height * height), length = size * std::cbrt(random.uniform());
    return {length * flat * std::cos(angle), length * flat * std::sin(angle), length * height};
}

std::vector<Vec3> fill(geometry::Chamber const& chamber, double radius, double spacing, double move, long count,
                       std::uint32_t seed)
{
    std::vector<Vec3> out;
    Vec3 const low = chamber.lower(), high = chamber.upper();
    double const start = radius * (1 + 1e-9) + move;  // a hair off the wall
    double const row = spacing * std::sqrt(3.0) / 2, layer = spacing * std::sqrt(2.0 / 3.0);
    std::uint64_t site = 0;
    int k = 0;
    for (double z = low.z + start; z <= high.z - radius; z += layer, ++k) {
        // Every second layer sits over the gaps of the one below.
        Vec3 const shift = k % 2 == 0 ? Vec3{} : Vec3{spacing / 2, row / 3, 0};
        int j = 0;
        for (double y = low.y + start + shift.y; y <= high.y - radius; y += row, ++j)
            for (double x = low.x + start + shift.x + (j % 2) * spacing / 2; x <= high.x - radius; x += spacing) {
                Vec3 const centre = Vec3{x, y, z} + (move > 0 ? jitter(move, seed, site) : Vec3{});
                ++site;
                if (!chamber.inside(centre, radius)) continue;
                if (static_cast<long>(out.size()) == count) return out;
                out.push_back(centre);
            }
    }
    base::require(static_cast<long>(out.size()) == count,
                  "{} spheres of {:.4g} m do not fit into the chamber: {} found room before the outlet was reached",
                  count, 2 * radius, out.size());
    return out;
}
}

std::vector<Vec3> random_loose(geometry::Chamber const& chamber, double radius, long count, std::uint32_t seed)
{
    double const touching = math::pi / std::sqrt(18.0), solids = 0.40;
    double const spacing = 2 * radius * std::cbrt(touching / solids);
    return fill(chamber, radius, spacing, 0.5 * spacing - radius, count, seed);
}

std::vector<Vec3> lattice(geometry::Chamber const& chamber, double radius, double spacing, long count, double noise,
                          std::uint32_t seed)
{
    return fill(chamber, radius, spacing, noise * (0.5 * spacing - radius), count, seed);
}

std::vector<Vec3> random_places(Region const& region, std::span<double const> radii, std::uint32_t seed)
{
    std::vector<Vec3> out(radii.size());
    if (radii.empty()) return out;
    std::vector<std::uint32_t> order(radii.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return radii[a] > radii[b]; });
    double const largest = radii[order.front()], smallest = radii[order.back()],
                 height = region.upper.z - region.lower.z;
    double volume = 0;
    for (double const radius : radii) volume += 4.0 / 3.0 * math::pi * radius * radius * radius;

    // How much of the box is open is not known beforehand: what fails makes the part that is filled grow.
    constexpr double solids = 0.30, growth = 1.05;
    constexpr int trials = 3000;
    Vec3 const size = region.upper - region.lower;
    double filled = std::min(height, std::max(4 * largest, volume / solids / (size.x * size.y)));
    Placer placer(region.lower, region.upper, smallest, largest);
    for (auto const row : order) {
        double const radius = radii[row];
        base::Random random(seed, base::Purpose::packing, row, 1);
        for (;;) {
            Vec3 const margin{radius, radius, radius};
            Vec3 const low = region.lower + margin;
            Vec3 high = region.upper - margin;
            high.z = std::max(low.z, region.lower.z + filled - radius);
            auto const place = placer.place(radius, low, high, random, trials,
                                            [&](Vec3 const& centre) { return region.allowed(centre, radius); });
            if (place) {
                out[row] = *place;
                break;
            }
            base::require(
                filled < height,
                "{} spheres of {:.4g} to {:.4g} m do not fit into the region from ({:.4g}, {:.4g}, {:.4g}) to "
                "({:.4g}, {:.4g}, {:.4g}) m",
                radii.size(), 2 * smallest, 2 * largest, region.lower.x, region.lower.y, region.lower.z, region.upper.x,
                region.upper.y, region.upper.z);
            filled = std::min(height, filled * growth);
        }
    }
    return out;
}
}
