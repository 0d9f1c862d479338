// A spray as a case states it: its air by flow or by pressure, its droplets by a law, a measurement or a correlation.
#include "granum/law/droplet/size.hpp"
#include "granum/sim/build.hpp"
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::sim;

std::string with(std::string const& spray, std::string const& nozzle)
{
    return R"([apparatus]
shape = "box"
size = ["100 mm", "100 mm", "400 mm"]
[gas]
velocity = "0.5 m/s"
temperature = "80 degC"
humidity = "8 g/kg"
cells = [4, 4, 16]
[granules]
diameter = "0.6 mm"
density = "1445 kg/m3"
mass = "0.1 kg"
[contact]
youngs_modulus = "10 MPa"
[time]
duration = "1 s"
[spray]
liquid = "sodium-benzoate-30"
rate = "0.1 kg/h"
solids_fraction = "30 %"
)" + spray +
           "[[nozzle]]\nposition = [\"50 mm\", \"50 mm\", \"300 mm\"]\n" + nozzle;
}

std::string mistakes_of(std::string const& text)
{
    try {
        scene::case_of(text);
    } catch (base::CaseError const& error) {
        return error.what();
    }
    return "";
}

TEST(NozzleCase, has_the_air_that_its_pressure_drives)
{
    auto const data = scene::case_of(with("",
                                          "air_pressure = \"3 bar\"\nair_mouth = \"1 mm2\"\ndischarge = 1\n"
                                          "air_temperature = \"293 K\"\nair_humidity = \"5 g/kg\"\n"));
    auto const nozzle = sim::nozzles(data).at(0);
    EXPECT_NEAR(nozzle.air_mass_flow, 7.083e-4, 5e-8);
    EXPECT_NEAR(nozzle.momentum(), 1.26 * 7.083e-4 * 313, 0.002);

    auto const wrong = [](std::string const& nozzle_lines, char const* why) {
        auto const what = mistakes_of(with("", nozzle_lines));
        EXPECT_NE(what.find(why), std::string::npos) << nozzle_lines << what;
    };
    wrong("air_pressure = \"3 bar\"\nair_mouth = \"1 mm2\"\nair = \"1 kg/h\"\n", "follows from air_pressure");
    wrong("air_pressure = \"0.9 bar\"\nair_mouth = \"1 mm2\"\n", "nozzle[0].air_pressure");
    wrong("air_pressure = \"3 bar\"\n", "nozzle[0].air_mouth");
    wrong("air_mouth = \"1 mm2\"\n", "needs air_pressure");
}

TEST(SprayCase, takes_a_measured_distribution_of_its_droplets)
{
    std::string const size =
        "size = { distribution = \"rosin-rammler\", characteristic = \"45 um\", exponent = 2.5, min = \"1 um\", max "
        "= \"150 um\" }\n";
    auto const nozzle = sim::nozzles(scene::case_of(with(size, ""))).at(0);
    EXPECT_NEAR(nozzle.median_diameter(), 45e-6 * std::pow(std::log(2), 1 / 2.5), 1e-8);
    EXPECT_NE(mistakes_of(with(size + "droplet_median = \"40 um\"\n", "")).find("does not go with spray.size"),
              std::string::npos);
    EXPECT_NE(mistakes_of(with("size = { distribution = \"list\", diameters = [\"20 um\"], shares = [1, 2] }\n", ""))
                  .find("spray.size.shares"),
              std::string::npos);
}

TEST(SprayCase, takes_the_size_of_its_droplets_from_a_correlation)
{
    std::string const air = "air_pressure = \"2 bar\"\nair_mouth = \"1 mm2\"\n";
    auto const of = [&](std::string const& law, std::string const& bore) {
        return sim::nozzles(scene::case_of(with("atomisation = \"" + law + "\"\n", air + "bore = \"" + bore + "\"\n")))
            .at(0);
    };
    for (std::string const law : {"walzel", "lorenzetto-lefebvre"}) {
        auto const nozzle = of(law, "1 mm");
        double const sauter = law::droplet::sauter(nozzle.median, nozzle.spread);
        EXPECT_GT(sauter, 3e-6) << law;
        EXPECT_LT(sauter, 100e-6) << law;
        auto const without = mistakes_of(with("atomisation = \"" + law + "\"\n", air));
        EXPECT_NE(without.find("nozzle[0].bore"), std::string::npos) << without;
    }
    // Walzel's Sauter diameter goes with the bore to the power 0.6, nearly: Ohnesorge's number falls a little.
    double const ratio = of("walzel", "2 mm").median / of("walzel", "1 mm").median;
    EXPECT_GT(ratio, 1.48);
    EXPECT_LT(ratio, std::pow(2, 0.6));
    auto const both =
        mistakes_of(with("atomisation = \"walzel\"\ndroplet_median = \"40 um\"\n", air + "bore = \"1 mm\"\n"));
    EXPECT_NE(both.find("does not go with spray.atomisation"), std::string::npos) << both;
    auto const no_pressure = mistakes_of(with("atomisation = \"walzel\"\n", "air = \"1 kg/h\"\nbore = \"1 mm\"\n"));
    EXPECT_NE(no_pressure.find("nozzle[0].air_pressure"), std::string::npos) << no_pressure;
}

