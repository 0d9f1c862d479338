// Heat and mass transfer between granules and gas: the laws against tables made elsewhere; radiation; whether one
// temperature is enough.
#include "granum/law/heat/all.hpp"
#include "granum/law/heat/biot.hpp"
#include "granum/law/heat/radiation.hpp"
#include "granum/math/constants.hpp"
#include "scene/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::law;
using heat::Flow;

TEST(HeatLaws, agree_with_independent_numbers)
{
    struct Row
    {
        double re, eps, ranz_marshall, gunn, sun, deen;
    };
    Row const rows[] = {{1, 0.5, 2.5353, 5.6632, 5.1993, 4.1577},
                        {10, 0.5, 3.6927, 8.3892, 6.8814, 6.1103},
                        {100, 0.5, 7.3527, 17.9838, 15.3122, 14.9082},
                        {50, 0.7, 5.7849, 9.0787, 7.0917, 7.1442},
                        {50, 1, 5.7849, 6.5244, 4.3450, 5.1462}};
    for (auto const& row : rows) {
        Flow const flow{1 - row.eps, row.re, 0.71};
        EXPECT_NEAR(heat::RanzMarshall{}(flow), row.ranz_marshall, 0.51e-4);
        EXPECT_NEAR(heat::Gunn{}(flow), row.gunn, 0.51e-4);
        EXPECT_NEAR(heat::Sun{}(flow), row.sun, 0.51e-4);
        EXPECT_NEAR(heat::Deen{}(flow), row.deen, 0.51e-4);
    }
}

TEST(HeatLaws, agree_with_the_reference_case)
{
    scene::Table const table("h-09.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        Flow const flow{1 - table.number(row, "eps"), table.number(row, "Re"), table.number(row, "Pr")};
        EXPECT_NEAR(heat::Gunn{}(flow), table.number(row, "Nu_gunn"), 1e-6 * table.number(row, "Nu_gunn"));
        EXPECT_NEAR(heat::RanzMarshall{}(flow), table.number(row, "Nu_ranz_marshall_0.6"), 1e-6 * 20);
    }
}

TEST(HeatLaws, of_one_sphere_in_still_gas_are_pure_conduction)
{
    EXPECT_DOUBLE_EQ(heat::RanzMarshall{}({0, 0, 0.7}), 2);
    EXPECT_NEAR(heat::Gunn{}({0, 0, 0.7}), 2, 1e-12);
    EXPECT_NEAR(heat::Sun{}({0, 0, 0.7}), 2, 1e-12);
    EXPECT_NEAR(heat::Deen{}({0, 0, 0.7}), 2, 1e-12);
}

TEST(HeatLaws, grow_with_speed_and_stay_finite_beyond_their_range)
{
    for (auto const& name : heat::All::names()) {
        auto const law = *heat::All::make(name);
        for (double const phi : {0.0, 0.2, 0.45, 0.9}) {
            double last = 0;
            for (double const re : {-1.0, 0.01, 1.0, 100.0, 1e4}) {
                double const nusselt = heat::nusselt(law, {phi, re, 0.7});
                EXPECT_GT(nusselt, last) << name << " at solid fraction " << phi << " and Re " << re;
                last = nusselt;
            }
        }
    }
}

// MFIX's test of radiation (21.3.2, legacy_tests/dem-tests/radiation/usr2_des.f): spheres of 3 and 3.6 mm, emissivity
// 0.8; its rates of dT/dt = rate (T_s^4 - T^4) were read there.
TEST(Radiation, has_the_rates_of_the_published_pair)
{
    struct Sphere
    {
        double diameter, density, capacity, rate;
    };
    for (auto const& sphere : {Sphere{3e-3, 420, 0.191204 * 4184, 2.70024635866355e-10},
                               {3.6e-3, 8850, 0.013145 * 4184, 1.55333291786026e-10}}) {
        double const area = math::pi * sphere.diameter * sphere.diameter;
        double const mass = sphere.density * area * sphere.diameter / 6;
        double const hot = 400, cold = 298.15;
        double const rate = heat::radiation(0.8, area, hot, cold).heat / (mass * sphere.capacity) /
                            (std::pow(hot, 4) - std::pow(cold, 4));
        // MFIX's constants in calories differ in the fifth digit.
        EXPECT_NEAR(rate, sphere.rate, 1e-4 * sphere.rate) << sphere.diameter;
    }
}

