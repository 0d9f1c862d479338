// What is left when a run does not reach its end: stopped by hand, or by physics that went wrong.
#include "granum/io/csv.hpp"
#include "granum/io/events_file.hpp"
#include "scene/lab.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

namespace
{
using namespace granum;
using nlohmann::json;
namespace fs = std::filesystem;

class Stopped : public ::testing::TestWithParam<int>
{
  protected:
    scene::TemporaryFolder folder_;
    std::string case_ = folder_ / "case.toml", run_ = folder_ / "run", said_ = folder_ / "said";

    std::vector<std::string> run_words() const
    {
        return {"run", case_, "-n", std::to_string(GetParam()), "-o", run_, "--quiet"};
    }
    std::string in_run(std::string const& file) const { return run_ + "/" + file; }

    //! `granum report` on the folder, with no report there from before.
    void expect_report()
    {
        fs::remove(in_run("report.html"));
        scene::Program report({"report", run_}, said_);
        EXPECT_EQ(report.wait(), 0) << report.errors();
        EXPECT_GT(scene::text_of(in_run("report.html")).size(), 1000u);
    }
};

//! Rows of a collection, and whether every file it names is there and whole.
std::size_t complete_files(std::string const& folder, std::string const& collection)
{
    auto const text = scene::text_of(folder + "/" + collection);
    EXPECT_NE(text.find("</VTKFile>"), std::string::npos) << collection;
    std::size_t files = 0;
    for (std::size_t at = 0; (at = text.find("file=\"", at)) != std::string::npos; ++files) {
        at += 6;
        auto const file = text.substr(at, text.find('"', at) - at);
        EXPECT_NE(scene::text_of(folder + "/" + file).find("</VTKFile>"), std::string::npos) << file;
    }
    return files;
}
}

TEST_P(Stopped, first_signal_leaves_complete_results)
{
    for (int const signal : {SIGINT, SIGTERM}) {
        fs::remove_all(run_);
        scene::write_lab_case(case_, {{"parcels", "2000"}, {"cells", "[10, 10, 40]"}, {"duration", "\"1000 s\""}});
        scene::Program program(run_words(), said_);
        // Far enough that deposits have dried, so that there is something to lose.
        ASSERT_TRUE(scene::eventually([&] {
            std::error_code none;
            auto const size = fs::file_size(in_run("timeseries.csv"), none);
            return !none && size > 6000;
        })) << program.errors();
        program.signal(signal);
        EXPECT_EQ(program.wait(), 130) << program.errors();

        auto const summary = json::parse(scene::text_of(in_run("summary.json")));
        EXPECT_EQ(summary["ended"], "stopped");
        EXPECT_EQ(summary["run"]["ranks"], GetParam());
        double const reached = summary["run"]["simulated_s"];
        EXPECT_GT(reached, 0.0);
        EXPECT_LT(reached, 100.0);
        for (auto const* name : {"solids", "water"})
            EXPECT_LT(summary["ledger"][name]["relative_error"].get<double>(), 1e-9) << name;
        EXPECT_LT(summary["ledger"]["energy"]["relative_error"].get<double>(), 1e-6);

        auto const series = io::read_series(in_run("timeseries.csv"));
        EXPECT_NEAR(series.find("time")->back(), reached, 1e-6 * reached) << "the last step is in the series";
        auto const events = io::read_events(in_run("events.h5"));
        long sprayed = 0;
        for (double const initial : *events.find("initial")) sprayed += initial < 1;
        EXPECT_EQ(sprayed, summary["events"]["count"].get<long>());
        EXPECT_GT(sprayed, 0);
        for (auto const* kind : {"granules.pvd", "droplets.pvd", "gas.pvd"})
            EXPECT_GE(complete_files(run_, kind), 2u) << kind;
        EXPECT_EQ(complete_files(run_, "walls.pvd"), 1u);
        EXPECT_TRUE(fs::exists(in_run("report.html"))) << "the run itself writes the report";
        expect_report();
        EXPECT_EQ(scene::processes_with(run_), 0) << "nobody works on";
    }
}

TEST_P(Stopped, second_signal_ends_at_once)
{
    // Granules that fall are looked after every hundred steps only; with so many that is much longer than the tenth of
    // a second between the signals, so the second one meets a program that has not yet got to the first.
    scene::write_lab_case(case_, {{"parcels", "100000"}, {"start", "\"settled\""}});
    scene::Program program(run_words(), said_);
    ASSERT_TRUE(scene::eventually([&] { return !scene::text_of(in_run("granum.log")).empty(); })) << program.errors();
    program.signal(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 130) << program.errors();
    EXPECT_FALSE(fs::exists(in_run("summary.json"))) << "results take the time that was not granted";
    EXPECT_TRUE(scene::eventually([&] { return scene::processes_with(run_) == 0; })) << "a rank works on";
}

