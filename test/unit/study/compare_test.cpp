// A plant's curves are read as loggers write them, offsets are found where they are, and their causes follow from the
// balances.
#include "granum/study/compare.hpp"

#include "granum/base/error.hpp"
#include "granum/io/csv.hpp"
#include "granum/io/logged.hpp"
#include "granum/io/text_file.hpp"
#include "granum/study/offset_causes.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace
{
using namespace granum;
using namespace granum::study;

//! A run of 20 s whose outlet has 65 degC and 13.8 g/kg, its bed 66 degC, with the swings of a bubbling bed.
void write_run(std::string const& folder)
{
    std::filesystem::create_directories(folder + "/checkpoint");
    std::ofstream(folder + "/checkpoint/case.txt")
        << "file = " GRANUM_SOURCE_DIR "/examples/01-lab-layering/case.toml\n";
    io::SeriesWriter series(
        folder + "/timeseries.csv",
        {{"time", "s"}, {"outlet_temperature", "K"}, {"outlet_humidity", "kg/kg"}, {"pressure_drop", "Pa"}});
    for (int k = 0; k <= 400; ++k) {
        double const t = 0.05 * k, swing = std::sin(9 * t);
        series.append(std::array{t, 338.15 + 0.2 * swing, 0.0138 + 1e-5 * swing, 360 + 30 * swing});
    }
    std::ofstream(folder + "/summary.json")
        << R"({"result": {"outlet_temperature_K": 338.15, "outlet_humidity": 0.0138}, "bed": {"weight_over_area_Pa": 360}})";
}

std::string mistake(auto&& act)
{
    try {
        act();
    } catch (base::CaseError const& error) {
        return error.what();
    }
    return "";
}

TEST(Logged, reads_what_a_logger_in_a_country_of_decimal_commas_wrote)
{
    scene::TemporaryFolder const folder;
    auto const path = folder / "plant.csv";
    std::ofstream(path) << "\xef\xbb\xbf# batch 7\r\nZeit;Time [min];Exhaust temperature (\xc2\xb0"
                           "C);Spray rate [g/min]\r\n"
                           "a;0,5;60,25;20\r\n\r\nb;1,0;;18,5\r\n";
    std::vector<std::string> left;
    auto const series = io::read_logged(path,
                                        {{"time", io::Dimension::time},
                                         {"exhaust_temperature", io::Dimension::temperature},
                                         {"spray_rate", io::Dimension::mass_flow}},
                                        left);
    EXPECT_EQ(left, std::vector<std::string>{"zeit"});
    ASSERT_EQ(series.rows(), 2U);
    EXPECT_EQ(*series.find("time"), (std::vector<double>{30, 60}));
    EXPECT_NEAR(series.find("exhaust_temperature")->at(0), 333.4, 1e-9);
    EXPECT_TRUE(std::isnan(series.find("exhaust_temperature")->at(1)));
    EXPECT_NEAR(series.find("spray_rate")->at(1), 18.5e-3 / 60, 1e-12);
}

TEST(Logged, takes_a_row_of_units_as_in_our_own_files)
{
    scene::TemporaryFolder const folder;
    std::ofstream(folder / "plant.csv") << "time,bed_height\ns,mm\n1,2\n";
    std::vector<std::string> left;
    auto const series = io::read_logged(folder / "plant.csv",
                                        {{"time", io::Dimension::time}, {"bed_height", io::Dimension::length}}, left);
    EXPECT_DOUBLE_EQ(series.find("bed_height")->at(0), 2e-3);
}

TEST(Logged, tells_line_and_column_of_what_is_wrong)
{
    scene::TemporaryFolder const folder;
    auto const said = [&](std::string const& text) {
        std::ofstream(folder / "plant.csv") << text;
        std::vector<std::string> left;
        return mistake([&] { io::read_logged(folder / "plant.csv", {{"time", io::Dimension::time}}, left); });
    };
    EXPECT_NE(said("time [min]\n1\n12:30\n").find("plant.csv:3: time is \"12:30\": not a number"), std::string::npos);
    EXPECT_NE(said("time\n1\n").find("needs its unit"), std::string::npos);
    EXPECT_NE(said("time [mm]\n1\n").find("plant.csv:2: time in [mm]"), std::string::npos) << said("time [mm]\n1\n");
    EXPECT_NE(said("time [s],x\n1\n").find("has 1 fields, the first row 2"), std::string::npos);
    EXPECT_NE(said("time [s],Time (s)\n1,1\n").find("is there twice"), std::string::npos);
    EXPECT_NE(said("# nothing\n").find("holds no table"), std::string::npos);
}

TEST(Compare, finds_the_offset_and_what_agrees)
{
    scene::TemporaryFolder const folder;
    write_run(folder / "run");
    std::ofstream plant(folder / "plant.csv");
    plant << "time [min],exhaust temperature [degC],outlet humidity [g/kg],pressure drop [mbar],operator\n";
    for (int k = 0; k <= 40; ++k) plant << fmt::format("{},60,13.8,{},7\n", 20 + k / 60.0, k % 2 ? 3.7 : 3.5);
    plant.close();
    auto const result = compare(folder / "run", folder / "plant.csv", 1200);
    ASSERT_EQ(result.quantities.size(), 3U);
    EXPECT_EQ(result.left, std::vector<std::string>{"operator"});
    auto const& temperature = result.quantities[0];
    EXPECT_EQ(temperature.name, "outlet_temperature");
    EXPECT_NEAR(temperature.offset, 5, 0.05);
    EXPECT_NEAR(temperature.plant_mean, 333.15, 1e-9);
    EXPECT_FALSE(temperature.agrees);
    EXPECT_TRUE(result.quantities[1].agrees);
    EXPECT_TRUE(result.quantities[2].agrees);
    EXPECT_NEAR(result.quantities[2].offset, 0, 3);
    EXPECT_NEAR(result.from, 0, 1e-9);
    EXPECT_NEAR(result.to, 20, 1e-9);
    ASSERT_EQ(result.causes.size(), 1U);
    EXPECT_NE(result.causes[0].find("heat lost"), std::string::npos) << result.causes[0];
    write(result);
    EXPECT_TRUE(std::filesystem::exists(folder / "run/compare.html"));
    auto const table = io::read_text(folder / "run/compare.csv");
    EXPECT_NE(table.find("outlet_temperature,338."), std::string::npos) << table;
}

TEST(Compare, says_what_it_cannot_lay_over_each_other)
{
    scene::TemporaryFolder const folder;
    write_run(folder / "run");
    auto const said = [&](std::string const& text) {
        std::ofstream(folder / "plant.csv") << text;
        return mistake([&] { compare(folder / "run", folder / "plant.csv", 0); });
    };
    EXPECT_NE(said("time [min],exhaust temperature [degC]\n20,60\n21,60\n").find("--shift"), std::string::npos);
    EXPECT_NE(said("time [min],colour\n0,1\n").find("shares no quantity"), std::string::npos);
    EXPECT_NE(said("bed temperature [degC]\n1\n").find("time is no column"), std::string::npos);
    EXPECT_NE(said("time [s],bed height [mm],outlet humidity [g/kg]\n1,1,1\n1,1,1\n").find("does not rise at 1 s"),
              std::string::npos);
    EXPECT_NE(mistake([&] { compare(folder / "no", folder / "plant.csv", 0); }).find("no such run folder"),
              std::string::npos);
}

// By hand: 0.04 kg/s of dry air, 5 K, (1006 + 0.0138 * 1860) J/kg K: 206 W; over 65 - 20 K: 4.6 W/K.
TEST(Causes, of_a_colder_outlet_at_the_same_humidity_is_a_loss_of_heat)
{
    auto const causes =
        likely_causes({.outlet_temperature = 5}, {.dry_flow = 0.04, .temperature = 338.15, .humidity = 0.0138});
    ASSERT_EQ(causes.size(), 1U);
    EXPECT_NE(causes[0].find("206 W less enthalpy"), std::string::npos) << causes[0];
    EXPECT_NE(causes[0].find("4.6 W/K, with"), std::string::npos) << causes[0];
}

// 2 g/kg of 0.04 kg/s are 4.8 g/min. Their heat of evaporation, 2501 + 1.86 * 60 kJ/kg at 60 degC, is 209 W: a plant
// whose outlet is colder by what its additional water takes loses next to nothing.
TEST(Causes, of_a_wetter_and_colder_outlet_is_more_water_not_a_loss)
{
    auto const causes = likely_causes({.outlet_temperature = 5, .outlet_humidity = -0.002},
                                      {.dry_flow = 0.04, .temperature = 338.15, .humidity = 0.0138});
    ASSERT_EQ(causes.size(), 2U);
    EXPECT_NE(causes[0].find("4.8 g/min less water leaves with the run's air"), std::string::npos) << causes[0];
    double watts = 0;
    ASSERT_EQ(std::sscanf(causes[1].c_str(), "The plant's air leaves with %lf W", &watts), 1) << causes[1];
    EXPECT_LT(watts, 5);
}

TEST(Causes, of_a_bed_that_is_too_heavy_are_told_in_kg)
{
    // 36 Pa over 0.0277 m2: 0.1 kg.
    auto const causes = likely_causes({.pressure_drop = -36}, {.area = 0.02725});
    ASSERT_EQ(causes.size(), 1U);
    EXPECT_NE(causes[0].find("0.1 kg"), std::string::npos) << causes[0];
    EXPECT_NE(causes[0].find("plate"), std::string::npos);
    EXPECT_TRUE(likely_causes({}, {}).empty());
}
}
