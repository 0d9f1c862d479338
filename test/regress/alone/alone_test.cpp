// Granules alone through the program: walls from a mesh, that shake, move and press; files beside the case wherever the
// run goes on; granules that get lost; a disk that is full.
#include "granum/io/csv.hpp"
#include "scene/program.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace granum;
using json = nlohmann::json;
namespace fs = std::filesystem;

namespace
{
//! A shaking floor of two triangles, a plate that comes in from the left, and a lid that presses.
constexpr auto works = R"(
format = 1
title = "Granules that are shaken, pushed and pressed"
[apparatus]
shape = "box"
size = ["16 mm", "16 mm", "40 mm"]
open = ["bottom", "top"]
[[wall]]
name = "floor"
shape = "stl"
file = "parts/floor.stl"
vibrate = { direction = [0, 0, 1], amplitude = "0.1 mm", frequency = "80 Hz" }
[[wall]]
name = "plate"
shape = "plane"
point = ["0 mm", "0 mm", "0 mm"]
normal = [1, 0, 0]
move = { velocity = ["20 mm/s", "0 mm/s", "0 mm/s"] }
[[wall]]
name = "lid"
shape = "disc"
centre = ["8 mm", "8 mm", "21 mm"]
normal = [0, 0, -1]
diameter = "50 mm"
servo = { direction = [0, 0, -1], pressure = "400 Pa", area = "2.56e-4 m2", fastest = "0.2 m/s" }
[granules]
size = { distribution = "table", file = "sizes.csv" }
density = "2500 kg/m3"
number = 300
start = "loose"
region = { lower = ["0 mm", "0 mm", "5 mm"], upper = ["16 mm", "16 mm", "20 mm"] }
[contact]
youngs_modulus = "2 MPa"
sliding_friction = 0.4
[time]
duration = "60 ms"
[output]
interval = "20 ms"
series_interval = "2 ms"
overlap_criterion = "0.5 %"
[[output.box]]
name = "core"
lower = ["4 mm", "4 mm", "5 mm"]
upper = ["12 mm", "12 mm", "9 mm"]
)";

constexpr auto floor_mesh = R"(solid floor
facet normal 0 0 1
outer loop
vertex -1 -1 4
vertex 17 -1 4
vertex 17 17 4
endloop
endfacet
facet normal 0 0 1
outer loop
vertex -1 -1 4
vertex 17 17 4
vertex -1 17 4
endloop
endfacet
endsolid floor
)";

class GranulesAlone : public ::testing::Test
{
  protected:
    scene::TemporaryFolder folder;
    std::string said, errors;

    void write_works(std::string const& place)
    {
        fs::create_directories(place + "/parts");
        std::ofstream(place + "/case.toml") << works;
        std::ofstream(place + "/parts/floor.stl") << floor_mesh;
        std::ofstream(place + "/sizes.csv") << "diameter,cumulative\nm,1\n0.0015,0\n0.002,0.6\n0.0028,1\n";
    }
    int run(std::vector<std::string> words)
    {
        words.insert(words.begin(), "run");
        words.push_back("--quiet");
        scene::Program program(words, folder / "said");
        int const status = program.wait();
        said = program.said(), errors = program.errors();
        return status;
    }
    json summary(std::string const& run) { return json::parse(scene::text_of(run + "/summary.json")); }
};

