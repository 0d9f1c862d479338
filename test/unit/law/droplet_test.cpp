// Droplets in flight: rates and their limits, then whole lives integrated and compared with tables and an experiment.
#include "granum/base/random.hpp"
#include "granum/law/droplet/crust.hpp"
#include "granum/law/droplet/evaporation.hpp"
#include "granum/law/droplet/size.hpp"
#include "granum/law/vapour/film.hpp"
#include "granum/math/constants.hpp"
#include "scene/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace granum;
using namespace granum::law;
using droplet::Air;
using droplet::Drop;
using math::zero_celsius;

Air air(double celsius, double humidity)
{
    return {celsius + zero_celsius, material::fraction(humidity), 101325};
}

struct Life
{
    double d2, temperature;  //!< m2, K
};

//! Advances a water drop of `density` by `duration` s (midpoint rule).
Life fly(Life now, Air const& gas, double slip, double duration, double step, double density = 998)
{
    auto const slope = [&](Life const& at) {
        double const d = std::sqrt(at.d2);
        auto const rates = droplet::evaporation({d, at.temperature, 1, slip}, gas);
        double const mass = density * math::pi * d * d * d / 6;
        return Life{-4 * rates.mass / (math::pi * density * d),  // of d^2
                    (rates.heat - rates.mass * material::evaporation_enthalpy(at.temperature)) / (mass * 4186)};
    };
    for (double t = 0; t < duration - 0.5 * step; t += step) {
        auto const first = slope(now);
        auto const half = slope({now.d2 + 0.5 * step * first.d2, now.temperature + 0.5 * step * first.temperature});
        now.d2 += step * half.d2;
        now.temperature += step * half.temperature;
    }
    return now;
}

TEST(Evaporation, ends_at_an_equilibrium_where_heat_equals_evaporation)
{
    auto const gas = air(60, 0.008);
    Drop const drop{30e-6, 0, 1, 0};
    double const t = droplet::equilibrium_temperature(drop, gas);
    auto const rates = droplet::evaporation({30e-6, t, 1, 0}, gas);
    EXPECT_GT(rates.mass, 0);
    EXPECT_NEAR(rates.heat, rates.mass * material::evaporation_enthalpy(t), 1e-7 * rates.heat);
}

TEST(Evaporation, stops_in_saturated_air_of_its_own_temperature)
{
    double const w = material::fraction(material::saturation_humidity(300, 101325));
    auto const rates = droplet::evaporation({50e-6, 300, 1, 1}, {300, w, 101325});
    auto const dry = droplet::evaporation({50e-6, 300, 1, 1}, {300, 0, 101325});
    EXPECT_NEAR(rates.mass / dry.mass, 0, 1e-4);
    EXPECT_NEAR(rates.heat, 0, 1e-15);
}

TEST(Evaporation, turns_to_condensation_on_a_cold_drop_or_a_dry_salt)
{
    EXPECT_LT(droplet::evaporation({50e-6, 280, 1, 0}, air(40, 0.04)).mass, 0);
    double const saturated = material::fraction(material::saturation_humidity(300, 101325));
    EXPECT_LT(droplet::evaporation({50e-6, 300, 0.8, 0}, {300, 0.99 * saturated, 101325}).mass, 0);
}

TEST(Evaporation, stays_finite_above_boiling_and_in_pure_vapour)
{
    for (double const t : {373.15, 400.0, 470.0})
        for (double const w : {0.0, 0.5, 0.95}) {
            auto const rates = droplet::evaporation({20e-6, t, 1, 10}, {480, w, 101325});
            EXPECT_TRUE(std::isfinite(rates.mass) && std::isfinite(rates.heat)) << t << " " << w;
            EXPECT_GE(rates.heat, 0);
        }
}

