// Sizes of spray droplets: the log-normal distribution by its volume median and geometric standard deviation, and the
// Rosin-Rammler distribution.
//
// A parcel carries a fixed mass of droplets, so its diameter is drawn from the volume distribution. Moments by Hatch
// and Choate, J. Franklin Inst. 207 (1929) 369. All diameters in m.
#pragma once

#include <cmath>

namespace granum::law::droplet
{
//! Diameter of a parcel of constant mass from a standard `normal` number.
inline double sample_volume_weighted(double median, double spread, double normal)
{
    return median * std::exp(std::log(spread) * normal);
}

//! d_p,q means about the volume median: median * exp(k ln^2 spread).
inline double shifted(double median, double spread, double k)
{
    double const width = std::log(spread);
    return median * std::exp(k * width * width);
}

//! Median of the number distribution (same spread as that of the volume).
inline double number_median(double median, double spread)
{
    return shifted(median, spread, -3);
}
//! d_32, volume over surface.
inline double sauter(double median, double spread)
{
    return shifted(median, spread, -0.5);
}
//! d_10, mean by number.
inline double number_mean(double median, double spread)
{
    return shifted(median, spread, -2.5);
}
//! d_43, mean by volume.
inline double volume_mean(double median, double spread)
{
    return shifted(median, spread, 0.5);
}

//! Volume distribution 1 - exp(-(d / scale)^exponent).
struct RosinRammler
{
    double scale;     //!< m, of which 63.2 % of the volume is finer
    double exponent;  //!< width; above 1 for a finite Sauter diameter

    //! The diameter below which the fraction `uniform` of the volume lies: a parcel's diameter from a uniform number.
    double quantile(double uniform) const { return scale * std::pow(-std::log1p(-uniform), 1 / exponent); }
    double sauter() const { return scale / std::tgamma(1 - 1 / exponent); }
    double volume_mean() const { return scale * std::tgamma(1 + 1 / exponent); }
};
}