TEST_F(GranulesAlone, shaken_pushed_and_pressed_end_the_same_in_two_legs_on_other_ranks)
{
    write_works(folder.path());
    auto const path = folder / "case.toml", whole = folder / "whole", cut = folder / "cut";
    ASSERT_EQ(run({path, "-n", "1", "-o", whole}), 0) << errors;
    ASSERT_EQ(run({path, "-n", "2", "-o", cut, "--until", "10 ms"}), 0) << errors;
    ASSERT_EQ(run({cut, "-n", "1", "--until", "50 ms"}), 0) << errors;
    ASSERT_EQ(run({cut, "-n", "2"}), 0) << errors;
    auto const one = summary(whole), other = summary(cut);
    EXPECT_EQ(one["state_hash"], other["state_hash"]);
    for (auto const* part : {"packing", "mechanics"}) EXPECT_EQ(one[part], other[part]) << part;
    for (auto const* file : {"timeseries.csv", "walls.csv", "boxes.csv"}) {
        EXPECT_GT(scene::text_of(whole + "/" + file).size(), 1000u);
        EXPECT_EQ(scene::text_of(whole + "/" + file), scene::text_of(cut + "/" + file)) << file << ", every digit";
    }

    auto const walls = io::read_series(whole + "/walls.csv");
    double const weight = 9.81 * one["granules"]["mass_kg"].get<double>();
    EXPECT_LT(walls.find("floor_force_z")->back(), -weight) << "the floor carries the granules and the lid";
    EXPECT_GT(walls.find("lid_force_z")->back(), 0);
    auto const& box = one["packing"]["boxes"]["core"];
    EXPECT_GT(box["solids_fraction"].get<double>(), 0.4);
    EXPECT_LT(box["solids_fraction"].get<double>(), 0.75);
    EXPECT_EQ(one["packing"]["overlap"]["criterion"], 0.005);
    EXPECT_GT(one["mechanics"]["wall_work_J"].get<double>(), 0);
    EXPECT_LT(std::abs(one["mechanics"]["relative_error"].get<double>()), 1e-3);
}

//! The drum of examples/06-drum with fewer, larger and softer granules, for a third of a turn.
constexpr auto drum = R"(
[apparatus]
shape = "box"
size = ["100 mm", "24 mm", "100 mm"]
periodic = ["y"]
open = ["left", "right", "bottom", "top"]
[[wall]]
name = "drum"
shape = "cylinder"
base = ["50 mm", "-1 mm", "50 mm"]
axis = [0, 1, 0]
length = "26 mm"
diameter = "100 mm"
side = "inside"
rotate = { point = ["50 mm", "0 mm", "50 mm"], axis = [0, 1, 0], rate = "60 rpm" }
[granules]
diameter = "5 mm"
density = "2500 kg/m3"
number = 250
region = { lower = ["18 mm", "0 mm", "18 mm"], upper = ["82 mm", "24 mm", "80 mm"] }
[contact]
youngs_modulus = "2 MPa"
restitution = 0.5
sliding_friction = 0.6
rolling_friction = 0.05
[time]
duration = "0.3 s"
)";

TEST_F(GranulesAlone, in_a_turning_drum_lose_and_store_what_its_wall_gives)
{
    std::ofstream(folder / "case.toml") << drum;
    ASSERT_EQ(run({folder / "case.toml", "-n", "1", "-o", folder / "run"}), 0) << errors;
    auto const energy = summary(folder / "run")["mechanics"];
    double const given = energy["wall_work_J"], lost = energy["dissipated_J"];
    EXPECT_GT(lost, 0.1 * given) << "or nothing would be tested";
    EXPECT_LT(std::abs(energy["residual_J"].get<double>()), 1e-3 * given);
    EXPECT_LT(std::abs(energy["relative_error"].get<double>()), 1e-3);
}

TEST_F(GranulesAlone, go_on_with_the_files_beside_their_case_wherever_both_are)
{
    auto const here = folder / "here", there = folder / "there";
    write_works(here);
    ASSERT_EQ(run({here + "/case.toml", "-n", "1", "-o", here + "/whole", "--until", "30 ms"}), 0) << errors;
    ASSERT_EQ(run({here + "/case.toml", "-n", "1", "-o", here + "/run", "--until", "4 ms"}), 0) << errors;
    std::ofstream(here + "/case.toml", std::ios::app) << "# a thought that came later\n";
    ASSERT_EQ(run({here + "/run", "-n", "1", "--until", "10 ms"}), 0) << "from its copy\n" << errors;
    fs::rename(here, there);
    ASSERT_EQ(run({there + "/run", "-n", "1", "--until", "20 ms"}), 0) << "both moved\n" << errors;
    fs::remove(there + "/case.toml");
    ASSERT_EQ(run({there + "/run", "-n", "1", "--until", "30 ms"}), 2) << "nothing says where the files are";
    fs::rename(there, here);
    ASSERT_EQ(run({here + "/run", "-n", "1", "--until", "30 ms"}), 0) << "without the original\n" << errors;
    EXPECT_EQ(summary(here + "/run")["state_hash"], summary(here + "/whole")["state_hash"]);
}

