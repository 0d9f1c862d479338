// The baseline of the literature: a straight line in the drying potential of the whole apparatus.
#pragma once

#include "granum/map/model.hpp"

namespace granum::map
{
struct LinearPotential
{
    static constexpr base::Card card{.name = "linear-potential",
                                     .title = "straight line in the global drying potential",
                                     .source = "form: Rieck et al., Powder Technol. 272 (2015) 120",
                                     .valid = "salt solutions, one apparatus"};

    double zero = 0, slope = 0;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  //!< of zero and slope

    //! Weighted least squares; where the line misses the values by more than their errors its variance grows with that.
    //! Throws base::NumericsError for fewer than two different potentials.
    void fit(std::span<Observed const> observed, Known const& known);
    double value(Point const& at) const { return zero + slope * at.potential; }
    Estimate predict(Point const& at) const;
    double shift_variance(Point const& from, Point const& to) const;
};
}
