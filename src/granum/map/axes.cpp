#include "granum/map/axes.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace granum::map
{
namespace
{
//! Up to four nodes around a deposit and its shares of them.
struct Around
{
    std::array<Eigen::Index, 4> node{};
    std::array<double, 4> share{};
    std::size_t count = 0;
};

Around around(std::vector<Axis> const& axes, std::span<double const> values)
{
    Around out{{0}, {1}, 1};
    Eigen::Index stride = 1;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        double const place = axes[a].place(values[a]);
        auto const left = std::min(static_cast<Eigen::Index>(place), static_cast<Eigen::Index>(axes[a].nodes) - 2);
        double const right_share = place - static_cast<double>(left);
        for (std::size_t k = out.count; k-- > 0;) {
            auto const base = out.node[k] + stride * left;
            double const share = out.share[k];
            out.node[2 * k] = base, out.share[2 * k] = share * (1 - right_share);
            out.node[2 * k + 1] = base + stride, out.share[2 * k + 1] = share * right_share;
        }
        out.count *= 2;
        stride *= axes[a].nodes;
    }
    return out;
}
}

double Axis::place(double value) const
{
    double const share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return (nodes - 1) * (share > 0 ? std::min(share, 1.0) : 0.0);
}

double Axis::node(int k) const
{
    double const share = static_cast<double>(k) / (nodes - 1);
    return logarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
}

std::size_t Axes::nodes() const
{
    std::size_t product = 1;
    for (auto const& axis : axes) product *= static_cast<std::size_t>(axis.nodes);
    return product;
}

void Axes::spread(std::span<double const> values, double weight, Eigen::Ref<Eigen::VectorXd> nodes) const
{
    auto const near = around(axes, values);
    for (std::size_t k = 0; k < near.count; ++k) nodes[near.node[k]] += weight * near.share[k];
}

double Axes::at(std::span<double const> values, Eigen::VectorXd const& nodes) const
{
    auto const near = around(axes, values);
    double sum = 0;
    for (std::size_t k = 0; k < near.count; ++k) sum += near.share[k] * nodes[near.node[k]];
    return sum;
}

Axis axis_over(std::string variable, bool logarithmic, std::span<double const> values, std::span<double const> weights,
               int nodes)
{
    constexpr double left_out = 1e-3, margin = 0.1;
    std::vector<std::pair<double, double>> places;
    double total = 0;
    for (std::size_t row = 0; row < values.size(); ++row) {
        double const x = logarithmic ? std::log(values[row]) : values[row];
        if (std::isfinite(x) && weights[row] > 0) places.emplace_back(x, weights[row]), total += weights[row];
    }
    std::sort(places.begin(), places.end());
    double low = 0, high = 0, sum = 0;
    for (auto const& [x, weight] : places) {
        if (sum <= left_out * total) low = x;
        if (sum < (1 - left_out) * total) high = x;
        sum += weight;
    }
    base::require(low < high, "{} has no two different values among the deposits", variable);
    double const widen = margin * (high - low);
    low -= widen, high += widen;
    if (logarithmic) low = std::exp(low), high = std::exp(high);
    return {std::move(variable), logarithmic, low, high, nodes};
}
}