TEST(Radiation, is_a_line_through_the_present_temperature)
{
    auto const at = [](double temperature) { return heat::radiation(0.9, 1e-6, 420, temperature); };
    EXPECT_EQ(at(420).heat, 0);
    EXPECT_GT(at(350).heat, 0);
    EXPECT_LT(at(500).heat, 0);
    for (double const temperature : {300.0, 420.0, 600.0})
        EXPECT_NEAR((at(temperature + 0.01).heat - at(temperature - 0.01).heat) / 0.02, at(temperature).slope,
                    1e-7 * std::abs(at(temperature).slope));
    // A black square metre against nothing at 1000 K: 56.70374 kW.
    EXPECT_NEAR(heat::radiation(1, 1, 0, 1000).heat, -56703.74, 1e-6);
    EXPECT_DOUBLE_EQ(heat::surroundings(0.25, 400, 300), 375);
}

// The reference case: a sphere cooled through a film, resolved. Its Biot number is h R / k.
TEST(LumpedGranule, is_as_wrong_as_its_biot_number_says)
{
    scene::Table const table("h-08.csv");
    double const diameter = 1e-3, conductivity = 0.2;
    double worst_valid = 0, best_invalid = 1;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const given = table.number(row, "Bi"), fourier = table.number(row, "Fo");
        double const mean = table.number(row, "theta_mean");
        double const coefficient = given * conductivity / (diameter / 2);
        double const biot = heat::biot(coefficient, diameter, conductivity);
        EXPECT_DOUBLE_EQ(biot, given / 3);
        double const lumped = std::exp(-3 * given * fourier);
        double const error = std::abs(lumped - mean);
        if (biot < heat::largest_lumped_biot) {
            // No more than the rate's error over the way gone; a part of it comes from before the profile has formed.
            double const expected = heat::lumped_rate_error(biot) * 3 * given * fourier * mean;
            EXPECT_LE(error, expected + 0.02 * given * given) << "Bi " << given << " Fo " << fourier;
            worst_valid = std::max(worst_valid, error);
            // With the resistance inside in the film the curve is met within the second order of the Biot number.
            double const slowed = 3 * heat::lumped_coefficient(coefficient, biot) / coefficient * given * fourier;
            EXPECT_NEAR(std::exp(-slowed), mean, 0.02 * given * given) << "Bi " << given << " Fo " << fourier;
        } else if (fourier == 0.2 && given <= 10) {
            best_invalid = std::min(best_invalid, error);
        }
    }
    EXPECT_NEAR(worst_valid, 0.0065, 0.0005);
    EXPECT_GT(best_invalid, 0.05);
}

TEST(LumpedGranule, cools_too_fast_by_the_first_order_of_the_biot_number)
{
    scene::Table const table("h-08.csv");
    auto const mean = [&](double biot, double fourier) {
        for (std::size_t row = 0; row < table.rows(); ++row)
            if (table.number(row, "Bi") == biot && table.number(row, "Fo") == fourier)
                return table.number(row, "theta_mean");
        throw std::runtime_error("no such row");
    };
    for (double const given : {0.01, 0.1}) {
        double const rate = std::log(mean(given, 0.5) / mean(given, 2)) / 1.5;
        EXPECT_NEAR(3 * given / rate - 1, heat::lumped_rate_error(given / 3), 0.02 * given * given + 1e-6) << given;
    }
}
}
