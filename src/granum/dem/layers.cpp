#include "granum/dem/layers.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
namespace
{
// No fewer rows to a layer, so that what begins a pass is little beside it.
constexpr double fewest_rows = 300;
}

// The layer is a distance over the thickness, and distances of two granules differ by no more than they are apart.
void Layers::make(Frame const& frame, Domain const& domain, par::Partition const& partition, int rank, double reach)
{
    std::size_t const owned = frame.owned;
    depth_.resize(owned);
    double most = 0;
    auto const others = partition.near(rank, reach);
    if (!others.empty()) {
        for (std::size_t row = 0; row < owned; ++row) {
            double nearest2 = partition.distance2(frame.position(row), others[0]);
            for (std::size_t k = 1; k < others.size(); ++k)
                nearest2 = std::min(nearest2, partition.distance2(frame.position(row), others[k]));
            depth_[row] = std::sqrt(nearest2);
            most = std::max(most, depth_[row]);
        }
    } else if (owned > 0) {
        // Along the longest side of what the granules fill; where that is periodic, from its middle both ways.
        Vec3 low = frame.position(0), high = low;
        for (std::size_t row = 1; row < owned; ++row)
            for (std::size_t d = 0; d < 3; ++d) {
                double const x = frame.bodies[row].position[d];
                low[d] = std::min(low[d], x), high[d] = std::max(high[d], x);
            }
        std::size_t along = 0;
        for (std::size_t d = 1; d < 3; ++d)
            if (high[d] - low[d] > high[along] - low[along]) along = d;
        double const from = domain.periodic[along] ? 0.5 * (domain.lower[along] + domain.upper[along]) : low[along];
        for (std::size_t row = 0; row < owned; ++row) {
            depth_[row] = std::abs(frame.bodies[row].position[along] - from);
            most = std::max(most, depth_[row]);
        }
    }
    // A part of a millionth more, so that rounding never brings two that touch two layers apart.
    double const most_layers =
        std::max(1.0, std::min(most / (reach * (1 + 1e-6)), static_cast<double>(owned) / fewest_rows));
    auto const layers = static_cast<std::size_t>(most_layers);
    double const scale = most > 0 ? static_cast<double>(layers) / most : 0;

    of_row_.assign(frame.rows(), 0);
    begin_.assign(layers + 1, 0);
    for (std::size_t row = 0; row < owned; ++row) {
        of_row_[row] =
            std::min(static_cast<std::uint32_t>(depth_[row] * scale), static_cast<std::uint32_t>(layers - 1));
        ++begin_[of_row_[row] + 1];
    }
    for (std::size_t k = 0; k < layers; ++k) begin_[k + 1] += begin_[k];
    rows_.resize(owned);
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t row = 0; row < owned; ++row) rows_[next[of_row_[row]]++] = static_cast<std::uint32_t>(row);
}
}
