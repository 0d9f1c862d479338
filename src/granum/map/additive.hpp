// A property of a layer element as a smooth function of how its deposit dried; that of a product is the mean over its
// elements.
//
// The only model here that knows what one deposit does: it is fitted through the distributions of the runs, so that it
// answers for single granules too, and shows where it is asked for deposits that no run had. The function is free at
// the nodes of its axes but for being smooth: how smooth, in each direction, is averaged over (gaussian.hpp).
#pragma once

#include "granum/map/gaussian.hpp"
#include "granum/map/model.hpp"

namespace granum::map
{
struct Additive
{
    static constexpr base::Card card{
        .name = "additive",
        .title = "smooth function of the events, averaged over the layer",
        .source = "second differences at nodes, smoothness by evidence; a choice of this program",
        .valid = "deposits like those of the lab; see the extrapolation index"};

    Axes axes;
    double mean = 0;
    Posterior nodes;     //!< of the property at each node, less `mean`
    bool bound = false;  //!< did limits or the order along the first axis change it?

    //! Throws base::NumericsError where histograms and axes do not fit.
    void fit(std::span<Observed const> observed, Known const& known);
    double value(Point const& at) const;  //!< the mean alone, here and in every model
    Estimate predict(Point const& at) const;
    //! Of the difference of two answers, here and in every model: what is known badly of both alike does not count.
    double shift_variance(Point const& from, Point const& to) const;

    //! Of one layer element with these values of the axes' variables.
    Estimate element(std::span<double const> values) const;
    Eigen::VectorXd at_nodes() const { return nodes.mean.array() + mean; }
};

//! The point nearest to `middle`, in the metric of `covariance`, where rows * x >= least: limits are taken up and let
//! go one after the other (Lawson and Hanson, Solving Least Squares Problems, 1974, recalled). Throws
//! base::NumericsError where no point is found.
Eigen::VectorXd nearest_within(Eigen::VectorXd const& middle, Eigen::MatrixXd const& covariance,
                               Eigen::MatrixXd const& rows, Eigen::VectorXd const& least, double tolerance);
}
