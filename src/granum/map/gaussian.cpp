#include "granum/map/gaussian.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::map
{
double log_evidence(Eigen::MatrixXd const& covariance, Eigen::VectorXd const& values)
{
    Eigen::LLT<Eigen::MatrixXd> const factor(covariance);
    base::require(factor.info() == Eigen::Success, "measured values whose covariance is not positive");
    double const log_determinant = 2 * factor.matrixLLT().diagonal().array().log().sum();
    return -0.5 * (values.dot(factor.solve(values)) + log_determinant +
                   static_cast<double>(values.size()) * std::log(2 * math::pi));
}

Posterior posterior(Eigen::MatrixXd const& rows, Eigen::VectorXd const& values, Eigen::VectorXd const& variances,
                    Eigen::MatrixXd const& prior)
{
    Eigen::MatrixXd const spread = rows * prior;  // measured x unknown
    Eigen::MatrixXd measured = spread * rows.transpose();
    measured.diagonal() += variances;
    Eigen::LLT<Eigen::MatrixXd> const factor(measured);
    base::require(factor.info() == Eigen::Success, "measured values whose covariance is not positive");
    return {spread.transpose() * factor.solve(values), prior - spread.transpose() * factor.solve(spread)};
}

std::vector<double> weights(std::vector<double> const& evidence)
{
    constexpr double least = 1e-3;  // of the best
    double const best = *std::max_element(evidence.begin(), evidence.end());
    std::vector<double> out;
    double sum = 0;
    for (double const one : evidence) {
        double const share = std::exp(one - best);
        sum += out.emplace_back(share < least ? 0 : share);
    }
    for (double& weight : out) weight /= sum;
    return out;
}
}
