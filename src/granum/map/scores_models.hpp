// Models of a few scores of an operating point's distributions: a straight one with shrunken slopes, and a smooth one
// of any shape.
#pragma once

#include "granum/map/gaussian.hpp"
#include "granum/map/model.hpp"

namespace granum::map
{
//! Scores less their mean over the observed points, over their spread; what does not vary is 0.
struct Standard
{
    Eigen::VectorXd middle, width;

    Standard() = default;
    explicit Standard(std::span<Observed const> observed);
    Eigen::VectorXd of(Point const& at) const;
};

//! Linear in the scores. The slopes come from a normal distribution about 0 whose width is averaged over (ridge
//! regression).
struct LinearScores
{
    static constexpr base::Card card{.name = "linear-scores",
                                     .title = "linear in the scores of the events, regularised",
                                     .source = "ridge regression, width of the slopes by evidence",
                                     .valid = "small changes about the runs of the lab"};

    Standard standard;
    double mean = 0;
    Posterior slopes;  //!< constant first

    void fit(std::span<Observed const> observed, Known const& known);
    double value(Point const& at) const { return mean + row(at).dot(slopes.mean); }
    Estimate predict(Point const& at) const;
    double shift_variance(Point const& from, Point const& to) const;

  private:
    Eigen::VectorXd row(Point const& at) const;
};

//! Gaussian process on the scores, Matern 5/2 with a length for each score.
struct GaussianProcess
{
    static constexpr base::Card card{.name = "gaussian-process",
                                     .title = "Gaussian process on the scores of the events",
                                     .source = "Matern 5/2; Rasmussen, Williams 2006 (recalled)",
                                     .valid = "between the runs of the lab"};

    //! One choice of lengths and amplitude, with what follows from the observed points.
    struct Choice
    {
        double share;
        Eigen::VectorXd lengths;
        double amplitude;         //!< variance
        Eigen::VectorXd solved;   //!< inverse covariance times values
        Eigen::MatrixXd inverse;  //!< of the covariance of the measured values
    };

    Standard standard;
    double mean = 0, constant = 0;  //!< constant: variance of what is thought of the mean beforehand
    Eigen::MatrixXd places;         //!< scores x observed, standard
    std::vector<Choice> choices;

    void fit(std::span<Observed const> observed, Known const& known);
    double value(Point const& at) const { return predict(at).mean; }
    Estimate predict(Point const& at) const;
    double shift_variance(Point const& from, Point const& to) const;

  private:
    //! Covariances with the observed points.
    Eigen::VectorXd with_measured(Choice const& choice, Eigen::VectorXd const& here) const;
};
}
