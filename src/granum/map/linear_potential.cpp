#include "granum/map/linear_potential.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace granum::map
{
void LinearPotential::fit(std::span<Observed const> observed, Known const&)
{
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    auto const [least, most] = std::minmax_element(
        observed.begin(), observed.end(), [](auto const& a, auto const& b) { return a.at.potential < b.at.potential; });
    base::require(observed.size() >= 2 && most->at.potential - least->at.potential > 1e-6,
                  "a line needs two different drying potentials");
    for (auto const& one : observed) {
        Eigen::Vector2d const row{1, one.at.potential};
        double const weight = 1 / (one.error * one.error);
        normal += weight * row * row.transpose();
        right += weight * one.value * row;
    }
    covariance = normal.inverse();
    Eigen::Vector2d const line = covariance * right;
    zero = line[0], slope = line[1];
    if (observed.size() <= 2) return;
    double misfit = 0;
    for (auto const& one : observed) misfit += std::pow((one.value - zero - slope * one.at.potential) / one.error, 2);
    covariance *= std::max(1.0, misfit / static_cast<double>(observed.size() - 2));
}

Estimate LinearPotential::predict(Point const& at) const
{
    Eigen::Vector2d const row{1, at.potential};
    return {value(at), row.dot(covariance * row)};
}

double LinearPotential::shift_variance(Point const& from, Point const& to) const
{
    return covariance(1, 1) * (to.potential - from.potential) * (to.potential - from.potential);
}
}
