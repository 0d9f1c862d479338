// The program as a user has it: killed at any moment, stopped, given another case, done; the same command goes on.
#include "granum/base/random.hpp"
#include "granum/io/csv.hpp"
#include "granum/io/events_file.hpp"
#include "scene/lab.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

using namespace granum;
using json = nlohmann::json;
namespace fs = std::filesystem;

namespace
{
constexpr auto fallen_granules = R"(
format = 1
title = "Granules that fall"
[apparatus]
shape = "box"
size = ["20 mm", "20 mm", "40 mm"]
[granules]
diameter = "2 mm"
density = "1500 kg/m3"
mass = "2.5 g"
start = "loose"
[time]
duration = "0.4 s"
[output]
interval = "50 ms"
series_interval = "2 ms"
checkpoint_interval = "0.1 s"
)";

//! What comes in goes down a turning disc and out.
constexpr auto fed_granules = R"(
title = "Granules that pass a turning disc"
[apparatus]
shape = "box"
size = ["20 mm", "20 mm", "40 mm"]
open = ["left", "right", "bottom"]
leaving = "discharge"
[[wall]]
name = "disc"
shape = "disc"
centre = ["10 mm", "10 mm", "15 mm"]
diameter = "18 mm"
rotate = { point = ["10 mm", "10 mm", "0 mm"], axis = [0, 0, 1], rate = "600 rpm" }
[granules]
density = "1500 kg/m3"
size = { distribution = "uniform", min = "1 mm", max = "2.5 mm" }
number = 150
[[feed]]
lower = ["5 mm", "2 mm", "30 mm"]
upper = ["15 mm", "18 mm", "38 mm"]
rate = "1.5 g/s"
[time]
duration = "0.2 s"
[output]
interval = "50 ms"
series_interval = "2 ms"
)";

class Continue : public ::testing::Test
{
  protected:
    scene::TemporaryFolder folder;
    std::string const path = folder / "case.toml";

    int run(std::vector<std::string> words, std::string* errors = nullptr)
    {
        words.insert(words.begin(), "run");
        scene::Program program(words, folder / "said");
        int const status = program.wait();
        said = program.said();
        if (errors)
            *errors = program.errors();
        else
            EXPECT_EQ(program.errors().find("granum:"), std::string::npos) << program.errors();
        return status;
    }
    json summary(std::string const& name) { return json::parse(scene::text_of(folder / (name + "/summary.json"))); }

    //! The files that a user reads, but for wall times.
    void expect_same_results(std::string const& one, std::string const& other)
    {
        auto a = summary(one), b = summary(other);
        for (auto* all : {&a, &b}) {
            all->erase("performance");
            (*all)["run"].erase("wall_s");
        }
        EXPECT_EQ(a, b);
        for (auto const* file : {"timeseries.csv", "granules.pvd"})
            EXPECT_EQ(scene::text_of(folder / (one + "/" + file)), scene::text_of(folder / (other + "/" + file)))
                << file;
        std::vector<std::string> names;
        for (auto const& entry : fs::directory_iterator(folder / (one + "/vtk")))
            names.push_back(entry.path().filename().string());
        for (auto const& name : names)
            EXPECT_EQ(scene::text_of(folder / (one + "/vtk/" + name)),
                      scene::text_of(folder / (other + "/vtk/" + name)))
                << name;
    }

    std::string said;
};
}

