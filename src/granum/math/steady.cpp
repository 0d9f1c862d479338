#include "granum/math/steady.hpp"

#include <cmath>

namespace granum::math
{
namespace
{
//! Standard error of the mean from means of blocks of `size` values; what is left over at the end is not used.
double blocked(std::span<double const> series, std::size_t size)
{
    std::size_t const blocks = series.size() / size;
    double sum = 0, square = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        double mean = 0;
        for (std::size_t k = 0; k < size; ++k) mean += series[b * size + k] / static_cast<double>(size);
        sum += mean, square += mean * mean;
    }
    auto const count = static_cast<double>(blocks);
    double const variance = std::max(0.0, square / count - sum * sum / (count * count)) * count / (count - 1);
    return std::sqrt(variance / count);
}
}

double error_of_mean(std::span<double const> series)
{
    if (series.size() < 2) return 0;
    double const single = blocked(series, 1);
    if (single == 0) return 0;
    double error = single;
    for (std::size_t size = 1; series.size() / size >= 8 || size == 1; ++size) {
        error = blocked(series, size);
        double const b = static_cast<double>(size);
        if (b * b * b > 2 * static_cast<double>(series.size()) * std::pow(error / single, 4)) break;
    }
    return error;
}

Steady steady_part(std::span<double const> series)
{
    Steady out;
    std::size_t const n = series.size();
    if (n == 0) return out;
    // From the end backwards: sums of what would be left.
    double sum = 0, square = 0, best = -1;
    for (std::size_t start = n; start-- > 0;) {
        sum += series[start], square += series[start] * series[start];
        if (start > n / 2) continue;
        auto const left = static_cast<double>(n - start);
        double const spread = std::max(0.0, square - sum * sum / left) / (left * left);
        if (best < 0 || spread <= best) best = spread, out.start = start;
    }
    if (n < 8) out.start = 0;
    auto const rest = series.subspan(out.start);
    for (double const value : rest) out.mean += value / static_cast<double>(rest.size());
    out.error = error_of_mean(rest);
    out.settled = n >= 8 && out.start < n / 2;
    return out;
}
}
