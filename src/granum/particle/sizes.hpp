// Distributions of granule diameters: one size, a list, a law, or a table, all held as one cumulative curve by number.
//
// Shares may be stated by mass (as a sieve gives them) or by number; granules of one batch have one density, so shares
// by mass are shares by volume.
#pragma once

#include <vector>

namespace granum::particle
{
//! What a share is a share of.
enum class Weighting
{
    number,
    mass
};

class SizeDistribution
{
  public:
    //! One diameter, m.
    static SizeDistribution single(double diameter);
    //! Diameters (m) with their shares, which need not sum to one.
    static SizeDistribution list(std::vector<double> const& diameters, std::vector<double> const& shares,
                                 Weighting weighting);
    //! Cumulative shares (rising from any first value to any last one) at rising diameters (m), straight in between.
    static SizeDistribution table(std::vector<double> const& diameters, std::vector<double> const& cumulative,
                                  Weighting weighting);
    //! @{ Laws between the diameters `low` and `high` (m): what lies outside is cut off.
    static SizeDistribution uniform(double low, double high, Weighting weighting);
    static SizeDistribution normal(double mean, double deviation, double low, double high, Weighting weighting);
    //! `spread` is the geometric standard deviation.
    static SizeDistribution log_normal(double median, double spread, double low, double high, Weighting weighting);
    //! Cumulative share 1 - exp(-(d/characteristic)^exponent). Rosin and Rammler, J. Inst. Fuel 7 (1933) 29 [R].
    static SizeDistribution rosin_rammler(double characteristic, double exponent, double low, double high,
                                          Weighting weighting);
    //! @}

    //! Diameter below which the share `u` (0 to 1) of the granules lies, by number, m.
    double diameter(double u) const;
    //! Diameter below which the share `u` (0 to 1) of the mass lies, m.
    double mass_diameter(double u) const;
    double smallest() const { return diameters_.front(); }
    double largest() const { return diameters_.back(); }
    double mean_cube() const { return mean_cube_; }  //!< mean of the cubed diameters by number, m3
    double sauter() const { return sauter_; }        //!< mean diameter d32, m

  private:
    SizeDistribution(std::vector<double> diameters, std::vector<double> number_shares, bool stepwise);

    //! Diameter below which `u` of a cumulative curve lies; between two points it grows with a power of the diameter.
    double quantile(std::vector<double> const& cumulative, double u, int power) const;

    // Stepwise: the share of diameters_[k] ends at cumulative_[k]. Otherwise straight between the points.
    std::vector<double> diameters_, cumulative_, mass_cumulative_;
    bool stepwise_ = true;
    double mean_cube_ = 0, sauter_ = 0;
};
}
