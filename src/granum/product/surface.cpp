#include "granum/product/surface.hpp"

#include "granum/math/constants.hpp"
#include "granum/math/random_direction.hpp"

#include <algorithm>
#include <cmath>

namespace granum::product
{
using math::Vec3;

namespace
{
constexpr double golden_angle = 2.39996322972865332;  // pi (3 - sqrt 5)

struct Spread
{
    double mean, variation;
};

//! Mean of numbers and standard deviation over it.
template <class Values>
Spread spread(Values const& values, double degrees_of_freedom)
{
    double sum = 0, square = 0;
    for (double const x : values) sum += x;
    double const mean = sum / static_cast<double>(values.size());
    for (double const x : values) square += (x - mean) * (x - mean);
    return {mean, mean > 0 && degrees_of_freedom > 0 ? std::sqrt(square / degrees_of_freedom) / mean : 0};
}
}

Surface::Surface(std::size_t panels) : thickness_(panels, 0.0) {}

Vec3 Surface::middle(std::size_t panel) const
{
    double const z = 1 - (2 * static_cast<double>(panel) + 1) / static_cast<double>(thickness_.size());
    double const side = std::sqrt(1 - z * z), turn = golden_angle * static_cast<double>(panel);
    return {side * std::cos(turn), side * std::sin(turn), z};
}

void Surface::add(Vec3 const& direction, double radius, double base_radius, double volume)
{
    double const angle = std::min(base_radius / radius, math::pi), reach = std::cos(angle);
    double const height = volume / (2 * math::pi * radius * radius * (1 - reach));
    // Panels follow each other by height: only those between the highest and the lowest point of the disc are asked.
    double const polar = std::acos(std::clamp(direction.z, -1.0, 1.0));
    double const top = std::cos(std::max(polar - angle, 0.0)), bottom = std::cos(std::min(polar + angle, math::pi));
    auto const count = static_cast<double>(thickness_.size());
    auto const at = [&](double z) { return std::clamp((count * (1 - z) - 1) / 2, 0.0, count - 1); };
    auto const first = static_cast<std::size_t>(std::floor(at(top)));
    auto const last = static_cast<std::size_t>(std::ceil(at(bottom)));
    for (std::size_t panel = first; panel <= last; ++panel)
        if (math::dot(middle(panel), direction) >= reach) thickness_[panel] += height;
}

double Surface::coverage() const
{
    auto const under = std::count_if(thickness_.begin(), thickness_.end(), [](double h) { return h > 0; });
    return static_cast<double>(under) / static_cast<double>(thickness_.size());
}

double Surface::mean_thickness() const
{
    return spread(thickness_, 0).mean;
}

double Surface::variation() const
{
    return spread(thickness_, static_cast<double>(thickness_.size())).variation;
}

void fall(Surface& surface, Fall const& what, base::Random& random)
{
    for (long n = random.poisson(what.per_granule); n > 0; --n)
        surface.add(math::random_direction(random), what.radius, what.base_radius, what.volume);
}

SurfaceStatistics statistics(std::vector<Surface> const& sample)
{
    SurfaceStatistics out{.granules = sample.size()};
    if (sample.empty()) return out;
    auto const count = static_cast<double>(sample.size());
    double coated = 0;
    std::vector<double> means;
    for (auto const& surface : sample) {
        means.push_back(surface.mean_thickness());
        out.coverage += surface.coverage() / count;
        if (means.back() == 0) continue;
        ++coated;
        out.variation_within += surface.variation();
    }
    if (coated > 0) out.variation_within /= coated;
    auto const between = spread(means, count - 1);
    out.mean_thickness = between.mean, out.variation_between = between.variation;
    return out;
}
}
