// Drying of deposits and growth of the layer they leave.
#include "granum/law/deposit/all.hpp"
#include "granum/law/deposit/rates.hpp"
#include "granum/law/deposit/solidification.hpp"
#include "granum/law/heat/ranz_marshall.hpp"
#include "granum/law/layer/growth.hpp"
#include "granum/law/layer/renewal.hpp"
#include "granum/law/wetting/footprint.hpp"
#include "scene/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{
using namespace granum;
using namespace granum::law;
using math::zero_celsius;

//! A deposit of 40 um of 30 % solution on a granule of 0.6 mm at the wet bulb of air of 60 degC and 12 g/kg.
struct Deposit
{
    deposit::Film film = deposit::film(28.734 + zero_celsius, 1, 60 + zero_celsius, material::fraction(0.012), 101325);
    double theta = 40 * math::pi / 180;
    double water = 0.7 * 1100 * math::pi * std::pow(40e-6, 3) / 6;
    double base = wetting::cap_base_radius(40e-6, 40 * math::pi / 180);
    double area = wetting::cap_area(base, theta);
};

TEST(Film, has_the_properties_of_the_one_third_rule)
{
    Deposit const d;
    EXPECT_NEAR(d.film.temperature - zero_celsius, 39.16, 0.005);
    EXPECT_NEAR(d.film.density, 1.1165, 0.51e-4);
    EXPECT_NEAR(d.film.diffusivity, 2.719e-5, 0.51e-8);
    EXPECT_NEAR(material::loading(d.film.surface_fraction), 0.025209, 0.51e-5);
}

TEST(Deposit, dries_through_the_boundary_layer_in_the_independent_times)
{
    Deposit const d;
    struct Row
    {
        double speed, re, sherwood, flux, time;
    };
    double const viscosity = material::viscosity(d.film.temperature);
    double const schmidt = viscosity / (d.film.density * d.film.diffusivity);
    for (auto const& row : {Row{0.5, 17.6, 4.154, 2.726e-3, 1.815},
                            {1.5, 52.8, 5.731, 3.760e-3, 1.316},
                            {3, 105.6, 7.277, 4.774e-3, 1.036}}) {
        double const re = d.film.density * row.speed * 0.6e-3 / viscosity;
        EXPECT_NEAR(re, row.re, 0.06);
        double const sherwood = heat::RanzMarshall{}({0, re, schmidt});
        EXPECT_NEAR(sherwood, row.sherwood, 1e-3);
        double const rate = deposit::boundary_layer_rate(sherwood, 0.6e-3, d.area, d.film);
        EXPECT_NEAR(rate / d.area, row.flux, 1e-3 * row.flux);
        EXPECT_NEAR(d.water / rate, row.time, 1e-3 * row.time);
    }
}

TEST(Deposit, dries_as_an_isolated_cap_in_the_independent_time)
{
    Deposit const d;
    EXPECT_NEAR(d.water / deposit::cap_rate(d.base, d.theta, d.film), 0.381, 0.51e-3);
}

TEST(Deposit, without_driving_force_does_not_dry_and_beyond_saturation_takes_up_water)
{
    double const w = vapour::surface_fraction(300, 1, 101325);
    EXPECT_NEAR(deposit::cap_rate(30e-6, 0.7, deposit::film(300, 1, 300, w, 101325)), 0, 1e-25);
    EXPECT_LT(deposit::cap_rate(30e-6, 0.7, deposit::film(300, 0.7, 300, w, 101325)), 0);
}

TEST(CombinedRate, is_that_of_the_cap_when_few_are_wet_and_of_the_layer_when_many_are)
{
    deposit::Combined const combined;
    double const cap = 1e-10, full = 1e-7;
    EXPECT_NEAR(combined(cap, cap, 0, full), cap, 1e-2 * cap);
    // n equal caps together approach what the boundary layer lets through.
    for (double const n : {1e6, 1e9}) EXPECT_NEAR(n * combined(cap, n * cap, 0, full), full, 2e-3 * full);
    for (double const n : {1.0, 10.0, 1e3, 1e5}) {
        double const rate = combined(cap, n * cap, 0, full);
        EXPECT_LT(rate, cap);
        EXPECT_LT(n * rate, full);
    }
    EXPECT_EQ(combined(0, 0, 0, 0), 0) << "no driving force";
    EXPECT_LT(combined(-cap, -cap, 0, -full), 0) << "uptake of water is shared alike";
    for (double const n : {1.0, 999.0, 1000.0, 1001.0, 1e6}) {
        double const uptake = combined(-cap, -n * cap, 0, full);  // salt takes up water where water would leave
        EXPECT_LT(uptake, 0);
        EXPECT_GE(uptake, -cap);
    }
}

TEST(DepositLaws, pick_their_limit_by_name)
{
    auto const rate = [](char const* name) {
        return std::visit([](auto const& law) { return law(3, 12, 5, 6); }, *deposit::All::make(name));
    };
    EXPECT_EQ(rate("cap"), 3);
    EXPECT_EQ(rate("boundary-layer"), 5);
    EXPECT_EQ(rate("combined"), 1);
}

