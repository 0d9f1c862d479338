#include "granum/map/fit.hpp"

#include "granum/base/error.hpp"
#include "granum/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace granum::map
{
namespace
{
constexpr int draws = 200;  // of the bootstrap
constexpr double within_95 = 1.959964;

Point point(Sums const& sums, double potential)
{
    return {.potential = potential, .scores = scores(sums), .histogram = histogram(sums)};
}

double value(Model const& model, Point const& at)
{
    return std::visit([&](auto const& one) { return one.value(at); }, model);
}

Estimate estimate(Model const& model, Point const& at)
{
    return std::visit([&](auto const& one) { return one.predict(at); }, model);
}

//! Variance of a model's answer for a run because it was short.
double sampling_variance(Model const& model, Features const& features, double potential, std::uint32_t seed,
                         std::uint64_t run)
{
    if (features.blocks.size() < 2) return 0;
    base::Random random(seed, base::Purpose::bootstrap, run, 0);
    double sum = 0, square = 0;
    for (int n = 0; n < draws; ++n) {
        double const one = value(model, point(features.drawn(random), potential));
        sum += one, square += one * one;
    }
    double const blocks = static_cast<double>(features.blocks.size());
    return std::max(0.0, square / draws - std::pow(sum / draws, 2)) * blocks / (blocks - 1);
}

std::vector<Observed> observed(std::vector<LabRun> const& runs)
{
    std::vector<Observed> out;
    for (auto const& run : runs) out.push_back({point(run.features.total(), run.potential), run.value, run.error});
    return out;
}

Model fitted(Model model, std::vector<Observed> const& all, Known const& known)
{
    std::visit([&](auto& one) { one.fit(all, known); }, model);
    return model;
}

//! Errors of the measurements with those of the runs' own length, as the model sees them.
std::vector<Observed> with_sampling(Model const& model, std::vector<Observed> all, std::vector<LabRun> const& runs,
                                    std::uint32_t seed)
{
    for (std::size_t k = 0; k < all.size(); ++k)
        all[k].error = std::sqrt(runs[k].error * runs[k].error +
                                 sampling_variance(model, runs[k].features, runs[k].potential, seed, k));
    return all;
}

Comparison compared(Model const& empty, std::vector<Observed> const& all, Known const& known)
{
    Comparison out;
    out.model = base::card_of(empty).name;
    auto const count = static_cast<double>(all.size());
    auto const scale = scale_of(all);
    double square = 0, fourth = 0, variance = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
        std::vector<Observed> others = all;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        auto const answer = estimate(fitted(empty, others, known), all[k].at);
        double const missed = answer.mean - all[k].value;
        out.predicted.push_back(answer.mean);
        out.deviation.push_back(std::sqrt(answer.variance + all[k].error * all[k].error));
        square += missed * missed / count, fourth += std::pow(missed, 4) / count;
        variance += std::pow(all[k].value - scale.mean, 2) / count;
        out.chi2 += std::pow(missed / out.deviation.back(), 2) / count;
    }
    out.rms = std::sqrt(square);
    if (square > 0) out.error = std::sqrt(std::max(0.0, fourth - square * square) / count) / (2 * out.rms);
    out.r2 = variance > 0 ? 1 - square / variance : 0;
    return out;
}
}

Eigen::VectorXd Map::support() const
{
    Eigen::VectorXd most = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(known.axes.nodes()));
    for (auto const& run : runs) most = most.cwiseMax(histogram(run.features.total()));
    return most;
}

Map fit(std::string property, std::string unit, Known known, std::vector<LabRun> runs, Wanted const& wanted)
{
    base::require(runs.size() >= 3, "a map needs at least three runs with a measured property, not {}", runs.size());
    Map out{
        .property = std::move(property), .unit = std::move(unit), .known = std::move(known), .runs = std::move(runs)};
    auto const raw = observed(out.runs);
    for (auto const& name : wanted.models) {
        auto const empty = Models::make(name);
        base::require(empty.has_value(), "there is no model {}", name);
        auto const all = with_sampling(fitted(*empty, raw, out.known), raw, out.runs, wanted.seed);
        out.models.push_back(fitted(*empty, all, out.known));
        if (wanted.compare) out.comparisons.push_back(compared(*empty, all, out.known));
    }
    return out;
}

std::optional<product::Percentiles> over_granules(Map const& map, Deposits const& deposits)
{
    auto const* additive = std::get_if<Additive>(&map.models[map.chosen]);
    if (!additive) return std::nullopt;
    auto const& axes = map.known.axes;
    Eigen::VectorXd const property = additive->at_nodes();
    std::vector<std::vector<double> const*> columns;
    for (auto const& axis : axes.axes) columns.push_back(&deposits.of(axis.variable));
    std::map<double, std::pair<double, double>> layers;  // solids, and solids times property, by granule
    std::vector<double> at(columns.size());
    for (std::size_t row = 0; row < deposits.size(); ++row) {
        for (std::size_t a = 0; a < columns.size(); ++a) at[a] = (*columns[a])[row];
        auto& [solids, weighted] = layers[deposits.granule[row]];
        solids += deposits.solids[row], weighted += deposits.solids[row] * axes.at(at, property);
    }
    std::vector<double> values, weights;
    for (auto const& [granule, sums] : layers)
        values.push_back(sums.second / sums.first), weights.push_back(sums.first);
    return product::percentiles(values, weights);
}

double extrapolation_index(Eigen::VectorXd const& support, Eigen::VectorXd const& histogram)
{
    return 1 - support.cwiseMin(histogram).sum();
}

double Prediction::deviation() const
{
    return std::sqrt(regression * regression + sampling * sampling + parameters * parameters);
}

Shift shift(Map const& map, std::pair<Features, double> const& from, std::pair<Features, double> const& to,
            std::uint32_t seed)
{
    auto const& model = map.models[map.chosen];
    auto const a = point(from.first.total(), from.second), b = point(to.first.total(), to.second);
    double variance = std::visit([&](auto const& one) { return one.shift_variance(a, b); }, model);
    variance = std::max(0.0, variance) + sampling_variance(model, from.first, from.second, seed, 1000) +
               sampling_variance(model, to.first, to.second, seed, 1001);
    return {value(model, b) - value(model, a), std::sqrt(variance)};
}

Prediction predict(Map const& map, std::vector<std::pair<Features, double>> const& runs, std::uint32_t seed)
{
    base::require(!runs.empty(), "nothing to predict: no run");
    auto const& model = map.models[map.chosen];
    auto const support = map.support();
    auto const count = static_cast<double>(runs.size());
    Prediction out;
    double square = 0, regression = 0, sampling = 0;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        auto const& [features, potential] = runs[k];
        auto const at = point(features.total(), potential);
        auto const answer = estimate(model, at);
        out.mean += answer.mean / count;
        square += answer.mean * answer.mean / count;
        regression += answer.variance / count;
        sampling += sampling_variance(model, features, potential, seed, 1000 + k) / count;
        out.extrapolation = std::max(out.extrapolation, extrapolation_index(support, at.histogram));
    }
    out.regression = std::sqrt(std::max(0.0, regression));
    out.sampling = std::sqrt(sampling);
    if (runs.size() > 1) out.parameters = std::sqrt(std::max(0.0, square - out.mean * out.mean) * count / (count - 1));
    out.low = std::max(map.known.low, out.mean - within_95 * out.deviation());
    out.high = std::min(map.known.high, out.mean + within_95 * out.deviation());
    return out;
}
}
