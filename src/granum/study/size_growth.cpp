#include "granum/study/size_growth.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace granum::study
{
SizeGrowth size_growth(io::GranuleView const& g)
{
    constexpr std::size_t groups = 6;
    SizeGrowth out;
    std::vector<std::size_t> order(std::min(g.diameter.size(), g.layer_mass.size()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return g.diameter[a] < g.diameter[b]; });
    if (order.empty() || g.diameter[order.back()] < 1.1 * g.diameter[order.front()]) return out;
    auto const surface = [&](std::size_t k) { return g.count[k] * g.diameter[k] * g.diameter[k]; };
    double const all =
        std::accumulate(order.begin(), order.end(), 0.0, [&](double s, auto k) { return s + surface(k); });
    std::array<double, groups> area{}, layer{}, size{};
    double passed = 0;
    for (auto const k : order) {
        auto const group = std::min(groups - 1, static_cast<std::size_t>(groups * passed / all));
        passed += surface(k);
        area[group] += surface(k), layer[group] += g.layer_mass[k], size[group] += surface(k) * std::log(g.diameter[k]);
    }
    double mean_x = 0, mean_y = 0;
    std::array<double, groups> x{}, y{};
    for (std::size_t b = 0; b < groups; ++b) {
        if (area[b] == 0 || layer[b] <= 0) return out;
        x[b] = size[b] / area[b], y[b] = std::log(layer[b] / area[b]);
        mean_x += x[b] / groups, mean_y += y[b] / groups;
    }
    double xx = 0, xy = 0, rest = 0;
    for (std::size_t b = 0; b < groups; ++b) xx += std::pow(x[b] - mean_x, 2), xy += (x[b] - mean_x) * (y[b] - mean_y);
    if (xx == 0) return out;
    out.exponent = xy / xx;
    for (std::size_t b = 0; b < groups; ++b) rest += std::pow(y[b] - mean_y - out.exponent * (x[b] - mean_x), 2);
    out.error = std::sqrt(rest / (groups - 2) / xx);
    out.known = true;
    return out;
}
}
