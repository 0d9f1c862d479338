#include "granum/map/additive.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <map>
#include <vector>

namespace granum::map
{
namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

//! Differences of an order along an axis of a grid of nodes, squared, as a quadratic form; over the number of lines, so
//! that a function of that axis alone costs the same on any number of them. Nodes are 1 / (n - 1) apart: first
//! differences of a straight rise by 1 cost 1; second ones of a derivative of unit white noise have the variance h^3.
MatrixXd roughness(Index first, Index second, bool along_second, int order)
{
    Index const size = first * second;
    MatrixXd out = MatrixXd::Zero(size, size);
    Index const nodes = along_second ? second : first, lines = along_second ? first : second;
    Index const stride = along_second ? first : 1, line_stride = along_second ? 1 : first;
    double const h = 1 / static_cast<double>(nodes - 1);
    double const weight = 1 / ((order == 1 ? h : h * h * h) * static_cast<double>(lines));
    std::array<double, 3> const difference = order == 1 ? std::array{-1.0, 1.0, 0.0} : std::array{1.0, -2.0, 1.0};
    for (Index line = 0; line < lines; ++line)
        for (Index k = 0; k + order < nodes; ++k)
            for (Index a = 0; a <= order; ++a)
                for (Index b = 0; b <= order; ++b)
                    out(line * line_stride + (k + a) * stride, line * line_stride + (k + b) * stride) +=
                        weight * difference[static_cast<std::size_t>(a)] * difference[static_cast<std::size_t>(b)];
    return out;
}

//! An axis: its nodes, and the eighth powers of two that come nearest to the share of it over which the runs' means
//! lie.
struct Reach
{
    Index nodes = 1;
    int eighths = 0;

    double share() const { return std::exp2(eighths / 8.0); }
    auto operator<=>(Reach const&) const = default;
};

//! Prior covariances of nodes for a property of unit spread over the runs, one for each choice of shape.
std::vector<MatrixXd> const& priors(Reach const& along_first, Reach const& along_second)
{
    static std::map<std::pair<Reach, Reach>, std::vector<MatrixXd>> made;
    auto [found, fresh] = made.try_emplace({along_first, along_second});
    if (!fresh) return found->second;
    Index const first = along_first.nodes, second = along_second.nodes;
    // How far the property rises along an axis within the reach of the runs, and how far it bends away from that, in
    // its spread over the runs; along the second axis it may also not change at all.
    struct Shape
    {
        double rise, bend;
    };
    constexpr std::array shapes{Shape{1, 0.1}, Shape{3, 0.1}, Shape{1, 0.5}, Shape{3, 0.5}, Shape{3, 2}};
    constexpr std::array others{Shape{0.03, 0.1}, Shape{1, 0.1}, Shape{3, 0.1}, Shape{1, 0.5}, Shape{3, 0.5}};
    Index const size = first * second;
    MatrixXd const one = MatrixXd::Identity(size, size);
    auto const cost = [&](bool second_axis, Shape const& shape) -> MatrixXd {
        // From the reach of the runs, r, to the whole axis: a rise is steeper by 1 / r; white noise of intensity q as
        // second derivative bends by sqrt(q r^3 / 3).
        double const reach = (second_axis ? along_second : along_first).share();
        double const rise = shape.rise / reach, bend2 = 3 * shape.bend * shape.bend / (reach * reach * reach);
        return roughness(first, second, second_axis, 1) / (rise * rise) +
               roughness(first, second, second_axis, 2) / bend2;
    };
    for (auto const& shape : shapes)
        for (auto const& other : others) {
            // What is left open, the mean, is the caller's.
            MatrixXd precision = cost(false, shape) + one / (100.0 * static_cast<double>(size));
            if (second > 2) precision += cost(true, other);
            found->second.push_back(precision.llt().solve(one));
            if (second <= 2) break;
        }
    return found->second;
}

//! Rows and least values of: property within its limits, and in order along the first axis.
std::pair<MatrixXd, VectorXd> constraints(Known const& known, double mean)
{
    auto const size = static_cast<Index>(known.axes.nodes());
    Index const first = known.axes.axes.front().nodes;
    std::vector<std::pair<VectorXd, double>> rows;
    auto const row = [&](Index node, double sign) {
        VectorXd out = VectorXd::Zero(size);
        out[node] = sign;
        return out;
    };
    for (Index node = 0; node < size; ++node) {
        if (std::isfinite(known.low)) rows.emplace_back(row(node, 1), known.low - mean);
        if (std::isfinite(known.high)) rows.emplace_back(row(node, -1), mean - known.high);
        if (known.along_first == Monotone::free || node % first == first - 1) continue;
        double const sign = known.along_first == Monotone::rising ? 1 : -1;
        rows.emplace_back(row(node + 1, sign) + row(node, -sign), 0);
    }
    MatrixXd all(static_cast<Index>(rows.size()), size);
    VectorXd least(all.rows());
    for (Index k = 0; k < all.rows(); ++k) {
        all.row(k) = rows[static_cast<std::size_t>(k)].first.transpose();
        least[k] = rows[static_cast<std::size_t>(k)].second;
    }
    return {all, least};
}
}