TEST(FallingRate, follows_the_closed_form_of_a_falling_drying_curve)
{
    // X' = -r f(X) from X0 with X_cr = X0 / 2: linear to X_cr at t1 = X_cr / r, then X_cr exp(-r (t - t1) / X_cr).
    double const x0 = 2, critical = 1, rate = 0.5;
    double x = x0, t = 0, const_step = 1e-4;
    while (t < 6 - 0.5 * const_step) {
        double const half = x - 0.5 * const_step * rate * deposit::falling_rate(x, critical);
        x -= const_step * rate * deposit::falling_rate(half, critical);
        t += const_step;
        if (std::abs(t - 2) < 0.5 * const_step) {
            EXPECT_NEAR(x, critical, 1e-3);
        }
    }
    EXPECT_NEAR(x, critical * std::exp(-rate * (6 - 2) / critical), 1e-4);
    EXPECT_EQ(deposit::falling_rate(0.1, 0), 1) << "no critical moisture";
    EXPECT_EQ(deposit::falling_rate(0, 0), 0) << "nothing left";
    EXPECT_EQ(deposit::falling_rate(0.05, 1, 0.05), 0) << "at equilibrium";
    EXPECT_NEAR(deposit::falling_rate(0.5, 1, 0, 2), 0.25, 1e-12);
}

TEST(LayerGrowth, of_a_batch_agrees_with_independent_numbers)
{
    // 1 kg of 0.6 mm, 1445 kg/m3, 1.2 kg/h with 30 % solids, layer of 1440 * 0.6 kg/m3.
    double const solids_rate = 1.2 / 3600 * 0.3;
    auto const diameter = [&](double t) { return layer::batch_diameter(0.6e-3, 1, 1445, solids_rate * t, 864); };
    EXPECT_NEAR(diameter(600), 619.433e-6, 0.51e-9);
    EXPECT_NEAR(diameter(1800), 655.011e-6, 0.51e-9);
    EXPECT_NEAR(diameter(3600), 702.069e-6, 0.51e-9);
    double const count = 1 / (1445 * math::pi * std::pow(0.6e-3, 3) / 6);
    EXPECT_NEAR(count, 6118991, 1);
    double const surface = count * math::pi * 0.6e-3 * 0.6e-3;
    EXPECT_NEAR(layer::growth_rate(solids_rate, 0, 864, surface), 33.449e-9, 0.51e-12);
    EXPECT_NEAR(layer::growth_rate(solids_rate, 0.25, 864, surface), 0.75 * 33.449e-9, 0.51e-12);
}

TEST(LayerGrowth, of_equal_granules_agrees_with_the_reference_case)
{
    scene::Table const table("g-01.csv");
    double const count = 1 / (1500 * math::pi * 1e-9 / 6);
    int compared = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        auto const& name = table.text(row, "case");
        if (name.rfind("mono_eps", 0) != 0) continue;
        double const solids = 1e-4 * table.number(row, "t_s");
        double const porosity = std::stod(name.substr(8));
        double const grown = layer::grown_diameter(1e-3, layer::layer_volume(solids / count, 1400, porosity));
        EXPECT_NEAR(grown, table.number(row, "d_m"), 1e-12);
        EXPECT_NEAR(layer::batch_diameter(1e-3, 1, 1500, solids, 1400 * (1 - porosity)), grown, 1e-14);
        ++compared;
    }
    EXPECT_EQ(compared, 8);
}

TEST(LayerGrowth, in_proportion_to_surface_thickens_every_size_alike)
{
    // Four classes, integrated with the growth rate; the case has the exact thickness.
    scene::Table const table("g-01.csv");
    double diameters[] = {0.6e-3, 0.8e-3, 1.0e-3, 1.2e-3};
    double const counts[] = {4e5, 3e5, 2e5, 1e5};
    double const step = 0.5;
    for (double t = 0; t < 3600 - 0.5 * step; t += step) {
        auto const rate_at = [&](double added) {
            double surface = 0;
            for (int i = 0; i < 4; ++i)
                surface += counts[i] * math::pi * (diameters[i] + added) * (diameters[i] + added);
            return layer::growth_rate(1e-4, 0, 1400 * 0.8, surface);
        };
        double const added = step * rate_at(0.5 * step * rate_at(0));
        for (auto& d : diameters) d += added;
    }
    int compared = 0;
    for (std::size_t row = 0; row < table.rows(); ++row)
        for (auto const& [name, i] :
             {std::pair{"poly_0.0006", 0}, {"poly_0.0008", 1}, {"poly_0.001", 2}, {"poly_0.0012", 3}})
            if (table.text(row, "case") == name && table.number(row, "t_s") == 3600) {
                EXPECT_NEAR(diameters[i], table.number(row, "d_m"), 1e-9) << name;
                ++compared;
            }
    EXPECT_EQ(compared, 4);
}

// By hand: 300 W/m2/K over 6e-9 m2 and 80 K; a disc of 40 um on 0.5 W/m/K, 60 K colder: 4 x 0.5 x 40e-6 x 60.
TEST(Solidification, passes_heat_to_the_gas_and_into_the_granule)
{
    deposit::MeltCap const cap{.base_radius = 40e-6,
                               .area = 6e-9,
                               .heat_transfer = 300,
                               .conductivity = 0.5,
                               .above_gas = 80,
                               .above_granule = 60};
    EXPECT_NEAR(deposit::ToGas{}(cap), 1.44e-4, 1e-12);
    EXPECT_NEAR(deposit::ToGasAndGranule{}(cap), 1.44e-4 + 4.8e-3, 1e-12);
}

TEST(LayerSpread, falls_with_the_number_of_passes_as_renewal_theory_has_it)
{
    scene::Table const table("g-03.csv");
    for (std::size_t row = 0; row < table.rows(); ++row)
        EXPECT_NEAR(
            layer::renewal_variation(table.number(row, "process_time_s"), table.number(row, "mean_cycle_time_s"),
                                     table.number(row, "cv_mass_per_pass"), table.number(row, "cv_cycle")),
            table.number(row, "CV_theory"), 1e-6);
    EXPECT_GE(table.rows(), 8u);
    EXPECT_NEAR(layer::later_variation(3, 4, 400), 0.3, 1e-12);
}
}
