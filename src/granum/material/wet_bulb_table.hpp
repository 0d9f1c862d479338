// The wet-bulb humidity as a table over temperature and humidity, for the local drying potential of every granule.
#pragma once

#include "granum/material/moist_air.hpp"

#include <vector>

namespace granum::material
{
//! Y^wb(T, Y) by bilinear interpolation; -20 to 160 degC in steps of 1 K, Y from 0 to 0.3 in steps of 0.002 (clamped).
class WetBulbTable
{
  public:
    explicit WetBulbTable(double pressure);

    //! Loading of the wet bulb, kg/kg dry air.
    double humidity(double temperature, double loading) const;

    //! Local drying potential (Y^wb(T, Y) - Y) / (Y^wb_in - Y_in) with the inlet's denominator.
    double drying_potential(double temperature, double loading, double inlet_span) const
    {
        return (humidity(temperature, loading) - loading) / inlet_span;
    }

  private:
    static constexpr int temperatures = 181, loadings = 151;
    std::vector<double> values_;
};
}
