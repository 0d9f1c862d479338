// Moist air against the tables of ASHRAE and the psychrometry of a spray drier.
#include "granum/material/moist_air.hpp"
#include "scene/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{
using namespace granum;
using namespace granum::material;
using math::zero_celsius;

//! "3e-4" is relative, "abs 0.01" is not.
double margin(std::string const& tolerance, double value)
{
    return tolerance.rfind("abs ", 0) == 0 ? std::stod(tolerance.substr(4)) : std::stod(tolerance) * std::abs(value);
}

//! J per kg dry air.
double enthalpy_per_dry(double celsius, double humidity)
{
    return (1 + humidity) * enthalpy(celsius + zero_celsius, fraction(humidity));
}

TEST(MoistAir, agrees_with_the_saturation_tables)
{
    scene::Table const table("h-06-saturation.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        auto const& quantity = table.text(row, "quantity");
        double const celsius = table.number(row, "T_C"), t = celsius + zero_celsius, p = table.number(row, "p_Pa");
        double const expected = table.number(row, "value");
        double ours = 0;
        if (quantity == "saturation_pressure_Pa")
            ours = saturation_pressure(t);
        else if (quantity == "saturation_humidity_ratio")
            ours = saturation_humidity(t, p);
        else if (quantity == "saturated_air_enthalpy_J_kg")
            ours = enthalpy_per_dry(celsius, saturation_humidity(t, p));
        else if (quantity == "dry_air_enthalpy_J_kg")
            ours = enthalpy(t, 0);
        else if (quantity == "dry_air_volume_m3_kg")
            ours = 1 / density(p, t, 0);
        else
            FAIL() << "unknown quantity " << quantity;
        EXPECT_NEAR(ours, expected, margin(table.text(row, "tolerance"), expected))
            << quantity << " at " << celsius << " degC";
    }
}

TEST(MoistAir, agrees_with_the_tables_of_unsaturated_air)
{
    scene::Table const table("h-06-moist.csv");
    std::set<std::string> compared;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        auto const &quantity = table.text(row, "quantity"), &inputs = table.text(row, "inputs");
        double const expected = table.number(row, "value");
        double const allowed = margin(table.text(row, "tolerance"), expected);
        auto const given = [&](std::string const& name) { return scene::number_after(inputs, name); };
        bool const has_wet_bulb = inputs.find("Twb=") != std::string::npos;
        // The humidity whose wet bulb is the given one: the closed form that the reference solves for.
        auto const humidity_of_wet_bulb = [&] {
            double const t = given("T"), wet = given("Twb"), p = given("p");
            double const saturated = saturation_humidity(wet + zero_celsius, p);
            if (wet >= 0)
                return ((2501 - 2.326 * wet) * saturated - 1.006 * (t - wet)) / (2501 + 1.86 * t - 4.186 * wet);
            return ((2830 - 0.24 * wet) * saturated - 1.006 * (t - wet)) / (2830 + 1.86 * t - 2.1 * wet);
        };
        SCOPED_TRACE(quantity + " of " + inputs);
        if (quantity == "wet_bulb_C") {
            double const t = given("T") + zero_celsius, p = given("p");
            double const partial = given("RH") * saturation_pressure(t);
            EXPECT_NEAR(wet_bulb(t, molar_ratio * partial / (p - partial), p).temperature - zero_celsius, expected,
                        allowed);
        } else if (quantity == "humidity_ratio" && !has_wet_bulb) {
            // Air saturated at this partial pressure holds this humidity.
            double const partial = given("Pv");
            EXPECT_NEAR(molar_ratio * partial / (given("p") - partial), expected, margin("1e-5", expected));
        } else if (quantity == "humidity_ratio" || (has_wet_bulb && given("p") == 101325)) {
            double const t = given("T") + zero_celsius, p = given("p"), y = humidity_of_wet_bulb();
            if (given("Twb") >= 0) {
                EXPECT_NEAR(wet_bulb(t, y, p).temperature - zero_celsius, given("Twb"), 1e-3);
            }
            if (quantity == "humidity_ratio") {
                EXPECT_NEAR(y, expected, allowed);
            }
            if (quantity == "dew_point_C") {
                EXPECT_NEAR(dew_point(y, p) - zero_celsius, expected, allowed);
            }
            if (quantity == "relative_humidity") {
                EXPECT_NEAR(relative_humidity(t, y, p), expected, allowed);
            }
            if (quantity == "moist_enthalpy_J_kg") {
                EXPECT_NEAR(enthalpy_per_dry(given("T"), y), expected, allowed);
            }
            if (quantity == "moist_volume_m3_kg") {
                EXPECT_NEAR((1 + y) / density(p, t, fraction(y)), expected, allowed);
            }
        } else if (quantity == "moist_enthalpy_J_kg") {
            EXPECT_NEAR(enthalpy_per_dry(given("T"), given("W")), expected, allowed);
        } else if (quantity == "moist_volume_m3_kg") {
            EXPECT_NEAR((1 + given("W")) / density(given("p"), given("T") + zero_celsius, fraction(given("W"))),
                        expected, allowed);
        } else if (quantity == "moist_density_kg_m3") {
            EXPECT_NEAR(density(given("p"), given("T") + zero_celsius, fraction(given("W"))), expected, allowed);
        } else if (quantity == "specific_humidity") {
            EXPECT_NEAR(fraction(given("W")), expected, allowed);
        } else {
            FAIL() << "unknown quantity";
        }
        compared.insert(quantity);
    }
    EXPECT_EQ(compared.size(), 8u);
}

