// Hard spheres as a user has them: a gas that cools, granules that fall and rest, stopped and gone on with.
#include "granum/io/csv.hpp"
#include "scene/program.hpp"
#include "scene/run_folder.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace granum;
using json = nlohmann::json;
namespace fs = std::filesystem;

namespace
{
constexpr auto cooling = R"(
gravity = ["0 m/s2", "0 m/s2", "0 m/s2"]
[apparatus]
shape = "box"
size = ["22 mm", "22 mm", "22 mm"]
periodic = ["x", "y", "z"]
[granules]
diameter = "1 mm"
density = "1000 kg/m3"
number = 1000
start = "lattice"
spacing = 2.25
noise = 1
agitation = "0.1 m/s"
[contact]
engine = "hard"
restitution = 0.9
sliding_friction = 0
[time]
duration = "1 s"
[output]
interval = "0.5 s"
series_interval = "20 ms"
)";

constexpr auto falling = R"(
[apparatus]
shape = "box"
size = ["10 mm", "10 mm", "30 mm"]
[granules]
diameter = "2 mm"
density = "1500 kg/m3"
number = 60
agitation = "0.2 m/s"
[contact]
engine = "hard"
restitution = 0.5
[time]
duration = "0.3 s"
[output]
interval = "0.1 s"
series_interval = "5 ms"
)";

class Hard : public ::testing::Test
{
  protected:
    scene::TemporaryFolder folder;
    std::string const path = folder / "case.toml";
    std::string errors;

    int run(std::vector<std::string> words)
    {
        words.insert(words.begin(), "run");
        scene::Program program(words, folder / "said");
        int const status = program.wait();
        errors = program.errors();
        return status;
    }
    json summary(std::string const& name) { return json::parse(scene::text_of(folder / (name + "/summary.json"))); }
};
}

TEST_F(Hard, spheres_in_a_box_cool_as_haff_says)
{
    std::ofstream(path) << cooling;
    ASSERT_EQ(run({path, "-o", folder / "run", "--quiet"}), 0) << errors;
    auto const said = summary("run");
    EXPECT_GT(said["collisions"]["pairs"], 10'000);
    EXPECT_LT(said["packing"]["overlap"]["largest"], 1e-9);
    EXPECT_LT(std::abs(said["mechanics"]["relative_error"].get<double>()), 1e-9);
    // Haff, J. Fluid Mech. 134 (1983) 401, with Enskog's rate of collisions: T = T0 / (1 + t / tau)^2.
    double const d = 1e-3, solids = 1000 * 3.14159265358979 / 6 * d * d * d / std::pow(22e-3, 3), start = 0.01;
    double const contact = (1 - solids / 2) / std::pow(1 - solids, 3);
    double const rate = 4 * 1000 / std::pow(22e-3, 3) * d * d * contact * std::sqrt(3.14159265358979 * start);
    double const tau = 6 / ((1 - 0.9 * 0.9) * rate);
    auto const series = io::read_series(folder / "run/timeseries.csv");
    auto const& energy = *series.find("kinetic_energy");
    auto const& time = *series.find("time");
    for (std::size_t row = 0; row < time.size(); row += 10)
        EXPECT_NEAR(energy[row] / energy[0] * std::pow(1 + time[row] / tau, 2), 1, 0.12) << time[row] << " s";
    EXPECT_EQ(series.find("collisions")->back(), said["collisions"]["pairs"].get<double>());
}

TEST_F(Hard, spheres_that_were_stopped_go_on_with_the_same_bits)
{
    for (auto const* text : {cooling, falling}) {
        std::ofstream(path) << text;
        bool const gas = text == cooling;
        ASSERT_EQ(run({path, "-o", folder / "whole", "--quiet", "--fresh"}), 0) << errors;
        ASSERT_EQ(run({path, "-o", folder / "cut", "--quiet", "--fresh", "--until", gas ? "0.1 s" : "0.05 s"}), 0);
        ASSERT_EQ(run({folder / "cut", "--quiet", "--until", gas ? "0.4 s" : "0.2 s"}), 0) << errors;
        ASSERT_EQ(run({folder / "cut", "--quiet"}), 0) << errors;
        auto one = summary("whole"), other = summary("cut");
        for (auto* all : {&one, &other}) all->erase("performance"), (*all)["run"].erase("wall_s");
        EXPECT_EQ(one, other);
        for (auto const* file : {"timeseries.csv", "walls.csv"})
            EXPECT_EQ(scene::text_of(folder / (std::string("whole/") + file)),
                      scene::text_of(folder / (std::string("cut/") + file)))
                << file;
        EXPECT_EQ(one["collisions"]["time_driven_steps"] > 0, !gas) << "both ways of moving are to be cut through";
    }
    // Granules at rest weigh on the floor and, by friction, on the sides; on the lid there is nothing.
    auto const loads = io::read_series(folder / "whole/walls.csv");
    double const weight = 60 * 1500 * 3.14159265358979 / 6 * 8e-9 * 9.81;
    double mean = 0;
    for (auto const* wall : {"bottom", "left", "right", "front", "back"}) {
        auto const& force = *loads.find(std::string(wall) + "_force_z");
        for (std::size_t row = force.size() - 10; row < force.size(); ++row) mean += 0.1 * force[row];
    }
    EXPECT_NEAR(mean, -weight, 0.02 * weight);
    EXPECT_EQ(loads.find("top_force_z")->back(), 0);
}

TEST_F(Hard, spheres_stop_when_asked_and_say_how_to_go_on)
{
    std::string text = cooling;
    text.replace(text.find("\"1 s\""), 5, "\"1 h\"");
    text.replace(text.find("\"20 ms\""), 7, "\"1 h\"");
    text.replace(text.find("\"0.5 s\""), 7, "\"1 h\"");
    text.replace(text.find("0.9"), 3, "1");
    std::ofstream(path) << text;
    scene::Program program({"run", path, "-o", folder / "run"}, folder / "said");
    ASSERT_TRUE(scene::eventually([&] { return fs::exists(folder / "run/summary.json"); })) << program.errors();
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 130);
    EXPECT_EQ(summary("run")["ended"], "stopped");
    EXPECT_NE(program.said().find("to continue: granum run"), std::string::npos);
}

TEST_F(Hard, spheres_run_on_one_rank_only)
{
    std::ofstream(path) << cooling;
    EXPECT_EQ(run({path, "-o", folder / "run", "-n", "2"}), 2);
    EXPECT_NE(errors.find("case.toml:16: contact.engine = \"hard\" runs on one rank, not on -n 2"), std::string::npos)
        << errors;
}
