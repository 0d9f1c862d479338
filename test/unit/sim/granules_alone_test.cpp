// Granules alone, as a case states them: batches, materials, sizes, starts, feeds, faces that let granules out.
#include "granum/base/error.hpp"
#include "granum/io/snapshot_file.hpp"
#include "granum/sim/bed_statistics.hpp"
#include "granum/sim/box_output.hpp"
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace
{
using namespace granum;
using namespace granum::sim;

std::string const box = R"(
[apparatus]
shape = "box"
size = ["30 mm", "30 mm", "60 mm"]
[time]
duration = "1 s"
[contact]
youngs_modulus = "5 MPa"
restitution = 0.5
)";

std::string mistakes_of(std::string const& text, std::string const& granules = "")
{
    try {
        scene::case_of(text, granules);
    } catch (base::CaseError const& error) {
        return error.what();
    }
    return "";
}

TEST(GranulesAlone, carry_no_columns_of_gas_and_process)
{
    auto const simulation = scene::simulation_of(
        box + "[granules]\nstart = \"loose\"\ndiameter = \"2 mm\"\ndensity = \"2500 kg/m3\"\nnumber = 50\n");
    auto const& groups = simulation->granules().groups;
    EXPECT_FALSE(groups.gas || groups.process || groups.parcel);
    EXPECT_EQ(simulation->granules().owned, 50u);
}

TEST(GranulesAlone, in_a_box_have_the_mean_velocity_of_what_is_inside)
{
    // One whole and, its centre on a face of the box, half of another.
    auto const simulation = scene::simulation_of(
        box + "[granules]\nstart = \"given\"\ndiameter = \"2 mm\"\ndensity = \"2500 kg/m3\"\n" +
        "[[output.box]]\nlower = [\"10 mm\", \"10 mm\", \"10 mm\"]\nupper = [\"20 mm\", \"20 mm\", \"20 mm\"]\n" +
        scene::granule_text({.position = {0.015, 0.015, 0.015}, .velocity = {0.5, 0, 1}}) +
        scene::granule_text({.position = {0.015, 0.015, 0.020}, .velocity = {0.5, 0.3, -1}}));
    auto const inside = box_contents(*simulation).at(0);
    EXPECT_NEAR(inside.velocity.x, 0.5, 1e-12);
    EXPECT_NEAR(inside.velocity.y, 0.1, 1e-12);
    EXPECT_NEAR(inside.velocity.z, 1.0 / 3, 1e-12);
    EXPECT_NEAR(inside.solids_fraction, 1.5 * 4.18879e-9 / 1e-6, 1e-7);
}

TEST(GranulesAlone, of_two_batches_have_their_masses_sizes_and_materials)
{
    auto const text = box + R"(
[material.glass]
density = "2500 kg/m3"
[material.plastic]
density = "1000 kg/m3"
youngs_modulus = "2 MPa"
[[contact.pair]]
between = ["glass", "plastic"]
restitution = 0.3
[granules]
start = "loose"
[[granules.batch]]
name = "glass"
material = "glass"
size = { distribution = "uniform", by = "mass", min = "1 mm", max = "2 mm" }
mass = "6 g"
[[granules.batch]]
material = "plastic"
diameter = "1.6 mm"
number = 200
)";
    auto const data = scene::case_of(text);
    EXPECT_EQ(data.contact.materials[2].name, "glass");
    EXPECT_EQ(data.contact.pairs[3][2].restitution, 0.3);
    EXPECT_EQ(data.contact.pairs[2][2].restitution, 0.5) << "what no pair states is that of [contact]";
    EXPECT_EQ(data.contact.materials[3].youngs_modulus, 2e6);
    auto const simulation = scene::simulation_of(text);
    auto const& granules = simulation->granules();
    std::map<std::uint32_t, double> mass;
    double finer = 0;
    for (std::size_t row = 0; row < granules.owned; ++row) {
        auto const material = granules.material[row];
        mass[material] += granules.mass[row];
        if (material == 3) {
            EXPECT_NEAR(granules.radius[row], 0.8e-3, 1e-15);
            continue;
        }
        EXPECT_GE(granules.radius[row], 0.5e-3);
        EXPECT_LE(granules.radius[row], 1e-3);
        if (granules.radius[row] < 0.75e-3) finer += granules.mass[row];
    }
    EXPECT_NEAR(mass[2], 6e-3, 0.01 * 6e-3);
    EXPECT_NEAR(finer, 0.5 * mass[2], 0.01 * mass[2]);
    EXPECT_NEAR(mass[3], 200 * 1000 * math::pi / 6 * std::pow(1.6e-3, 3), 1e-9);
}

