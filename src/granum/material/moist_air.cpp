#include "granum/material/moist_air.hpp"

#include "granum/math/roots.hpp"

#include <limits>

namespace granum::material
{
double saturation_pressure(double t)
{
    if (t < 273.16)
        return std::exp(-5.6745359e3 / t + 6.3925247 +
                        t * (-9.677843e-3 + t * (6.2215701e-7 + t * (2.0747825e-9 - t * 9.484024e-13))) +
                        4.1635019 * std::log(t));
    return std::exp(-5.8002206e3 / t + 1.3914993 + t * (-4.8640239e-2 + t * (4.1764768e-5 - t * 1.4452093e-8)) +
                    6.5459673 * std::log(t));
}

double saturation_humidity(double temperature, double pressure)
{
    double const saturation = saturation_pressure(temperature);
    return saturation < pressure ? molar_ratio * saturation / (pressure - saturation)
                                 : std::numeric_limits<double>::infinity();
}

double relative_humidity(double temperature, double humidity, double pressure)
{
    double const partial = pressure * humidity / (molar_ratio + humidity);
    return partial / saturation_pressure(temperature);
}

double dew_point(double humidity, double pressure)
{
    double const partial = pressure * humidity / (molar_ratio + humidity);
    return math::brent_root([partial](double t) { return std::log(saturation_pressure(t) / partial); }, 173.15, 473.15,
                            1e-9);
}

WetBulb wet_bulb(double temperature, double humidity, double pressure)
{
    // Air takes up liquid at the saturation temperature until it is saturated; its enthalpy balance per kg dry air.
    auto const per_dry = [](double t, double y) {
        return heat_capacity_air * (t - math::zero_celsius) + y * vapour_enthalpy(t);
    };
    double const inlet = per_dry(temperature, humidity);
    auto const residual = [&](double t) {
        double const saturated = saturation_humidity(t, pressure);
        return inlet + (saturated - humidity) * water_enthalpy(t) - per_dry(t, saturated);
    };
    double const low = humidity > 1e-9 ? dew_point(humidity, pressure) : 173.15;
    double high = temperature;  // the boiling point is an upper end where the inlet is hotter
    while (!std::isfinite(residual(high))) high = 0.5 * (high + std::max(low, 273.16));
    double const wet = math::brent_root(residual, low - 1e-6, high + 1e-6, 1e-10);
    return {wet, saturation_humidity(wet, pressure)};
}
}