TEST(Evaporation, follows_the_d2_law_with_independent_constants)
{
    // Air temperature and humidity, then T_s in degC, B_M, K in m2/s, life of d0 at equilibrium temperature.
    struct Row
    {
        double celsius, humidity, surface, spalding, k, d0, life;
    };
    Row const rows[] = {{25, 0, 7.150, 0.00628, 1.4328e-9, 1.1e-3, 844.5},
                        {25, 0, 7.150, 0.00628, 1.4328e-9, 50e-6, 1.745},
                        {60, 0.008, 25.377, 0.01245, 3.0017e-9, 30e-6, 0.300},
                        {80, 0.008, 29.490, 0.01824, 4.4808e-9, 30e-6, 0.201},
                        {20, 0.0072617, 13.443, 0.00233, 5.3551e-10, 50e-6, 4.67}};
    for (auto const& row : rows) {
        auto const gas = air(row.celsius, row.humidity);
        SCOPED_TRACE("air of " + std::to_string(row.celsius) + " degC");
        double const t = droplet::equilibrium_temperature({row.d0, 0, 1, 0}, gas);
        EXPECT_NEAR(t - zero_celsius, row.surface, 0.005 * row.surface);
        auto const film = vapour::film(t, 1, gas.temperature, gas.vapour_fraction, gas.pressure);
        EXPECT_NEAR(std::expm1(film.driving()), row.spalding, 0.005 * row.spalding);
        auto const rates = droplet::evaporation({row.d0, t, 1, 0}, gas);
        EXPECT_NEAR(4 * rates.mass / (math::pi * 998 * row.d0), row.k, 0.005 * row.k);
        // The whole flight: half the surface is gone after half the life.
        auto const half = fly({row.d0 * row.d0, t}, gas, 0, 0.5 * row.life, row.life / 4000);
        EXPECT_NEAR(half.d2 / (row.d0 * row.d0), 0.5, 0.005);
        EXPECT_NEAR(half.temperature, t, 0.01);
    }
}

TEST(Evaporation, keeps_the_d2_law_of_the_reference_case)
{
    // The case has constant properties and no thickened film: K = 4 Sh rho D ln(1 + B) / rho_l. Ours in the same air at
    // rest must follow it with the film's own density and diffusivity.
    scene::Table const table("h-10.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.number(row, "Sh") != 2) continue;
        double const d0 = table.number(row, "d0_m"), spalding = table.number(row, "B_M");
        // Dry air of 25 degC over a surface just wet enough for this B: w_s = B / (1 + B).
        double const ws = spalding / (1 + spalding);
        double const molar =
            ws / material::molar_mass_water / (ws / material::molar_mass_water + (1 - ws) / material::molar_mass_air);
        double const t = 298.15, activity = molar * 101325 / material::saturation_pressure(t);
        auto const film = vapour::film(t, activity, t, 0, 101325);
        double const k = 4 * droplet::evaporation({d0, t, activity, 0}, {t, 0, 101325}).mass / (math::pi * 997 * d0);
        double const expected = table.number(row, "K_m2_per_s") * film.density * film.diffusivity / (1.1 * 2.6e-5);
        EXPECT_NEAR(k, expected, 1e-6 * expected);
    }
}

TEST(WetBulbDrop, lies_near_the_reference_table_over_all_humidities)
{
    scene::Table const table("h-03.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        Air const gas{30 + zero_celsius, table.number(row, "vapour_mass_fraction"), 101325};
        double const t = droplet::equilibrium_temperature({1e-3, 0, 1, 3}, gas) - zero_celsius;
        double const humidity = table.number(row, "RH_percent");
        // The table holds the thermodynamic wet bulb; a drop settles at the diffusive one, which lies lower the drier
        // the air. Another code's steady drop misses the table by 0.60 K at 20 % and by 1.01 K in dry air.
        EXPECT_NEAR(t, table.number(row, "wet_bulb_C"), humidity >= 30 ? 0.5 : 1.0) << humidity << " % humidity";
        EXPECT_NEAR(t, table.number(row, "mfix_steady_C"), 0.25) << humidity << " % humidity";
        if (humidity == 50) {
            EXPECT_GT(t, 21.5);
            EXPECT_LT(t, 22.1);
        }
    }
}

TEST(SuspendedDrop, loses_its_surface_as_measured)
{
    scene::Table const d2("h-04-d2.csv"), temperature("h-04-T.csv");
    struct Run
    {
        char const* name;
        double speed, vapour;
    };
    Run const runs[] = {
        {"Re60_RH30", 0.813, 0.008059}, {"Re150_RH30", 2.03, 0.008059}, {"Re60_RH0", 0.813, 0}, {"Re150_RH0", 2.03, 0}};
    double const start = 15 + zero_celsius;
    for (auto const& run : runs) {
        Air const gas{30 + zero_celsius, run.vapour, 101325};
        Life now{1.2e-3 * 1.2e-3, start};
        for (std::size_t row = 1; row < d2.rows(); ++row) {
            now = fly(now, gas, run.speed, d2.number(row, "t_s") - d2.number(row - 1, "t_s"), 0.01);
            EXPECT_NEAR(now.d2 / (1.2e-3 * 1.2e-3), d2.number(row, run.name), 0.03)
                << run.name << " at " << d2.number(row, "t_s") << " s";
        }
        if (std::string(run.name) == "Re150_RH30") continue;  // not in the measured temperatures
        // The support conducts heat into the measured drop: dry air cools it by 2.4 to 2.9 K only, where even the
        // thermodynamic wet bulb is 4.5 K below the start. Ours has no support, so it must be the colder by no more.
        double const measured = temperature.number(temperature.rows() - 1, run.name);
        EXPECT_NEAR(now.temperature - start, measured, run.vapour > 0 ? 1 : 3) << run.name;
        EXPECT_LT(now.temperature - start, measured) << run.name;
    }
}

