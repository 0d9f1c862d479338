// From elements of layer to granules and to the batch: means, percentiles and intervals.
//
// A property of a granule is the mean over its elements, weighted with their solids. Of the two deviations of a
// prediction the one of single elements averages out in that mean, the common one stays in full. Percentiles over
// granules show how they differ from each other; the interval of the batch mean shows how well it is known.
#pragma once

#include "granum/product/element.hpp"

#include <span>
#include <vector>

namespace granum::product
{
//! Running sums over layer elements; sums of granules (or of ranks) add up.
struct LayerSum
{
    double solids = 0;           //!< kg, sum of m
    double weighted = 0;         //!< sum of m * mean
    double element_square = 0;   //!< sum of (m * element deviation)^2
    double weighted_common = 0;  //!< sum of m * common deviation

    void add(double solids_mass, Prediction const& prediction);
    LayerSum& operator+=(LayerSum const& other);

    //! Mean over the elements with its two deviations; zeros where there is no layer.
    Prediction prediction() const;
};

//! The value below which `share` (0 to 1) of the weight lies. Each sample stands in the middle of its weight; between
//! samples the value is linear. Throws base::NumericsError where there is no weight or the lengths differ.
double percentile(std::span<double const> values, std::span<double const> weights, double share);

struct Percentiles
{
    double p10, p50, p90;
};
Percentiles percentiles(std::span<double const> values, std::span<double const> weights);

struct BatchProperty
{
    Prediction mean;       //!< over all solids of the batch
    double low, high;      //!< 95 % interval of the mean: both deviations, as normal errors
    Percentiles granules;  //!< of the granules' own means, by mass of their layers
};

//! Property of a batch of granules. Granules count by the solids of their layers: a granule that met one droplet says
//! little about the product. Throws base::NumericsError where no granule has a layer.
BatchProperty batch_property(std::span<LayerSum const> granules);

enum class Weighting
{
    number,
    volume
};

//! d10, d50 and d90 in m of granules of `diameters` m, each standing for `counts` equal ones.
Percentiles size_percentiles(std::span<double const> diameters, std::span<double const> counts, Weighting weighting);
}