TEST_F(GranulesAlone, do_not_go_on_with_a_file_that_changed_or_is_gone)
{
    write_works(folder.path());
    auto const path = folder / "case.toml", mesh = folder / "parts/floor.stl", results = folder / "run";
    ASSERT_EQ(run({path, "-n", "1", "-o", results, "--until", "4 ms"}), 0) << errors;
    auto text = std::string(floor_mesh);
    text.replace(text.find("17 17 4"), 7, "17 17 5");
    std::ofstream(mesh) << text;
    EXPECT_EQ(run({results, "-n", "1", "--until", "10 ms"}), 2);
    EXPECT_NE(errors.find("wall[0].file.contents was hash"), std::string::npos) << errors;
    EXPECT_NE(errors.find("--fresh"), std::string::npos) << errors;
    fs::remove(mesh);
    EXPECT_EQ(run({results, "-n", "1", "--until", "10 ms"}), 2);
    EXPECT_NE(errors.find("floor.stl"), std::string::npos) << errors;
    EXPECT_NE(errors.find("case.toml:"), std::string::npos) << "with the line\n" << errors;
    std::ofstream(mesh) << floor_mesh;
    std::ofstream(folder / "sizes.csv") << "diameter,cumulative\nm,1\n0.0015,0\n0.0028,1\n";
    EXPECT_EQ(run({results, "-n", "1", "--until", "10 ms"}), 2);
    EXPECT_NE(errors.find("size.file.contents was hash"), std::string::npos) << errors;
}

TEST_F(GranulesAlone, begin_where_another_run_ended_and_tell_when_it_went_on_since)
{
    write_works(folder.path());
    ASSERT_EQ(run({folder / "case.toml", "-n", "1", "-o", folder / "first", "--until", "5 ms"}), 0) << errors;
    std::string text = works;
    text.replace(text.find("[granules]"), text.find("[contact]") - text.find("[granules]"),
                 "[granules]\nrun = \"first\"\n");
    std::ofstream(folder / "second.toml") << text;
    auto const second = folder / "second";
    ASSERT_EQ(run({folder / "second.toml", "-n", "2", "-o", second, "--until", "5 ms"}), 0) << errors;
    EXPECT_EQ(summary(second)["granules"]["parcels"], 300);
    ASSERT_EQ(run({second, "-n", "1", "--until", "10 ms"}), 0) << errors;
    ASSERT_EQ(run({folder / "first", "-n", "1", "--until", "10 ms"}), 0) << errors;
    EXPECT_EQ(run({second, "-n", "1", "--until", "15 ms"}), 2);
    EXPECT_NE(errors.find("granules given one by one was"), std::string::npos) << errors;
    fs::rename(folder / "first", folder / "elsewhere");
    EXPECT_EQ(run({second, "-n", "1", "--until", "15 ms"}), 2);
    EXPECT_NE(errors.find("first/snapshots.h5"), std::string::npos) << errors;
}

//! Three granules; number 7 flies out to the right after 11 mm at 2 m/s.
constexpr auto lost = R"(
[apparatus]
shape = "box"
size = ["20 mm", "20 mm", "20 mm"]
open = ["right"]
[granules]
file = "granules.csv"
diameter = "2 mm"
density = "2500 kg/m3"
[time]
duration = "20 ms"
[output]
checkpoint_every = "2 ms"
)";
constexpr auto three =
    "id,x,y,z,radius,vx,vy,vz\n3,0.005,0.005,0.001,0.001,0,0,0\n7,0.009,0.01,0.01,0.001,2,0,0\n"
    "5,0.014,0.015,0.001,0.001,0,0,0\n";

