#include "granum/map/scores_models.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace granum::map
{
namespace
{
constexpr double broad = 10;  // of the values' spread: what is thought of their mean beforehand

struct Values
{
    Eigen::VectorXd values, variances;
};

Values values_of(std::span<Observed const> observed, double mean)
{
    auto const count = static_cast<Eigen::Index>(observed.size());
    Values out{Eigen::VectorXd(count), Eigen::VectorXd(count)};
    for (Eigen::Index k = 0; k < count; ++k) {
        auto const& one = observed[static_cast<std::size_t>(k)];
        out.values[k] = one.value - mean;
        out.variances[k] = one.error * one.error;
    }
    return out;
}

double matern(double distance)
{
    double const x = std::sqrt(5.0) * distance;
    return (1 + x + x * x / 3) * std::exp(-x);
}
}

Scale scale_of(std::span<Observed const> observed)
{
    base::require(observed.size() >= 2, "a map needs at least two runs with a measured property");
    Scale out;
    for (auto const& one : observed) out.mean += one.value / static_cast<double>(observed.size());
    double square = 0;
    for (auto const& one : observed) square += std::pow(one.value - out.mean, 2) + one.error * one.error;
    out.spread = std::sqrt(square / static_cast<double>(observed.size()));
    return out;
}

Standard::Standard(std::span<Observed const> observed)
{
    auto const count = static_cast<double>(observed.size());
    auto const size = observed.front().at.scores.size();
    middle = width = Eigen::VectorXd::Zero(size);
    for (auto const& one : observed) middle += one.at.scores / count;
    for (auto const& one : observed) width += (one.at.scores - middle).cwiseAbs2() / count;
    width = width.cwiseSqrt();
    // What differs by rounding alone is the same.
    for (Eigen::Index k = 0; k < size; ++k)
        if (width[k] < 1e-9 * std::abs(middle[k])) width[k] = 0;
}

Eigen::VectorXd Standard::of(Point const& at) const
{
    Eigen::VectorXd out = at.scores - middle;
    for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = width[k] > 0 ? out[k] / width[k] : 0;
    return out;
}

Eigen::VectorXd LinearScores::row(Point const& at) const
{
    Eigen::VectorXd out(standard.middle.size() + 1);
    out[0] = 1;
    out.tail(out.size() - 1) = standard.of(at);
    return out;
}

void LinearScores::fit(std::span<Observed const> observed, Known const&)
{
    auto const scale = scale_of(observed);
    standard = Standard(observed);
    mean = scale.mean;
    auto const data = values_of(observed, mean);
    Eigen::MatrixXd rows(data.values.size(), standard.middle.size() + 1);
    for (Eigen::Index k = 0; k < rows.rows(); ++k)
        rows.row(k) = row(observed[static_cast<std::size_t>(k)].at).transpose();
    constexpr std::array widths{0.03, 0.1, 0.3, 1.0, 3.0};
    slopes = averaged(rows, data.values, data.variances, widths.size(), [&](std::size_t k) -> Eigen::MatrixXd {
        Eigen::VectorXd prior = Eigen::VectorXd::Constant(rows.cols(), std::pow(widths[k] * scale.spread, 2));
        prior[0] = std::pow(broad * scale.spread, 2);
        return prior.asDiagonal();
    });
}

Estimate LinearScores::predict(Point const& at) const
{
    Eigen::VectorXd const here = row(at);
    return {mean + here.dot(slopes.mean), here.dot(slopes.covariance * here)};
}

double LinearScores::shift_variance(Point const& from, Point const& to) const
{
    Eigen::VectorXd const way = row(to) - row(from);
    return way.dot(slopes.covariance * way);
}

void GaussianProcess::fit(std::span<Observed const> observed, Known const&)
{
    auto const scale = scale_of(observed);
    standard = Standard(observed);
    mean = scale.mean, constant = std::pow(broad * scale.spread, 2);
    auto const data = values_of(observed, mean);
    auto const count = data.values.size(), size = standard.middle.size();
    places.resize(size, count);
    for (Eigen::Index k = 0; k < count; ++k) places.col(k) = standard.of(observed[static_cast<std::size_t>(k)].at);

    constexpr std::array lengths{1.0, 2.0, 4.0, 8.0, 16.0};
    std::size_t combinations = 1;
    for (Eigen::Index a = 0; a < size; ++a) combinations *= lengths.size();
    choices.clear();
    std::vector<double> evidence;
    for (std::size_t c = 0; c < combinations; ++c) {
        Eigen::VectorXd own(size);
        std::size_t rest = c;
        for (Eigen::Index a = 0; a < size; ++a, rest /= lengths.size()) own[a] = lengths[rest % lengths.size()];
        Eigen::MatrixXd kernel(count, count);
        for (Eigen::Index i = 0; i < count; ++i)
            for (Eigen::Index j = 0; j < count; ++j)
                kernel(i, j) = matern((places.col(i) - places.col(j)).cwiseQuotient(own).norm());
        for (double const amplitude : {0.5, 1.0, 2.0, 4.0, 8.0}) {
            double const variance = std::pow(amplitude * scale.spread, 2);
            Eigen::MatrixXd covariance = (variance * kernel.array() + constant).matrix();
            covariance.diagonal() += data.variances;
            evidence.push_back(log_evidence(covariance, data.values));
            choices.push_back({0, own, variance, {}, std::move(covariance)});
        }
    }
    auto const share = weights(evidence);
    for (std::size_t k = 0; k < choices.size(); ++k) choices[k].share = share[k];
    std::erase_if(choices, [](Choice const& one) { return one.share == 0; });
    for (auto& one : choices) {
        one.inverse = one.inverse.llt().solve(Eigen::MatrixXd::Identity(count, count)).eval();
        one.solved = one.inverse * data.values;
    }
}

Estimate GaussianProcess::predict(Point const& at) const
{
    Eigen::VectorXd const here = standard.of(at);
    Estimate out{mean, 0};
    double square = 0;
    for (auto const& one : choices) {
        auto const with = with_measured(one, here);
        double const value = with.dot(one.solved);
        out.mean += one.share * value;
        square += one.share * value * value;
        out.variance += one.share * (constant + one.amplitude - with.dot(one.inverse * with));
    }
    out.variance = std::max(0.0, out.variance + square - std::pow(out.mean - mean, 2));
    return out;
}

Eigen::VectorXd GaussianProcess::with_measured(Choice const& choice, Eigen::VectorXd const& here) const
{
    Eigen::VectorXd out(places.cols());
    for (Eigen::Index k = 0; k < out.size(); ++k)
        out[k] = constant + choice.amplitude * matern((places.col(k) - here).cwiseQuotient(choice.lengths).norm());
    return out;
}

double GaussianProcess::shift_variance(Point const& from, Point const& to) const
{
    Eigen::VectorXd const a = standard.of(from), b = standard.of(to);
    double sum = 0, square = 0, out = 0;
    for (auto const& one : choices) {
        Eigen::VectorXd const way = with_measured(one, b) - with_measured(one, a);
        double const value = way.dot(one.solved);
        sum += one.share * value;
        square += one.share * value * value;
        out += one.share * (2 * one.amplitude * (1 - matern((a - b).cwiseQuotient(one.lengths).norm())) -
                            way.dot(one.inverse * way));
    }
    return std::max(0.0, out + square - sum * sum);
}
}
