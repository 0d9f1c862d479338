// The table of wet-bulb humidities against the equation it stands for.
#include "granum/material/wet_bulb_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum::material;
using granum::math::zero_celsius;

TEST(WetBulbTable, interpolates_the_wet_bulb_between_its_nodes)
{
    WetBulbTable const table(101325);
    for (double celsius = 15.3; celsius < 100; celsius += 3.7)
        for (double y = 0.0007; y < 0.05; y += 0.0037) {
            if (y > saturation_humidity(celsius + zero_celsius, 101325)) continue;
            double const exact = wet_bulb(celsius + zero_celsius, y, 101325).humidity;
            EXPECT_NEAR(table.humidity(celsius + zero_celsius, y), exact, 2e-3 * exact) << celsius << " degC, " << y;
        }
}

TEST(WetBulbTable, gives_a_drying_potential_of_one_at_the_inlet_and_none_in_saturated_air)
{
    WetBulbTable const table(101325);
    double const t = 80 + zero_celsius, y = 0.008, span = wet_bulb(t, y, 101325).humidity - y;
    EXPECT_NEAR(table.drying_potential(t, y, span), 1, 1e-3);
    double const wet = 30.866 + zero_celsius;
    EXPECT_NEAR(table.drying_potential(wet, saturation_humidity(wet, 101325), span), 0, 2e-3);
}

TEST(WetBulbTable, keeps_its_value_while_air_takes_up_water_of_that_temperature)
{
    // Adiabatic saturation is a path of constant wet bulb, if the water comes at the wet bulb's temperature.
    WetBulbTable const table(101325);
    double const t = 80 + zero_celsius, y = 0.008;
    auto const wet = wet_bulb(t, y, 101325);
    for (double const out : {0.0138, 0.0197, 0.025}) {
        double const total = (1 + y) * enthalpy(t, fraction(y)) + (out - y) * water_enthalpy(wet.temperature);
        double const cooled = temperature(total / (1 + out), fraction(out));
        EXPECT_NEAR(table.humidity(cooled, out), wet.humidity, 5e-4 * wet.humidity);
    }
}

TEST(WetBulbTable, stays_finite_beyond_its_ends)
{
    for (double const pressure : {8e4, 1.2e5}) {
        WetBulbTable const table(pressure);
        for (double const t : {200.0, 253.15, 300.0, 433.15, 600.0})
            for (double const y : {-0.1, 0.0, 0.3, 2.0}) {
                EXPECT_TRUE(std::isfinite(table.humidity(t, y))) << t << " K, " << y;
                EXPECT_GE(table.humidity(t, y), 0) << t << " K, " << y;
            }
    }
}
}