VectorXd nearest_within(VectorXd const& middle, MatrixXd const& covariance, MatrixXd const& rows, VectorXd const& least,
                        double tolerance)
{
    MatrixXd const reach = covariance * rows.transpose();  // unknown x constraint
    MatrixXd const among = rows * reach;
    VectorXd const slack = rows * middle - least;
    double const ridge = 1e-13 * among.diagonal().maxCoeff();  // limits that say the same twice
    VectorXd multipliers = VectorXd::Zero(least.size());
    std::vector<Index> active;
    std::vector<bool> barred(static_cast<std::size_t>(least.size()), false);  // that rounding threw out again
    auto const on_limits = [&] {
        auto const size = static_cast<Index>(active.size());
        MatrixXd part(size, size);
        VectorXd wanted(size);
        for (Index i = 0; i < size; ++i) {
            wanted[i] = -slack[active[static_cast<std::size_t>(i)]];
            for (Index j = 0; j < size; ++j)
                part(i, j) = among(active[static_cast<std::size_t>(i)], active[static_cast<std::size_t>(j)]);
            part(i, i) += ridge;
        }
        return VectorXd(part.ldlt().solve(wanted));
    };
    long const most_steps = 20 * least.size() + 100;
    for (long step = 0; step < most_steps; ++step) {
        VectorXd const now = slack + among * multipliers;
        Index worst = -1;
        double off = tolerance;
        for (Index k = 0; k < least.size(); ++k)
            if (-now[k] > off && multipliers[k] == 0 && !barred[static_cast<std::size_t>(k)]) worst = k, off = -now[k];
        if (worst < 0) {
            if (now.minCoeff() < -std::max(1e3 * tolerance, 1e-6 * slack.cwiseAbs().maxCoeff())) break;
            return middle + reach * multipliers;
        }
        active.push_back(worst);
        // To the best point on these limits; those that would pull the other way are let go on the way there.
        while (!active.empty()) {
            VectorXd const best = on_limits();
            double part = 1;
            for (std::size_t i = 0; i < active.size(); ++i)
                if (double const has = multipliers[active[i]], wants = best[static_cast<Index>(i)]; wants <= 0)
                    part = std::min(part, has / (has - wants + 1e-300));
            for (std::size_t i = 0; i < active.size(); ++i)
                multipliers[active[i]] += part * (best[static_cast<Index>(i)] - multipliers[active[i]]);
            if (part == 1) break;
            std::size_t kept = 0;
            double const nothing = 1e-14 * multipliers.maxCoeff();
            for (Index const k : active) {
                if (multipliers[k] > nothing) {
                    active[kept++] = k;
                    continue;
                }
                multipliers[k] = 0;
                if (k == worst) barred[static_cast<std::size_t>(k)] = true;
            }
            active.resize(kept);
        }
        if (multipliers[worst] > 0) std::fill(barred.begin(), barred.end(), false);
    }
    throw base::NumericsError("no layer property within its limits and in its order was found");
}

void Additive::fit(std::span<Observed const> observed, Known const& known)
{
    auto const scale = scale_of(observed);
    axes = known.axes;
    mean = scale.mean;
    auto const size = static_cast<Index>(axes.nodes()), count = static_cast<Index>(observed.size());
    MatrixXd rows(count, size);
    VectorXd values(count), variances(count);
    for (Index k = 0; k < count; ++k) {
        auto const& one = observed[static_cast<std::size_t>(k)];
        base::require(one.at.histogram.size() == size, "histograms of another grid of nodes");
        rows.row(k) = one.at.histogram.transpose();
        values[k] = one.value - mean;
        variances[k] = one.error * one.error;
    }
    auto const reach = [&](std::size_t a) {
        if (a >= axes.axes.size()) return Reach{};
        auto const& axis = axes.axes[a];
        double least = 1, most = 0;
        for (auto const& one : observed) {
            double const score = one.at.scores[static_cast<Index>(a)];
            double const place = axis.place(axis.logarithmic ? std::pow(10, score) : score) / (axis.nodes - 1);
            least = std::min(least, place), most = std::max(most, place);
        }
        return Reach{axis.nodes, static_cast<int>(std::lround(8 * std::log2(std::clamp(most - least, 0.05, 1.0))))};
    };
    auto const& choices = priors(reach(0), reach(1));
    nodes = averaged(rows, values, variances, choices.size(), [&](std::size_t k) -> MatrixXd {
        constexpr double broad = 10;  // of the spread: what is thought of the mean beforehand
        return scale.spread * scale.spread * (choices[k].array() + broad * broad).matrix();
    });

    auto const [limits, least] = constraints(known, mean);
    double const tolerance = 1e-9 * scale.spread;
    bound = least.size() > 0 && ((limits * nodes.mean - least).array() < -tolerance).any();
    if (bound) nodes.mean = nearest_within(nodes.mean, nodes.covariance, limits, least, tolerance);
}

double Additive::value(Point const& at) const
{
    return mean + at.histogram.dot(nodes.mean);
}

Estimate Additive::predict(Point const& at) const
{
    return {value(at), at.histogram.dot(nodes.covariance * at.histogram)};
}

double Additive::shift_variance(Point const& from, Point const& to) const
{
    VectorXd const way = to.histogram - from.histogram;
    return way.dot(nodes.covariance * way);
}

Estimate Additive::element(std::span<double const> values) const
{
    VectorXd where = VectorXd::Zero(nodes.mean.size());
    axes.spread(values, 1, where);
    return predict({.histogram = where});
}
}