TEST_F(GranulesAlone, that_leave_the_domain_are_named_and_can_be_replayed)
{
    std::ofstream(folder / "granules.csv") << three;
    std::ofstream(folder / "case.toml") << lost;
    for (auto const* ranks : {"1", "2"}) {
        auto const results = folder / ("run-" + std::string(ranks));
        for (int replay = 0; replay < 2; ++replay) {
            EXPECT_EQ(run({folder / "case.toml", "-n", ranks, "-o", results}), 70) << errors;
            EXPECT_NE(errors.find("granule 7 left the domain through the open face right at 0.0055"), std::string::npos)
                << errors;
            EXPECT_EQ(errors.find("left the domain", errors.find("left the domain") + 5), std::string::npos)
                << "said once\n"
                << errors;
            EXPECT_NE(errors.find("apparatus.leaving"), std::string::npos) << "and how to allow it\n" << errors;
        }
        EXPECT_EQ(summary(results)["ended"], "failed");
        EXPECT_TRUE(fs::exists(results + "/checkpoint/failed/000000/manifest")) << "the state of that moment";
    }
    std::string text = lost;
    text.replace(text.find("open ="), 6, "leaving = \"discharge\"\nopen =");
    std::ofstream(folder / "case.toml") << text;
    for (auto const* ranks : {"1", "2"}) {
        auto const results = folder / ("counted-" + std::string(ranks));
        EXPECT_EQ(run({folder / "case.toml", "-n", ranks, "-o", results}), 0) << errors;
        EXPECT_EQ(summary(results)["traffic"]["discharged_parcels"], 1);
        EXPECT_LT(std::abs(summary(results)["mechanics"]["relative_error"].get<double>()), 1e-3);
    }
    EXPECT_EQ(summary(folder / "counted-1")["state_hash"], summary(folder / "counted-2")["state_hash"]);
}

TEST_F(GranulesAlone, whose_state_is_not_finite_or_far_out_are_named)
{
    std::string const spun =
        "id,x,y,z,radius,vx,vy,vz,wx,wy,wz\n4,0.009,0.01,0.01,0.001,0,0,0,0,0,1.7e308\n"
        "9,0.01099,0.01,0.01,0.001,0,0,0,0,0,-1.7e308\n";
    struct
    {
        std::string gravity, granules, words;
    } const bad[] = {{"-9.81", spun, "has a state that is not finite"},
                     {"1e12", three, "left the domain through"},
                     {"1e307", three, "left the domain through"}};
    for (auto const& [gravity, granules, words] : bad) {
        std::ofstream(folder / "granules.csv") << granules;
        std::ofstream(folder / "case.toml") << "gravity = [\"" << gravity << " m/s2\", \"0 m/s2\", \"0 m/s2\"]" << lost;
        for (auto const* ranks : {"1", "2"}) {
            fs::remove_all(folder / "run");
            EXPECT_EQ(run({folder / "case.toml", "-n", ranks, "-o", folder / "run"}), 70) << gravity << "\n" << errors;
            EXPECT_NE(errors.find(words), std::string::npos) << errors;
            EXPECT_TRUE(fs::exists(folder / "run/checkpoint/failed")) << gravity;
        }
    }
}

TEST_F(GranulesAlone, on_a_full_disk_stop_with_the_name_of_the_file_and_go_on_when_there_is_room)
{
    write_works(folder.path());
    auto const path = folder / "case.toml";
    ASSERT_EQ(run({path, "-n", "1", "-o", folder / "whole", "--until", "10 ms"}), 0) << errors;
    for (auto const* ranks : {"1", "2"})
        for (auto const* file : {"boxes.csv", "walls.csv"}) {
            auto const results = folder / "run", full = results + "/" + file;
            fs::remove_all(results);
            ASSERT_EQ(run({path, "-n", ranks, "-o", results, "--until", "4 ms"}), 0) << errors;
            fs::remove(full);
            fs::create_symlink("/dev/full", full);
            EXPECT_EQ(run({results, "-n", ranks, "--until", "10 ms"}), 74) << errors;
            EXPECT_NE(errors.find(full), std::string::npos) << "the file is named\n" << errors;
            EXPECT_EQ(scene::processes_with(results), 0) << "nobody waits for the rank that failed";
            fs::remove(full);
            ASSERT_EQ(run({results, "-n", ranks, "--until", "10 ms"}), 0) << errors;
            EXPECT_EQ(summary(results)["state_hash"], summary(folder / "whole")["state_hash"]);
        }
}
}
