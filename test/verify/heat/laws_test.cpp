// Reference cases H-06, H-08, H-09 and X-06 and row P12: closures and moist air as such, against tables of others.
#include "granum/law/drag/all.hpp"
#include "granum/law/heat/all.hpp"
#include "granum/law/heat/biot.hpp"
#include "granum/material/moist_air.hpp"
#include "scene/reference.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;
using namespace granum::law;
using namespace granum::material;
using math::zero_celsius;

//! A tolerance of the table, relative unless it says "abs".
double margin(std::string const& text, double value)
{
    return text.starts_with("abs ") ? std::stod(text.substr(4)) : std::stod(text) * std::abs(value);
}

TEST(MoistAir, agrees_with_the_saturation_tables)
{
    scene::Table const table("h-06-saturation.csv");
    struct Kind
    {
        char const *name, *words;
        double (*ours)(double celsius, double pressure);
    };
    for (auto const &kind : {Kind{"saturation_pressure_Pa", "saturation pressure",
                                  [](double t, double) { return saturation_pressure(t + zero_celsius); }},
                             Kind{"saturation_humidity_ratio", "saturation humidity",
                                  [](double t, double p) { return saturation_humidity(t + zero_celsius, p); }},
                             Kind{"saturated_air_enthalpy_J_kg", "enthalpy of saturated air",
                                  [](double t, double p) {
                                      double const y = saturation_humidity(t + zero_celsius, p);
                                      return (1 + y) * enthalpy(t + zero_celsius, fraction(y));
                                  }},
                             Kind{"dry_air_enthalpy_J_kg", "enthalpy of dry air",
                                  [](double t, double) { return enthalpy(t + zero_celsius, 0); }},
                             Kind{"dry_air_volume_m3_kg", "volume of dry air",
                                  [](double t, double p) { return 1 / density(p, t + zero_celsius, 0); }}}) {
        double worst = 0;
        int count = 0;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (table.text(row, "quantity") != kind.name) continue;
            double const value = table.number(row, "value");
            double const ours = kind.ours(table.number(row, "T_C"), table.number(row, "p_Pa"));
            worst = std::max(worst, std::abs(ours - value) / margin(table.text(row, "tolerance"), value));
            ++count;
        }
        EXPECT_GT(count, 0) << kind.name;
        verify::below("H06",
                      fmt::format("moist air, {}: largest part of ASHRAE's tolerance, {} entries", kind.words, count),
                      1, worst);
    }
}

TEST(MoistAir, agrees_with_unsaturated_air)
{
    scene::Table const table("h-06-moist.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        auto const &quantity = table.text(row, "quantity"), &inputs = table.text(row, "inputs");
        double const value = table.number(row, "value");
        auto const given = [&](std::string const& name) { return scene::number_after(inputs, name); };
        double const allowed = margin(table.text(row, "tolerance"), value);
        if (quantity == "wet_bulb_C" && inputs.find("RH=") != std::string::npos) {
            double const t = given("T") + zero_celsius, p = given("p"), partial = given("RH") * saturation_pressure(t);
            double const ours = wet_bulb(t, molar_ratio * partial / (p - partial), p).temperature - zero_celsius;
            verify::absolute("H06", "moist air, wet bulb of " + inputs + ", degC", value, ours, allowed);
        }
        if (quantity == "moist_volume_m3_kg" && inputs.find("W=") != std::string::npos)
            verify::absolute("H06", "moist air, volume at " + inputs + ", m3 per kg dry", value,
                             (1 + given("W")) / density(given("p"), given("T") + zero_celsius, fraction(given("W"))),
                             allowed);
        if (quantity == "moist_density_kg_m3" && inputs.find("W=") != std::string::npos)
            verify::absolute("H06", "moist air, density at " + inputs + ", kg/m3", value,
                             density(given("p"), given("T") + zero_celsius, fraction(given("W"))), allowed);
        if (quantity == "moist_enthalpy_J_kg" && inputs.find("W=") != std::string::npos)
            verify::absolute("H06", "moist air, enthalpy at " + inputs + ", J per kg dry", value,
                             (1 + given("W")) * enthalpy(given("T") + zero_celsius, fraction(given("W"))), allowed);
    }
}