TEST_F(Continue, killed_at_random_moments_it_loses_nothing)
{
    std::ofstream(path) << fallen_granules;
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "quiet", "--quiet"}), 0);
    int const kills = std::getenv("GRANUM_KILLS") ? std::atoi(std::getenv("GRANUM_KILLS")) : 30;
    base::Random random(3, base::Purpose::test, 0, 0);
    int killed = 0;
    double farthest = 0;
    for (int k = 0; k < kills; ++k) {
        scene::Program program({"run", path, "-n", "1", "-o", folder / "killed", "--quiet"}, folder / "said");
        std::this_thread::sleep_for(std::chrono::milliseconds(20 + static_cast<int>(600 * random.uniform())));
        program.signal(SIGKILL);
        killed += program.wait() == -1;
        // What was reached is never lost by more than an interval: the newest checkpoint only moves on.
        std::string newest;
        if (fs::exists(folder / "killed/checkpoint"))
            for (auto const& entry : fs::directory_iterator(folder / "killed/checkpoint"))
                if (auto const name = entry.path().filename().string();
                    name.size() == 6 && fs::exists(entry.path() / "manifest"))
                    newest = std::max(newest, name);
        if (newest.empty()) continue;
        auto const manifest = scene::text_of(folder / ("killed/checkpoint/" + newest + "/manifest"));
        double const time = std::stod(manifest.substr(manifest.find("\ntime ") + 6));
        EXPECT_GE(time, farthest) << "after kill " << k;
        farthest = std::max(farthest, time);
    }
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "killed", "--quiet"}), 0);
    EXPECT_GT(killed, 0);
    expect_same_results("quiet", "killed");
}

TEST_F(Continue, a_spray_stopped_in_the_middle_ends_as_if_it_had_not_been)
{
    scene::write_lab_case(path, {{"parcels", "1500"}, {"cells", "[8, 8, 32]"}});
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "whole", "--until", "40 ms", "--quiet"}), 0);
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "cut", "--until", "20 ms", "--quiet"}), 0);
    ASSERT_EQ(run({folder / "cut", "-n", "1", "--until", "40 ms", "--quiet"}), 0);
    expect_same_results("whole", "cut");
    auto const one = io::read_events(folder / "whole/events.h5"), other = io::read_events(folder / "cut/events.h5");
    EXPECT_GT(one.rows(), 0u);
    EXPECT_TRUE(one.values == other.values) << "events";
}

TEST_F(Continue, granules_alone_end_the_same_on_other_ranks)
{
    std::ofstream(path) << fallen_granules;
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "one", "--until", "0.1 s", "--quiet"}), 0);
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "other", "--until", "50 ms", "--quiet"}), 0);
    ASSERT_EQ(run({folder / "other", "-n", "2", "--until", "0.1 s", "--quiet"}), 0);
    EXPECT_EQ(summary("one")["state_hash"], summary("other")["state_hash"]);
    EXPECT_EQ(summary("other")["run"]["ranks"], 2);
}

TEST_F(Continue, what_is_still_to_be_fed_and_a_wall_that_turns_go_on_too)
{
    std::ofstream(path) << fed_granules;
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "whole", "--quiet"}), 0);
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "cut", "--until", "0.1 s", "--quiet"}), 0);
    ASSERT_EQ(run({folder / "cut", "-n", "1", "--quiet"}), 0);
    auto const traffic = summary("whole")["traffic"];
    EXPECT_GT(traffic["discharged_parcels"], 5) << "or nothing would be tested";
    EXPECT_GT(traffic["fed_parcels"], 50);
    EXPECT_EQ(summary("whole")["state_hash"], summary("cut")["state_hash"]);
    EXPECT_EQ(traffic, summary("cut")["traffic"]);
    auto const loads = [&](std::string const& name) { return io::read_series(folder / (name + "/walls.csv")); };
    EXPECT_GT(loads("whole").rows(), 50u);
    EXPECT_EQ(loads("whole").find("time")->back(), loads("cut").find("time")->back());
    EXPECT_EQ(loads("whole").find("disc_torque_z")->back(), loads("cut").find("disc_torque_z")->back());
    ASSERT_EQ(run({path, "-n", "2", "-o", folder / "two", "--quiet"}), 0);
    EXPECT_EQ(summary("whole")["state_hash"], summary("two")["state_hash"]) << "on two ranks";
}

