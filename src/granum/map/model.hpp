// What a map from operating points to a property is given and answers, whichever model it is.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/map/axes.hpp"

#include <Eigen/Dense>

#include <limits>
#include <span>

namespace granum::map
{
//! An operating point as the models see it.
struct Point
{
    double potential = 0;       //!< global drying potential, 1
    Eigen::VectorXd scores;     //!< of its distributions
    Eigen::VectorXd histogram;  //!< share of the solids at each node
};

//! A point whose property was measured.
struct Observed
{
    Point at;
    double value = 0;
    double error = 0;  //!< standard error of the value, that of the histogram's sampling included
};

struct Estimate
{
    double mean = 0;
    double variance = 0;  //!< of the mean: how well the model is known, without the scatter of a new measurement
};

enum class Monotone
{
    free,
    rising,
    falling
};

//! What is known of the property beforehand.
struct Known
{
    Axes axes;
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    Monotone along_first = Monotone::free;  //!< of a layer element's property along the first axis
};

//! Mean and spread of the measured values, weighted alike. Throws base::NumericsError where there are fewer than two.
struct Scale
{
    double mean = 0, spread = 0;
};
Scale scale_of(std::span<Observed const> observed);
}