TEST(LumpedGranule, is_as_good_as_its_biot_number_says)
{
    scene::Table const table("h-08.csv");
    double const diameter = 1e-3, conductivity = 0.2;
    for (double const given : {0.01, 0.1}) {
        double lumped = 0, corrected = 0;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (table.number(row, "Bi") != given) continue;
            double const fourier = table.number(row, "Fo"), mean = table.number(row, "theta_mean");
            double const coefficient = given * conductivity / (diameter / 2);
            double const biot = heat::biot(coefficient, diameter, conductivity);
            double const slowed = heat::lumped_coefficient(coefficient, biot) / coefficient;
            lumped = std::max(lumped, std::abs(std::exp(-3 * given * fourier) - mean));
            corrected = std::max(corrected, std::abs(std::exp(-3 * slowed * given * fourier) - mean));
        }
        std::string const name = fmt::format("sphere in a film, h R / k = {}: ", given);
        verify::below("H08", name + "lumped mean temperature, largest difference", 0.07 * given, lumped);
        verify::below("H08", name + "that with the corrected film, largest difference", 1e-3, corrected);
    }
    double beyond = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const given = table.number(row, "Bi");
        if (given < 1) continue;
        double const lumped = std::exp(-3 * given * table.number(row, "Fo"));
        for (auto const* column : {"theta_centre", "theta_surface", "theta_mean"})
            beyond = std::max(beyond, std::abs(lumped - table.number(row, column)));
    }
    verify::differs("H08", "sphere in a film, h R / k of 1 and more: centre, surface, mean, largest difference", 1,
                    beyond, "granules have one temperature each: for Biot numbers below 0.1");
}

TEST(Gunn, agrees_with_the_reference_case)
{
    scene::Table const table("h-09.csv");
    double gunn = 0, sphere = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        heat::Flow const flow{1 - table.number(row, "eps"), table.number(row, "Re"), table.number(row, "Pr")};
        gunn = std::max(gunn, std::abs(heat::Gunn{}(flow) / table.number(row, "Nu_gunn") - 1));
        sphere = std::max(sphere, std::abs(heat::RanzMarshall{}(flow) / table.number(row, "Nu_ranz_marshall_0.6") - 1));
    }
    verify::below("H09", fmt::format("Nusselt number of Gunn: largest share off, {} entries", table.rows()), 1e-6,
                  gunn);
    verify::below("H09",
                  fmt::format("Nusselt number of Ranz and Marshall: largest share off, {} entries", table.rows()), 1e-6,
                  sphere);
}

TEST(DragLaws, agree_with_the_reference_case_per_volume)
{
    scene::Table const table("x-06.csv");
    double const viscosity = 1.8e-5, diameter = 1e-3;
    std::vector<std::pair<std::string, std::string>> const laws{
        {"ergun", "beta_ergun"},         {"wen-yu", "beta_wen_yu"},     {"gidaspow", "beta_gidaspow"},
        {"di-felice", "beta_di_felice"}, {"beetstra", "beta_beetstra"}, {"koch-hill", "beta_koch_hill"}};
    for (auto const& [name, column] : laws) {
        auto const law = *drag::All::make(name);
        double worst = 0;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            double const eps = table.number(row, "eps"), phi = 1 - eps;
            // beta = 18 mu eps phi F / d^2
            double const ours = 18 * viscosity * eps * phi / (diameter * diameter) *
                                drag::force_ratio(law, {phi, table.number(row, "Re_superficial")});
            worst = std::max(worst, std::abs(ours / table.number(row, column) - 1));
        }
        std::string const what =
            fmt::format("exchange coefficient of {}: largest share off, {} entries", name, table.rows());
        // The case switches at a voidage of 0.8; ours blends both laws around it.
        if (name == "gidaspow")
            verify::differs("X06", what, 0.5, worst, "the case switches between two laws where ours blends");
        else
            verify::below("X06", what, 1e-3, worst);
    }
}
}