TEST_F(Continue, another_case_is_refused_with_what_differs)
{
    std::ofstream(path) << fallen_granules;
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "run", "--until", "10 ms", "--quiet"}), 0);
    std::string text = fallen_granules, errors;
    text.replace(text.find("1500 kg/m3"), 10, "1600 kg/m3");
    std::ofstream(path) << text;
    EXPECT_EQ(run({path, "-n", "1", "-o", folder / "run", "--until", "20 ms"}, &errors), 2);
    EXPECT_NE(errors.find("granules.density was"), std::string::npos) << errors;
    EXPECT_NE(errors.find("--fresh"), std::string::npos) << errors;
    EXPECT_EQ(run({path, "-n", "1", "-o", folder / "run", "--until", "10 ms", "--fresh", "--quiet"}), 0);
    // Duration and output do not touch what has happened.
    text.replace(text.find("0.4 s"), 5, "0.5 s");
    text.replace(text.find("50 ms"), 5, "20 ms");
    std::ofstream(path) << text;
    EXPECT_EQ(run({path, "-n", "1", "-o", folder / "run", "--until", "20 ms", "--quiet"}), 0);
    EXPECT_NEAR(summary("run")["run"]["simulated_s"].get<double>(), 0.02, 1e-12);
}

TEST_F(Continue, a_run_that_is_done_says_so)
{
    std::ofstream(path) << fallen_granules;
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "run", "--until", "10 ms", "--quiet"}), 0);
    auto const before = scene::text_of(folder / "run/summary.json");
    EXPECT_EQ(run({folder / "run", "-n", "1", "--until", "10 ms"}), 0);
    EXPECT_NE(said.find("is done"), std::string::npos) << said;
    EXPECT_EQ(scene::text_of(folder / "run/summary.json"), before);
    std::string errors;
    fs::create_directories(folder / "other");
    std::ofstream(folder / "other/thesis.txt") << "not a run";
    EXPECT_EQ(run({path, "-n", "1", "-o", folder / "other"}, &errors), 2);
    EXPECT_NE(errors.find("holds no run"), std::string::npos) << errors;
}

TEST_F(Continue, a_damaged_checkpoint_is_named_and_the_one_before_is_taken)
{
    std::ofstream(path) << fallen_granules;
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "whole", "--until", "30 ms", "--quiet"}), 0);
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "run", "--until", "10 ms", "--quiet"}), 0);
    ASSERT_EQ(run({folder / "run", "-n", "1", "--until", "20 ms", "--quiet"}), 0);
    fs::resize_file(folder / "run/checkpoint/000001/rank_00000", 1000);
    std::string errors;
    ASSERT_EQ(run({folder / "run", "-n", "1", "--until", "30 ms"}, &errors), 0) << errors;
    EXPECT_NE(errors.find("checkpoint 000001 is passed over"), std::string::npos) << errors;
    EXPECT_NE(errors.find("continues from checkpoint 000000"), std::string::npos) << errors;
    expect_same_results("whole", "run");
}

TEST_F(Continue, sigusr2_writes_a_checkpoint_and_the_run_goes_on)
{
    std::string text = fallen_granules;
    text.replace(text.find("\"0.1 s\""), 7, "\"1 h\"");
    text.replace(text.find("\"0.4 s\""), 7, "\"10 s\"");
    std::ofstream(path) << text;
    scene::Program program({"run", path, "-n", "2", "-o", folder / "run", "--quiet"}, folder / "said");
    ASSERT_TRUE(scene::eventually([&] { return fs::exists(folder / "run/summary.json"); })) << program.errors();
    program.signal(SIGUSR2);
    EXPECT_TRUE(scene::eventually([&] { return fs::exists(folder / "run/checkpoint/000000/manifest"); }));
    EXPECT_EQ(summary("run")["ended"], "running");
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 130);
    EXPECT_TRUE(fs::exists(folder / "run/checkpoint/000001/manifest")) << "one more where it was stopped";
    EXPECT_EQ(summary("run")["ended"], "stopped");
}