TEST(SprayCase, refuses_what_would_leave_nothing_to_dry)
{
    auto const refused = [](std::string const& spray, std::string const& rest, char const* why) {
        auto const what = mistakes_of(with(spray, rest));
        EXPECT_NE(what.find(why), std::string::npos) << spray << rest << what;
    };
    refused("splash_least = 0.5\nsplash_range = 0.6\n", "", "spray.splash_range");
    refused("solubility = 0\nlocking = 0.1\n", "", "the share that solids have in the feed, 0.235");
    refused("", "[drying]\nequilibrium_moisture = 3\n", "the moisture of the feed, 2.333");
    refused("", "[drying]\nequilibrium_moisture = 0.3\ncritical_moisture = 0.2\n", "drying.critical_moisture");
    refused("", "[drying]\nrea_a = 0.9\n", "has no meaning for drying.stages = \"falling-rate\"");
    refused("", "[drying]\nstages = \"reaction-engineering\"\ncritical_moisture = 0.2\n", "drying.critical_moisture");
    refused("atomisation = \"lorenzetto-lefebvre\"\n", "air = \"1 kg/h\"\nbore = \"1 mm\"\nair_velocity = \"30 m/s\"\n",
            "nothing tears the liquid");
}

std::string molten(std::string const& spray, std::string const& rest = "")
{
    auto text = with(spray, rest);
    auto const replace = [&](std::string const& old, std::string const& now) {
        text.replace(text.find(old), old.size(), now);
    };
    replace("liquid = \"sodium-benzoate-30\"\n", "liquid = \"urea-melt\"\n");
    replace("solids_fraction = \"30 %\"\n", "surface_tension = \"66 mN/m\"\ncontact_angle = \"30 deg\"\n");
    replace("temperature = \"80 degC\"", "temperature = \"40 degC\"");
    return text;
}

TEST(SprayCase, of_a_melt_has_no_water)
{
    auto const data = scene::case_of(molten("conductivity = \"0.5 W/m/K\"\ntemperature = \"140 degC\"\n"));
    EXPECT_EQ(data.spray.solids_fraction, 1);
    EXPECT_NEAR(data.spray.melting_point, 405.85, 1e-9);
    EXPECT_NEAR(data.spray.fusion_heat, 224e3, 1e-6);
    EXPECT_EQ(data.spray.locking, 0);
    EXPECT_TRUE(sim::spray_liquid(data).melt());
}

TEST(SprayCase, of_a_melt_refuses_what_only_a_solution_has)
{
    std::string const good = "conductivity = \"0.5 W/m/K\"\n";
    auto const refused = [](std::string const& text, char const* why) {
        auto const what = mistakes_of(text);
        EXPECT_NE(what.find(why), std::string::npos) << text << what;
    };
    refused(molten(""), "spray.conductivity");
    refused(molten(good + "solids_fraction = 0.9\n"), "spray.solids_fraction");
    refused(molten(good + "temperature = \"100 degC\"\n"), "spray.temperature");
    refused(molten(good + "solubility = 0.5\n"), "spray.solubility");
    refused(molten(good, "[drying]\nequilibrium_moisture = 0.1\n"), "drying.equilibrium_moisture");
    refused(with("fusion_heat = \"224 kJ/kg\"\n", ""), "has no meaning without spray.melting_point");
    refused(with("", "[drying]\nsolidification = \"gas\"\n"), "has no meaning without spray.melting_point");
    auto hot = molten(good);
    hot.replace(hot.find("temperature = \"40 degC\""), 23, "temperature = \"150 degC\"");
    refused(hot, "nothing would solidify");
}
}
