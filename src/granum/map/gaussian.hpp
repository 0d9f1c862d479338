// Regression with Gaussian priors, averaged over what the priors leave open.
//
// A model says how its values vary together before anything is measured, once for each choice of its free numbers (how
// far, how smooth). Each choice answers with a mean and a variance and with its evidence, the probability it gave to
// what was measured; answers are averaged with the evidence as weight, so that a choice that cannot be told from eight
// runs widens the answer. Source: textbook (Rasmussen, Williams, Gaussian Processes for Machine Learning, 2006,
// chapters 2 and 5; recalled).
#pragma once

#include <Eigen/Dense>

#include <utility>
#include <vector>

namespace granum::map
{
//! Values at unknown places x, of which y = h x + noise was measured; x ~ N(prior_mean, prior).
struct Posterior
{
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
};

//! @param rows (measured x unknown) how the unknowns make the measured values
//! @param values, variances (measured) what was measured, less the prior mean's part, and its variance
//! @param prior (unknown x unknown) covariance
//! Throws base::NumericsError where the covariance of the measured values is not positive.
Posterior posterior(Eigen::MatrixXd const& rows, Eigen::VectorXd const& values, Eigen::VectorXd const& variances,
                    Eigen::MatrixXd const& prior);

//! The evidence alone, from the covariance of what was measured.
double log_evidence(Eigen::MatrixXd const& covariance, Eigen::VectorXd const& values);

//! Weights of choices from their evidence; they add up to 1. Those below a thousandth of the best are 0.
std::vector<double> weights(std::vector<double> const& log_evidence);

//! Posterior of all choices of the prior together, weighted with their evidence, the spread of their means included.
//! `prior(k)` is the covariance of choice k.
template <class Prior>
Posterior averaged(Eigen::MatrixXd const& rows, Eigen::VectorXd const& values, Eigen::VectorXd const& variances,
                   std::size_t choices, Prior const& prior)
{
    std::vector<double> evidence;
    for (std::size_t k = 0; k < choices; ++k) {
        Eigen::MatrixXd covariance = rows * prior(k) * rows.transpose();
        covariance.diagonal() += variances;
        evidence.push_back(log_evidence(covariance, values));
    }
    auto const share = weights(evidence);
    Posterior out{Eigen::VectorXd::Zero(rows.cols()), Eigen::MatrixXd::Zero(rows.cols(), rows.cols())};
    std::vector<std::pair<double, Eigen::VectorXd>> means;
    for (std::size_t k = 0; k < choices; ++k) {
        if (share[k] == 0) continue;
        auto one = posterior(rows, values, variances, prior(k));
        out.mean += share[k] * one.mean;
        out.covariance += share[k] * one.covariance;
        means.emplace_back(share[k], std::move(one.mean));
    }
    for (auto const& [weight, mean] : means)
        out.covariance += weight * (mean - out.mean) * (mean - out.mean).transpose();
    return out;
}
}
