// What the deposits of one operating point went through: distributions weighted with their solids, kept block by block
// of time so that it is known how far they are from those of an endless run.
#pragma once

#include "granum/base/random.hpp"
#include "granum/map/axes.hpp"

#include <Eigen/Dense>

#include <span>
#include <string>
#include <vector>

namespace granum::map
{
//! Deposits of a run that count, column by column.
struct Deposits
{
    std::vector<double> time;     //!< s, when each was dry
    std::vector<double> solids;   //!< kg
    std::vector<double> granule;  //!< identity of the parcel
    std::vector<std::string> names;
    std::vector<std::vector<double>> values;  //!< per name

    std::vector<double> const& of(std::string const& name) const;  //!< throws base::NumericsError where there is none
    std::size_t size() const { return time.size(); }
};

struct Mean
{
    double value = 0, error = 0;  //!< standard error
};

//! Mean of a variable over the layer (of its log10 on demand), with its error from ten blocks of equal time; 0 without
//! deposits.
Mean mean_of(Deposits const& deposits, std::string const& name, bool logarithmic = false);

//! Sums over the deposits of one block of time (or of any set of blocks).
struct Sums
{
    double solids = 0;       //!< kg
    Eigen::VectorXd nodes;   //!< kg that lie at each node of the axes
    Eigen::VectorXd first;   //!< kg times the coordinate of each axis (log10 where logarithmic)
    Eigen::VectorXd second;  //!< kg times its square
    double potential = 0;    //!< kg times the mean drying potential while drying

    Sums& operator+=(Sums const& other);
};

//! Of an operating point.
struct Features
{
    std::vector<Sums> blocks;

    Sums total() const;
    //! As if the run had been another one of the same length: blocks drawn with replacement.
    Sums drawn(base::Random& random) const;
};

//! The deposits on the axes, in `blocks` blocks of equal time from the first to the last. Deposits without a value (not
//! finite, or not above 0 on a logarithmic axis) are left out. Throws base::NumericsError where none is left.
Features features(Axes const& axes, Deposits const& deposits, int blocks = 10);

//! Share of the solids at each node; adds up to 1.
Eigen::VectorXd histogram(Sums const& sums);

//! Numbers that stand for a distribution where few operating points are known: the mean of each axis, and the standard
//! deviation of the first.
Eigen::VectorXd scores(Sums const& sums);
std::vector<std::string> score_names(Axes const& axes);
}
