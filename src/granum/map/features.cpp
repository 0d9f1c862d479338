#include "granum/map/features.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace granum::map
{
namespace
{
double coordinate(Axis const& axis, double value)
{
    return axis.logarithmic ? std::log10(value) : value;
}

Sums nothing(Axes const& axes)
{
    auto const count = static_cast<Eigen::Index>(axes.axes.size());
    Sums out;
    out.nodes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(axes.nodes()));
    out.first = out.second = Eigen::VectorXd::Zero(count);
    return out;
}
}

std::vector<double> const& Deposits::of(std::string const& name) const
{
    auto const found = std::find(names.begin(), names.end(), name);
    base::require(found != names.end(), "the deposits have no {}", name);
    return values[static_cast<std::size_t>(found - names.begin())];
}

Sums& Sums::operator+=(Sums const& other)
{
    solids += other.solids;
    nodes += other.nodes;
    first += other.first;
    second += other.second;
    potential += other.potential;
    return *this;
}

Sums Features::total() const
{
    Sums sum = blocks.front();
    for (std::size_t b = 1; b < blocks.size(); ++b) sum += blocks[b];
    return sum;
}

Sums Features::drawn(base::Random& random) const
{
    auto const one = [&]() -> Sums const& {
        auto const b = static_cast<std::size_t>(random.uniform() * static_cast<double>(blocks.size()));
        return blocks[std::min(b, blocks.size() - 1)];
    };
    Sums sum = one();
    for (std::size_t b = 1; b < blocks.size(); ++b) sum += one();
    return sum;
}

Mean mean_of(Deposits const& deposits, std::string const& name, bool logarithmic)
{
    constexpr std::size_t blocks = 10;
    auto const& values = deposits.of(name);
    if (values.empty()) return {};
    auto const [first, last] = std::minmax_element(deposits.time.begin(), deposits.time.end());
    double const width = std::max(*last - *first, 1e-300);
    std::array<double, blocks> solids{}, sum{};
    for (std::size_t row = 0; row < values.size(); ++row) {
        auto const at = std::min(blocks - 1, static_cast<std::size_t>(blocks * (deposits.time[row] - *first) / width));
        solids[at] += deposits.solids[row];
        sum[at] += deposits.solids[row] * (logarithmic ? std::log10(values[row]) : values[row]);
    }
    double total = 0, weighted = 0, square = 0;
    for (std::size_t b = 0; b < blocks; ++b) total += solids[b], weighted += sum[b];
    Mean out{weighted / total, 0};
    for (std::size_t b = 0; b < blocks; ++b) square += std::pow(sum[b] - out.value * solids[b], 2);
    out.error = std::sqrt(square * blocks / (blocks - 1)) / total;
    return out;
}

Features features(Axes const& axes, Deposits const& deposits, int blocks)
{
    std::vector<std::vector<double> const*> columns;
    for (auto const& axis : axes.axes) columns.push_back(&deposits.of(axis.variable));
    auto const& potential = deposits.of("mean_drying_potential");
    base::require(deposits.size() > 0, "there are no deposits");
    auto const [first, last] = std::minmax_element(deposits.time.begin(), deposits.time.end());
    double const width = (*last - *first) / blocks;
    std::vector<Sums> sums(static_cast<std::size_t>(blocks), nothing(axes));
    std::vector<double> values(columns.size());
    for (std::size_t row = 0; row < deposits.size(); ++row) {
        bool known = deposits.solids[row] > 0;
        for (std::size_t a = 0; a < columns.size(); ++a) {
            values[a] = (*columns[a])[row];
            known = known && std::isfinite(coordinate(axes.axes[a], values[a]));
        }
        if (!known) continue;
        double const place = width > 0 ? (deposits.time[row] - *first) / width : 0;
        Sums& block = sums[std::min(static_cast<std::size_t>(place), sums.size() - 1)];
        double const solids = deposits.solids[row];
        block.solids += solids;
        block.potential += solids * potential[row];
        axes.spread(values, solids, block.nodes);
        for (std::size_t a = 0; a < columns.size(); ++a) {
            double const x = coordinate(axes.axes[a], values[a]);
            block.first[static_cast<Eigen::Index>(a)] += solids * x;
            block.second[static_cast<Eigen::Index>(a)] += solids * x * x;
        }
    }
    std::erase_if(sums, [](Sums const& block) { return block.solids <= 0; });
    base::require(!sums.empty(), "no deposit has a value of every variable of the map");
    return {std::move(sums)};
}

Eigen::VectorXd histogram(Sums const& sums)
{
    return sums.nodes / sums.solids;
}

Eigen::VectorXd scores(Sums const& sums)
{
    auto const axes = sums.first.size();
    Eigen::VectorXd out(axes + 1);
    out.head(axes) = sums.first / sums.solids;
    out[axes] = std::sqrt(std::max(0.0, sums.second[0] / sums.solids - out[0] * out[0]));
    return out;
}

std::vector<std::string> score_names(Axes const& axes)
{
    std::vector<std::string> out;
    auto const name = [](Axis const& axis) { return axis.logarithmic ? "log10 " + axis.variable : axis.variable; };
    for (auto const& axis : axes.axes) out.push_back("mean of " + name(axis));
    out.push_back("standard deviation of " + name(axes.axes.front()));
    return out;
}
}
