// From runs with a measured property to a map, and from a map to what another run will give, with everything that makes
// it uncertain.
#pragma once

#include "granum/map/all.hpp"
#include "granum/map/features.hpp"
#include "granum/product/aggregate.hpp"

#include <optional>
#include <string>
#include <vector>

namespace granum::map
{
//! An operating point of the lab: a run, and what was measured on its product.
struct LabRun
{
    std::string name;
    double value = 0, error = 0;  //!< measured property and its standard error
    double potential = 0;         //!< global drying potential
    Features features;
};

//! How a model does on runs that it was not given.
struct Comparison
{
    std::string model;
    double rms = 0;    //!< root mean square of what it misses
    double error = 0;  //!< standard error of the mean square's root
    double r2 = 0;     //!< 1 - mean square over the variance of the values; below 0: worse than their mean
    double chi2 = 0;  //!< mean of (missed / (its deviation and the measurement's))^2: about 1 where it knows its errors
    std::vector<double> predicted, deviation;  //!< run by run
};

struct Map
{
    std::string property, unit;
    Known known;
    std::vector<LabRun> runs;
    std::vector<Model> models;            //!< fitted to all runs
    std::vector<Comparison> comparisons;  //!< of each model, where asked for
    std::size_t chosen = 0;               //!< the model that `predict` uses

    Eigen::VectorXd support() const;  //!< most of the share that any run has at each node
};

struct Wanted
{
    std::vector<std::string> models = Models::names();  //!< the first is the one to predict with
    bool compare = true;                                //!< run by run; costs as many fits as there are runs
    std::uint32_t seed = 1;
};

//! Fits the models. Throws base::NumericsError for fewer than three runs or an unknown model.
Map fit(std::string property, std::string unit, Known known, std::vector<LabRun> runs, Wanted const& wanted = {});

struct Prediction
{
    double mean = 0, low = 0, high = 0;  //!< 95 % interval
    double regression = 0;               //!< standard deviation: the map is known from a few runs
    double sampling = 0;                 //!< the run to predict was short
    double parameters = 0;               //!< between runs with other model parameters
    double extrapolation = 0;            //!< share of the layer that comes of deposits the lab had fewer of, 0 to 1
    double deviation() const;
};

//! Of a run, or of several runs of one operating point with other model parameters (drag law, capture law, drying law).
Prediction predict(Map const& map, std::vector<std::pair<Features, double>> const& runs_and_potentials,
                   std::uint32_t seed = 1);

//! How far the property moves from one operating point to another: what the map knows badly at both alike does not
//! count twice.
struct Shift
{
    double mean = 0, deviation = 0;  //!< of the regression and of both runs' lengths
};
Shift shift(Map const& map, std::pair<Features, double> const& from, std::pair<Features, double> const& to,
            std::uint32_t seed = 1);

//! The property over the granules of a run, each the mean over its own layer, weighted with its solids: only of a map
//! that predicts with the additive model, which alone knows single deposits. Throws base::NumericsError where no
//! granule has a layer.
std::optional<product::Percentiles> over_granules(Map const& map, Deposits const& deposits);

//! 1 - sum over nodes of the smaller of the share here and the most that any lab run has there.
double extrapolation_index(Eigen::VectorXd const& support, Eigen::VectorXd const& histogram);
}
