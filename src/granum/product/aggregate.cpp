#include "granum/product/aggregate.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace granum::product
{
void LayerSum::add(double solids_mass, Prediction const& prediction)
{
    double const scatter = solids_mass * prediction.element;
    solids += solids_mass;
    weighted += solids_mass * prediction.mean;
    element_square += scatter * scatter;
    weighted_common += solids_mass * prediction.common;
}

LayerSum& LayerSum::operator+=(LayerSum const& other)
{
    solids += other.solids;
    weighted += other.weighted;
    element_square += other.element_square;
    weighted_common += other.weighted_common;
    return *this;
}

Prediction LayerSum::prediction() const
{
    if (solids <= 0) return {0, 0, 0};
    return {weighted / solids, std::sqrt(element_square) / solids, weighted_common / solids};
}

double percentile(std::span<double const> values, std::span<double const> weights, double share)
{
    base::require(values.size() == weights.size(), "percentile: {} values but {} weights", values.size(),
                  weights.size());
    double const total = std::accumulate(weights.begin(), weights.end(), 0.0);
    base::require(total > 0, "percentile: no weight in {} values", values.size());

    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });

    double const target = share * total;
    double below = 0, last_value = 0, last_position = 0;
    bool first = true;
    for (auto const sample : order) {
        if (weights[sample] <= 0) continue;
        double const position = below + 0.5 * weights[sample];
        if (position >= target) {
            if (first) return values[sample];
            return last_value + (values[sample] - last_value) * (target - last_position) / (position - last_position);
        }
        below += weights[sample];
        last_value = values[sample], last_position = position;
        first = false;
    }
    return last_value;
}

Percentiles percentiles(std::span<double const> values, std::span<double const> weights)
{
    return {percentile(values, weights, 0.1), percentile(values, weights, 0.5), percentile(values, weights, 0.9)};
}

BatchProperty batch_property(std::span<LayerSum const> granules)
{
    LayerSum all;
    std::vector<double> means, weights;
    for (auto const& granule : granules) {
        if (granule.solids <= 0) continue;
        all += granule;
        means.push_back(granule.prediction().mean);
        weights.push_back(granule.solids);
    }
    base::require(!means.empty(), "batch property: none of {} granules has a layer", granules.size());

    auto const mean = all.prediction();
    double const half = 1.959964 * std::hypot(mean.element, mean.common);
    return {mean, mean.mean - half, mean.mean + half, percentiles(means, weights)};
}

Percentiles size_percentiles(std::span<double const> diameters, std::span<double const> counts, Weighting weighting)
{
    std::vector<double> weights(counts.begin(), counts.end());
    if (weighting == Weighting::volume) {
        base::require(diameters.size() == counts.size(), "size percentiles: {} diameters but {} counts",
                      diameters.size(), counts.size());
        for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= diameters[i] * diameters[i] * diameters[i];
    }
    return percentiles(diameters, weights);
}
}