TEST(MoistAir, has_independent_densities_and_saturation)
{
    EXPECT_NEAR(density(101325, 60 + zero_celsius, fraction(0.012)), 1.05199, 0.51e-5);
    EXPECT_NEAR(1 / density(101325, 298.15, 0), 0.8446, 0.51e-4);
    struct Row
    {
        double celsius, pressure, humidity, half_pressure;
    };
    for (auto const& row : {Row{10, 1228.00, 0.007630, 0.005},
                            {20, 2338.80, 0.014695, 0.005},
                            {25, 3169.22, 0.020081, 0.005},
                            {30, 4246.03, 0.027203, 0.005},
                            {40, 7383.46, 0.048883, 0.005},
                            {50, 12349.9, 0.086327, 0.05},
                            {60, 19943.8, 0.152417, 0.05},
                            {80, 47411.6, 0.546940, 0.05}}) {
        EXPECT_NEAR(saturation_pressure(row.celsius + zero_celsius), row.pressure, 1.02 * row.half_pressure);
        EXPECT_NEAR(saturation_humidity(row.celsius + zero_celsius, 101325), row.humidity, 0.51e-6);
    }
}

TEST(MoistAir, temperature_is_the_inverse_of_enthalpy)
{
    for (double const t : {263.15, 298.15, 353.15})
        for (double const w : {0.0, 0.01, 0.2}) EXPECT_NEAR(temperature(enthalpy(t, w), w), t, 1e-9);
}

TEST(MoistAir, evaporation_enthalpy_closes_the_balance_of_vapour_and_liquid)
{
    for (double const celsius : {0.0, 25.0, 80.0}) {
        double const t = celsius + zero_celsius;
        EXPECT_NEAR(vapour_enthalpy(t) - water_enthalpy(t), evaporation_enthalpy(t), 1e-6);
        EXPECT_NEAR(evaporation_enthalpy(t), 2501e3 - 2326 * celsius, 1e-6);
    }
}

TEST(WetBulb, agrees_with_independent_numbers)
{
    struct Row
    {
        double celsius, humidity, wet, saturated;
    };
    for (auto const& row :
         {Row{30, 0, 10.5303, 0.007909}, {50, 0.005, 21.9553, 0.016622}, {80, 0, 26.5283, 0.022053}}) {
        auto const wet = wet_bulb(row.celsius + zero_celsius, row.humidity, 101325);
        EXPECT_NEAR(wet.temperature - zero_celsius, row.wet, 0.51e-4);
        EXPECT_NEAR(wet.humidity, row.saturated, 0.51e-6);
    }
    EXPECT_NEAR(wet_bulb(25 + zero_celsius, 0, 101325).temperature - zero_celsius, 8.2714, 0.51e-4);
}

TEST(WetBulb, of_saturated_air_is_its_own_temperature)
{
    for (double const celsius : {5.0, 30.0, 80.0}) {
        double const t = celsius + zero_celsius;
        EXPECT_NEAR(wet_bulb(t, saturation_humidity(t, 101325), 101325).temperature, t, 1e-5);
    }
}

TEST(DryingPotential, of_worked_examples_agrees_with_independent_numbers)
{
    // Inlet degC and kg/kg, kg/s of dry air, kg/h of a solution with 30 % solids at 25 degC.
    struct Row
    {
        double celsius, humidity, air, spray, wet, saturated, eta, outlet, relative;
    };
    for (auto const& row : {Row{80, 0.008, 0.040, 1.2, 30.8663, 0.028649, 0.71749, 65.610, 0.0857},
                            {80, 0.008, 0.040, 2.4, 30.8663, 0.028649, 0.43499, 51.519, 0.2333},
                            {60, 0.008, 0.040, 1.2, 26.5031, 0.022019, 0.58389, 45.820, 0.2203},
                            {95, 0.001, 125 * 1.2 / 3600, 1.2, 30.3651, 0.027804, 0.79107, 80.850, 0.0217}}) {
        auto const wet = wet_bulb(row.celsius + zero_celsius, row.humidity, 101325);
        double const taken_up = row.spray / 3600 * 0.7 / row.air, out = row.humidity + taken_up;
        EXPECT_NEAR(wet.temperature - zero_celsius, row.wet, 0.51e-4);
        EXPECT_NEAR(wet.humidity, row.saturated, 0.51e-6);
        EXPECT_NEAR((wet.humidity - out) / (wet.humidity - row.humidity), row.eta, 1e-4);
        // All water evaporated, no heat lost: the outlet by the enthalpies of this room.
        double const total = enthalpy_per_dry(row.celsius, row.humidity) + taken_up * water_enthalpy(298.15);
        double const outlet = temperature(total / (1 + out), fraction(out));
        EXPECT_NEAR(outlet - zero_celsius, row.outlet, 1e-3);
        EXPECT_NEAR(relative_humidity(outlet, out, 101325), row.relative, 1e-4);
    }
}
}
