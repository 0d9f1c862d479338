#include "granum/particle/sizes.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace granum::particle
{
namespace
{
constexpr std::size_t classes = 2000;  // of a law: fine enough that its moments hold to 1e-6

double cube(double x)
{
    return x * x * x;
}

// Share of each class [d_k, d_k+1], from a cumulative law.
std::vector<double> class_shares(std::vector<double> const& edges, std::function<double(double)> const& cumulative)
{
    std::vector<double> shares;
    for (std::size_t k = 0; k + 1 < edges.size(); ++k)
        shares.push_back(std::max(0.0, cumulative(edges[k + 1]) - cumulative(edges[k])));
    return shares;
}

// Shares by number of classes with shares by mass: divided by the mean cube of diameters spread evenly in the class.
void to_number(std::vector<double> const& edges, std::vector<double>& shares)
{
    for (std::size_t k = 0; k < shares.size(); ++k) {
        double const low = edges[k], high = edges[k + 1];
        shares[k] /= 0.25 * (low + high) * (low * low + high * high);
    }
}

std::vector<double> even_edges(double low, double high)
{
    std::vector<double> edges(classes + 1);
    for (std::size_t k = 0; k <= classes; ++k)
        edges[k] = low + (high - low) * static_cast<double>(k) / static_cast<double>(classes);
    return edges;
}
}

SizeDistribution::SizeDistribution(std::vector<double> diameters, std::vector<double> shares, bool stepwise)
    : diameters_(std::move(diameters)), stepwise_(stepwise)
{
    double const sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    base::require(sum > 0 && std::isfinite(sum), "a size distribution has no granules between {:.4g} and {:.4g} m",
                  diameters_.front(), diameters_.back());
    double running = 0, square = 0;
    if (!stepwise) cumulative_.push_back(0), mass_cumulative_.push_back(0);
    for (std::size_t k = 0; k < shares.size(); ++k) {
        double const share = shares[k] / sum;
        cumulative_.push_back(std::min(1.0, running += share));
        double const low = diameters_[k], high = stepwise ? low : diameters_[k + 1];
        mean_cube_ += share * 0.25 * (low + high) * (low * low + high * high);
        mass_cumulative_.push_back(mean_cube_);
        square += share * (low * low + low * high + high * high) / 3;
    }
    cumulative_.back() = 1;
    for (double& share : mass_cumulative_) share /= mean_cube_;
    sauter_ = mean_cube_ / square;
}

SizeDistribution SizeDistribution::single(double diameter)
{
    return {{diameter}, {1}, true};
}

SizeDistribution SizeDistribution::list(std::vector<double> const& diameters, std::vector<double> const& shares,
                                        Weighting weighting)
{
    std::vector<std::size_t> order(diameters.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return diameters[a] < diameters[b]; });
    std::vector<double> sorted, number;
    for (auto const k : order) {
        sorted.push_back(diameters[k]);
        number.push_back(weighting == Weighting::mass ? shares[k] / cube(diameters[k]) : shares[k]);
    }
    return {sorted, number, true};
}

SizeDistribution SizeDistribution::table(std::vector<double> const& diameters, std::vector<double> const& cumulative,
                                         Weighting weighting)
{
    // Each interval is refined, because what is straight by mass is not straight by number.
    constexpr std::size_t parts = 50;
    std::vector<double> edges{diameters.front()}, shares;
    for (std::size_t k = 0; k + 1 < diameters.size(); ++k)
        for (std::size_t part = 1; part <= parts; ++part) {
            edges.push_back(diameters[k] +
                            (diameters[k + 1] - diameters[k]) * static_cast<double>(part) / static_cast<double>(parts));
            shares.push_back((cumulative[k + 1] - cumulative[k]) / static_cast<double>(parts));
        }
    if (weighting == Weighting::mass) to_number(edges, shares);
    return {edges, shares, false};
}

SizeDistribution SizeDistribution::uniform(double low, double high, Weighting weighting)
{
    return table({low, high}, {0, 1}, weighting);
}

SizeDistribution SizeDistribution::normal(double mean, double deviation, double low, double high, Weighting weighting)
{
    auto const edges = even_edges(low, high);
    auto shares =
        class_shares(edges, [&](double d) { return 0.5 * std::erfc((mean - d) / (deviation * std::sqrt(2))); });
    if (weighting == Weighting::mass) to_number(edges, shares);
    return {edges, shares, false};
}

SizeDistribution SizeDistribution::log_normal(double median, double spread, double low, double high,
                                              Weighting weighting)
{
    auto const edges = even_edges(low, high);
    double const width = std::log(spread) * std::sqrt(2);
    auto shares = class_shares(edges, [&](double d) { return 0.5 * std::erfc(std::log(median / d) / width); });
    if (weighting == Weighting::mass) to_number(edges, shares);
    return {edges, shares, false};
}

SizeDistribution SizeDistribution::rosin_rammler(double characteristic, double exponent, double low, double high,
                                                 Weighting weighting)
{
    auto const edges = even_edges(low, high);
    auto shares = class_shares(edges, [&](double d) { return -std::expm1(-std::pow(d / characteristic, exponent)); });
    if (weighting == Weighting::mass) to_number(edges, shares);
    return {edges, shares, false};
}

double SizeDistribution::diameter(double u) const
{
    return quantile(cumulative_, u, 1);
}

double SizeDistribution::mass_diameter(double u) const
{
    // Diameters are spread evenly by number between two points, so the mass below one grows with its fourth power.
    return quantile(mass_cumulative_, u, 4);
}

double SizeDistribution::quantile(std::vector<double> const& cumulative, double u, int power) const
{
    auto const at = std::upper_bound(cumulative.begin(), cumulative.end(), u);
    if (at == cumulative.end()) return diameters_.back();
    auto const k = static_cast<std::size_t>(at - cumulative.begin());
    if (stepwise_) return diameters_[k];
    if (k == 0) return diameters_.front();
    double const part = (u - cumulative[k - 1]) / (cumulative[k] - cumulative[k - 1]);
    if (power == 1) return diameters_[k - 1] + part * (diameters_[k] - diameters_[k - 1]);
    double const low = std::pow(diameters_[k - 1], power), high = std::pow(diameters_[k], power);
    return std::pow(low + part * (high - low), 1.0 / power);
}
}