TEST(GranulesAlone, from_a_file_keep_identity_place_motion_and_material)
{
    auto const text = box +
                      "[material.steel]\ndensity = \"7800 kg/m3\"\n[granules]\nfile = \"granules.csv\"\n"
                      "diameter = \"2 mm\"\ndensity = \"2500 kg/m3\"\n";
    auto const rows =
        "material,x,y,z,radius,id,wz,vx,vy,vz,wx,wy\n"
        "steel,0.01,0.011,0.012,0.002,7,3,0.1,0.2,0.3,1,2\n# a remark\n,0.02,0.02,0.02,0.001,3,0,0,0,0,0,0\n";
    auto const data = scene::case_of(text, rows);
    ASSERT_EQ(data.granules.given.size(), 2u);
    auto const& first = data.granules.given[0];
    EXPECT_EQ(first.id, 7u);
    EXPECT_EQ(first.position, (Vec3{0.01, 0.011, 0.012}));
    EXPECT_EQ(first.velocity, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(first.spin, (Vec3{1, 2, 3}));
    EXPECT_EQ(first.material, 2u);
    auto const simulation = scene::simulation_of(text, rows);
    auto const& granules = simulation->granules();
    for (std::size_t row = 0; row < 2; ++row)
        EXPECT_NEAR(granules.mass[row], (granules.id[row] == 7 ? 7800 * 8 : 2500) * 4.0 / 3 * math::pi * 1e-9, 1e-12);
}

TEST(GranulesAlone, from_a_wrong_file_are_refused_with_its_line)
{
    auto const text = box + "[granules]\nfile = \"granules.csv\"\ndiameter = \"2 mm\"\ndensity = \"2500 kg/m3\"\n";
    auto const refused = [&](std::string const& rows, std::string const& word) {
        auto const said = mistakes_of(text, rows);
        EXPECT_NE(said.find(word), std::string::npos) << rows << "\ngave " << said;
    };
    refused("1,0.01,0.01,0.01\n", "granules.csv:1: 4 fields are not a granule");
    refused("1,0.01,0.01,0.01,0.001\n2,0.01,nan,0.01,0.001\n", "granules.csv:2: y = nan is not a finite number");
    refused("1,0.01,0.01,0.01,-1\n", "granules.csv:1: radius = -1 is not above 0");
    refused("1.5,0.01,0.01,0.01,0.001\n", "granules.csv:1: id = 1.5 is not an identity");
    refused("id,x,y,z,raduis\n", "did you mean \"radius\"?");
    refused("1,0.01,0.01,0.01,0.001\n2,0.01,0.01,0.0105,0.001\n", "overlap, the deepest by 150 % of a radius: ");
    refused("1,0.01,0.01,0.09,0.001\n", "puts granule 1 outside the chamber");
    refused("# nothing\n", "holds no granules");
}

TEST(GranulesAlone, poured_lie_still_on_the_floor_and_push_with_their_weight)
{
    auto const simulation = scene::simulation_of(
        box +
        "[granules]\nstart = \"poured\"\ndensity = \"2500 kg/m3\"\nnumber = 500\n"
        "size = { distribution = \"list\", by = \"number\", diameters = [\"2 mm\", \"4 mm\"], shares = [3, 1] }\n");
    EXPECT_EQ(simulation->granules().owned, 500u);
    for (int k = 0; k < 20; ++k) simulation->step(1e-3);
    auto const bed = bed_statistics(simulation->granules(), simulation->mover(), simulation->comm(), 0.003);
    double weight = 0;
    auto const& granules = simulation->granules();
    for (std::size_t row = 0; row < granules.owned; ++row) weight += granules.mass[row] * math::standard_gravity;
    EXPECT_NEAR(bed.wall_force.z, -weight, 0.1 * weight);
    EXPECT_GT(bed.coordination, 2);
    EXPECT_LT(bed.coordination, 6);
    double shares = 0;
    for (double const share : bed.neighbours) shares += share;
    EXPECT_NEAR(shares, 1, 1e-12);
    EXPECT_LE(bed.overlap_mean, bed.overlap_p99);
    EXPECT_LE(bed.overlap_p99, bed.overlap_largest);
    EXPECT_GT(bed.overlap_mean, 0);
}

TEST(GranulesAlone, of_a_feed_come_in_at_its_rate_and_leave_through_an_open_face)
{
    auto const simulation = scene::simulation_of(R"(
[apparatus]
shape = "box"
size = ["30 mm", "30 mm", "60 mm"]
open = ["bottom"]
leaving = "discharge"
[time]
duration = "1 s"
[contact]
youngs_modulus = "5 MPa"
[granules]
diameter = "2 mm"
density = "2500 kg/m3"
number = 400
[[feed]]
lower = ["2 mm", "2 mm", "40 mm"]
upper = ["28 mm", "28 mm", "59 mm"]
rate = "10 g/s"
velocity = ["0 m/s", "0 m/s", "-0.5 m/s"]
)");
    EXPECT_EQ(simulation->granules().owned, 0u);
    while (simulation->time() < 0.2 - 1e-9) simulation->step(0.2 - simulation->time());
    auto const& traffic = simulation->traffic();
    double const one = 2500 * math::pi / 6 * 8e-9;
    EXPECT_NEAR(traffic.fed_mass, 10e-3 * 0.2, 10e-3 * 0.011 + one);
    EXPECT_GT(traffic.left, 50);
    EXPECT_EQ(traffic.fed - traffic.left, static_cast<long>(simulation->granules().owned));
    EXPECT_NEAR(traffic.fed_mass - traffic.left_mass, one * static_cast<double>(simulation->granules().owned), 1e-12);
}

TEST(GranulesAlone, that_leave_where_they_must_not_are_named)
{
    auto const simulation = scene::simulation_of(R"(
[apparatus]
shape = "box"
size = ["30 mm", "30 mm", "30 mm"]
open = ["top"]
[time]
duration = "1 s"
[granules]
diameter = "2 mm"
density = "2500 kg/m3"
[[granule]]
position = ["15 mm", "15 mm", "28 mm"]
velocity = ["0 m/s", "0 m/s", "5 m/s"]
)");
    try {
        while (simulation->time() < 0.01) simulation->step(1e-3);
        FAIL() << "nobody noticed";
    } catch (base::NumericsError const& error) {
        EXPECT_NE(std::string(error.what()).find("granule 0 left the domain through the open face top"),
                  std::string::npos)
            << error.what();
    }
}

TEST(GranulesAlone, from_another_run_go_on_where_its_last_picture_has_them)
{
    scene::TemporaryFolder const folder;
    std::filesystem::create_directories(folder / "before");
    io::Snapshot last;
    last.granules = {.position = {{0.01, 0.01, 0.01}, {0.02, 0.01, 0.01}},
                     .velocity = {{0, 0, 1}, {0, 0, 0}},
                     .spin = {{0, 0, 0}, {1, 2, 3}},
                     .id = {5, 2},
                     .material = {0, 0},
                     .mass = {8e-6, 1e-6},
                     .radius = {1e-3, 0.5e-3},
                     .diameter = {2e-3, 1e-3},
                     .count = {1, 1}};
    io::write_snapshot(folder / "before/snapshots.h5", last);
    auto const path = folder / "case.toml";
    std::ofstream(path) << box << "[granules]\nrun = \"before\"\n";
    static par::Communicator const alone{MPI_COMM_SELF};
    Simulation simulation(read_case(path).data, alone);
    auto const& granules = simulation.granules();
    ASSERT_EQ(granules.owned, 2u);
    for (std::size_t row = 0; row < 2; ++row) {
        std::size_t const from = granules.id[row] == 5 ? 0 : 1;
        EXPECT_EQ(granules.position[row], last.granules.position[from]);
        EXPECT_EQ(granules.velocity[row], last.granules.velocity[from]);
        EXPECT_EQ(granules.spin[row], last.granules.spin[from]);
        EXPECT_NEAR(granules.mass[row], last.granules.mass[from], 1e-20);
        EXPECT_NEAR(granules.radius[row], last.granules.radius[from], 1e-18);
    }
    std::ofstream(path) << box << "[granules]\nrun = \"nowhere\"\n";
    EXPECT_THROW(read_case(path), base::CaseError);
}
}
