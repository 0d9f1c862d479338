#include "granum/material/wet_bulb_table.hpp"

#include <algorithm>

namespace granum::material
{
WetBulbTable::WetBulbTable(double pressure) : values_(static_cast<std::size_t>(temperatures) * loadings)
{
    for (int t = 0; t < temperatures; ++t) {
        double const kelvin = math::zero_celsius - 20 + t;
        // Supersaturated air has a wet bulb above its own temperature: the same balance, so the table has no kink at
        // saturation, and a potential below zero.
        for (int y = 0; y < loadings; ++y)
            values_[static_cast<std::size_t>(t * loadings + y)] = wet_bulb(kelvin, 0.002 * y, pressure).humidity;
    }
}

double WetBulbTable::humidity(double temperature, double loading) const
{
    double const t = std::clamp(temperature - math::zero_celsius + 20, 0.0, temperatures - 1.000001);
    double const y = std::clamp(loading / 0.002, 0.0, loadings - 1.000001);
    int const ti = static_cast<int>(t), yi = static_cast<int>(y);
    double const a = t - ti, b = y - yi;
    double const* low = values_.data() + ti * loadings + yi;
    double const* high = low + loadings;
    return (1 - a) * ((1 - b) * low[0] + b * low[1]) + a * ((1 - b) * high[0] + b * high[1]);
}
}