TEST_P(Stopped, granules_pressed_into_each_other_are_named)
{
    // Two granules meet at 600 m/s, far too soft for it: the stop at half a radius, whichever rank sees it. The cut
    // between two ranks lies at the place where they meet.
    std::ofstream(case_) << R"(
format = 1
title = "Two granules that are too soft"
[apparatus]
shape = "box"
size = ["40 mm", "20 mm", "20 mm"]
[gas]
closed = true
temperature = "20 degC"
humidity = "0 g/kg"
cells = [8, 4, 4]
[granules]
diameter = "2 mm"
density = "1445 kg/m3"
[contact]
youngs_modulus = "0.1 MPa"
[[granule]]
position = ["10 mm", "10 mm", "10 mm"]
velocity = ["300 m/s", "0 m/s", "0 m/s"]
[[granule]]
position = ["30 mm", "10 mm", "10 mm"]
velocity = ["-300 m/s", "0 m/s", "0 m/s"]
[time]
duration = "1 ms"
granule_step = "1 us"
[output]
interval = "10 us"
series_interval = "5 us"
)";
    scene::Program program(run_words(), said_);
    EXPECT_EQ(program.wait(), 70) << program.errors();
    auto const words = program.errors();
    EXPECT_NE(words.find("granules 0 and 1 overlap"), std::string::npos) << words;
    EXPECT_EQ(words.find("overlap", words.find("overlap by") + 10), std::string::npos) << "said once:\n" << words;

    auto const series = io::read_series(in_run("timeseries.csv"));
    ASSERT_GT(series.rows(), 2u);
    EXPECT_NEAR(series.find("kinetic_energy")->front(), 1445 * 3.14159265 / 6 * 8e-9 * 9e4, 1e-6) << "2 m v^2 / 2";
    EXPECT_GE(complete_files(run_, "granules.pvd"), 2u);
    EXPECT_EQ(json::parse(scene::text_of(in_run("summary.json")))["ended"], "failed") << "on any number of ranks";
    for (int rank = 0; rank < GetParam(); ++rank)
        EXPECT_TRUE(fs::exists(in_run("checkpoint/failed/000000/rank_0000" + std::to_string(rank))))
            << "all have written";
    expect_report();
    EXPECT_EQ(scene::processes_with(run_), 0) << "nobody waits for the rank that failed";
}

INSTANTIATE_TEST_SUITE_P(Ranks, Stopped, ::testing::Values(1, 2),
                         [](auto const& ranks) { return std::to_string(ranks.param) + "_ranks"; });

// Sums of many granules and of the gas agree between one rank and two long before chaos has its way.
TEST(Ranks, one_and_two_tell_the_same_at_first)
{
    scene::TemporaryFolder const folder;
    // A bed that settles would follow the gas, and what the solver leaves open in it.
    scene::write_lab_case(folder / "case.toml", {{"parcels", "2000"}, {"cells", "[10, 10, 40]"}},
                          "\n[start]\nsettling = \"0 s\"\n");
    std::map<int, json> summary;
    std::map<int, io::Series> series;
    for (int const ranks : {1, 2}) {
        auto const run = folder / ("run" + std::to_string(ranks));
        scene::Program program(
            {"run", folder / "case.toml", "-n", std::to_string(ranks), "-o", run, "--until", "50 ms", "--json"},
            folder / "said");
        ASSERT_EQ(program.wait(), 0) << program.errors();
        summary[ranks] = json::parse(scene::text_of(run + "/summary.json"));
        series[ranks] = io::read_series(run + "/timeseries.csv");
        EXPECT_EQ(summary[ranks]["run"]["ranks"], ranks);
        EXPECT_NEAR(summary[ranks]["run"]["simulated_s"].get<double>(), 0.05, 1e-12);
        for (auto const* name : {"solids", "water"})
            EXPECT_LT(summary[ranks]["ledger"][name]["relative_error"].get<double>(), 1e-9) << name;
        EXPECT_LT(summary[ranks]["ledger"]["energy"]["relative_error"].get<double>(), 1e-6);
        EXPECT_LT(summary[ranks]["ledger"]["momentum"]["relative_error"].get<double>(), 1e-9);
    }
    ASSERT_EQ(series[1].rows(), series[2].rows());
    auto const worst = [&](char const* name) {
        auto const &one = *series[1].find(name), &two = *series[2].find(name);
        double difference = 0, scale = 0;
        for (std::size_t row = 0; row < one.size(); ++row) {
            if (std::isnan(one[row]) && std::isnan(two[row])) continue;
            difference = std::max(difference, std::abs(one[row] - two[row]));
            scale = std::max(scale, std::abs(one[row]));
        }
        return scale > 0 ? difference / scale : 0;
    };
    EXPECT_EQ(worst("time"), 0);
    EXPECT_LT(worst("sprayed_solids"), 1e-12) << "the same droplets";
    EXPECT_LT(worst("bed_temperature"), 1e-6);
    EXPECT_LT(worst("outlet_humidity"), 1e-4);
    EXPECT_LT(worst("outlet_temperature"), 1e-5);
    EXPECT_LT(worst("kinetic_energy"), 1e-3);
    EXPECT_LT(worst("bed_height"), 1e-4);
    EXPECT_LT(worst("weight_over_area"), 1e-4);
    EXPECT_LT(worst("pressure_drop"), 1e-2);
    EXPECT_LT(worst("deposited_solids"), 1e-2);
    EXPECT_LT(worst("evaporated_water"), 1e-2);
}