TEST(WaterActivity, is_that_of_raoult_until_saturation_and_constant_beyond)
{
    auto const benzoate = [](double moisture) { return droplet::water_activity(moisture, 0.63, 0.1441, 2); };
    EXPECT_NEAR(benzoate(1e9), 1, 1e-8);
    double const feed = 1 / (1 + 2 * 18.015 / (144.1 * (0.7 / 0.3)));
    EXPECT_NEAR(benzoate(0.7 / 0.3), feed, 1e-12);
    EXPECT_LT(benzoate(1.7), benzoate(2.3));
    EXPECT_DOUBLE_EQ(benzoate(1 / 0.63), benzoate(0.1));
    EXPECT_DOUBLE_EQ(benzoate(0), benzoate(0.1));
    EXPECT_EQ(droplet::water_activity(0.01, 0, 0.1, 1), 1) << "a suspension's water is free";
}

TEST(LogNormal, has_the_means_of_hatch_and_choate)
{
    EXPECT_NEAR(droplet::sauter(40e-6, 1.6), 35.817e-6, 0.5e-9);
    EXPECT_NEAR(droplet::number_mean(40e-6, 1.6), 23.026e-6, 0.5e-9);
    EXPECT_NEAR(droplet::volume_mean(40e-6, 1.6), 44.671e-6, 0.5e-9);
}

TEST(LogNormal, sampled_by_volume_has_its_median_and_its_sauter_diameter)
{
    base::Random random(7, base::Purpose::test, 0, 0);
    std::vector<double> sample(100000);
    double inverse = 0;
    for (auto& d : sample) {
        d = droplet::sample_volume_weighted(40e-6, 1.6, random.normal());
        inverse += 1 / d;
    }
    std::nth_element(sample.begin(), sample.begin() + 50000, sample.end());
    EXPECT_NEAR(sample[50000], 40e-6, 0.01 * 40e-6);
    EXPECT_NEAR(static_cast<double>(sample.size()) / inverse, 35.817e-6, 0.01 * 35.817e-6);
}

TEST(RosinRammler, has_the_percentiles_and_means_of_the_reference_case)
{
    scene::Table const table("g-05.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        droplet::RosinRammler const size{table.number(row, "d_prime_m"), table.number(row, "n")};
        auto const expect = [&](double value, std::string const& column) {
            EXPECT_NEAR(value, table.number(row, column), 1e-8 * table.number(row, column)) << column;
        };
        expect(size.quantile(0.1), "d10_m");
        expect(size.quantile(0.5), "d50_m");
        expect(size.quantile(0.9), "d90_m");
        expect(size.sauter(), "d32_m");
        expect(size.volume_mean(), "volume_mean_d43_m");
    }
}

TEST(Crust, gathers_solids_at_the_surface_as_vehring_says)
{
    EXPECT_EQ(droplet::surface_enrichment(0), 1);
    EXPECT_NEAR(droplet::surface_enrichment(1), 1 + 0.2 + 0.01 - 0.00025, 1e-15);
    EXPECT_NEAR(droplet::surface_enrichment(10), 1 + 2 + 1 - 0.25, 1e-15);
    EXPECT_EQ(droplet::surface_enrichment(50), droplet::surface_enrichment(20));
}

TEST(Crust, is_a_shell_in_series_with_the_film)
{
    // A core of half the diameter behind 1e-6 m2/s, film of 2 * 2.6e-5: 1 / (1 + 26 (2 - 1)).
    EXPECT_NEAR(droplet::through_crust(5.2e-5, 1e-6, 0.5), 1.0 / 27, 1e-15);
    EXPECT_EQ(droplet::through_crust(5.2e-5, 1e-6, 1), 1);
    EXPECT_EQ(droplet::through_crust(5.2e-5, 1e-6, 0), 0);
    // Pores that hold an eighth of what they could are wet to half the diameter.
    double const all = 0.4 * granum::math::pi / 6 * 1e-12;
    EXPECT_NEAR(droplet::wet_core(all / 8, 1e-4, 0.4), 0.5, 1e-12);
    EXPECT_EQ(droplet::wet_core(2 * all, 1e-4, 0.4), 1);
}
}
