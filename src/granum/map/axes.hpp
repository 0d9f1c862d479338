// The variables of a deposit that a property depends on, and the nodes between which the dependence is linear.
//
// A deposit between nodes counts for those around it in proportion to its nearness (shares add up to 1), so that a
// property that is linear between nodes is met exactly by the sums over deposits.
#pragma once

#include <Eigen/Dense>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace granum::map
{
struct Axis
{
    std::string variable;      //!< a column of the events
    bool logarithmic = false;  //!< nodes at equal ratios
    double low = 0, high = 1;  //!< first and last node
    int nodes = 12;

    //! Where `value` lies, from 0 at the first to nodes - 1 at the last node; values beyond lie on the last.
    double place(double value) const;
    double node(int k) const;  //!< value at node k
};

//! One or two axes; node (i, j) of two has number i + j * axes[0].nodes.
struct Axes
{
    std::vector<Axis> axes;

    std::size_t nodes() const;
    //! Adds `weight` to the nodes around a deposit with these values, one per axis.
    void spread(std::span<double const> values, double weight, Eigen::Ref<Eigen::VectorXd> nodes) const;
    //! The value at a deposit of what has these values at the nodes.
    double at(std::span<double const> values, Eigen::VectorXd const& nodes) const;
};

//! An axis over `values` but for the thousandth of `weights` at either end, with a tenth of its width beyond on either
//! side. Logarithmic axes count values above 0 only. Throws base::NumericsError where fewer than two different values
//! are finite.
Axis axis_over(std::string variable, bool logarithmic, std::span<double const> values, std::span<double const> weights,
               int nodes);
}
