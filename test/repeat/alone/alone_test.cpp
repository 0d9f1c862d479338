// Granules alone, as `granum run` steps them: on any number of ranks, with cuts that follow the granules, and after a
// restart on other ranks, the state, the energies and the loads of walls have the same bits.
#include "granum/sim/bed_statistics.hpp"
#include "granum/sim/state_hash.hpp"
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

namespace
{
using namespace granum;

par::Communicator const& all()
{
    static par::Communicator const comm{MPI_COMM_WORLD};
    return comm;
}

//! Granules that a turning drum heaps up on one side.
constexpr auto drum = R"(
[apparatus]
shape = "box"
size = ["60 mm", "14 mm", "60 mm"]
open = ["left", "right", "bottom", "top"]
[[wall]]
name = "drum"
shape = "cylinder"
base = ["30 mm", "-1 mm", "30 mm"]
axis = [0, 1, 0]
length = "16 mm"
diameter = "56 mm"
side = "inside"
rotate = { point = ["30 mm", "0 mm", "30 mm"], axis = [0, 1, 0], rate = "90 rpm" }
[granules]
size = { distribution = "uniform", min = "2 mm", max = "4 mm" }
density = "2500 kg/m3"
number = 150
region = { lower = ["15 mm", "0 mm", "8 mm"], upper = ["45 mm", "14 mm", "52 mm"] }
[contact]
youngs_modulus = "2 MPa"
restitution = 0.5
sliding_friction = 0.6
rolling_friction = 0.05
[time]
duration = "1 s"
)";

//! What comes in goes down a turning disc and out.
constexpr auto disc = R"(
[apparatus]
shape = "box"
size = ["20 mm", "20 mm", "40 mm"]
open = ["left", "right", "bottom"]
leaving = "discharge"
[[wall]]
name = "disc"
shape = "disc"
centre = ["10 mm", "10 mm", "4 mm"]
diameter = "16 mm"
rotate = { point = ["10 mm", "10 mm", "0 mm"], axis = [0, 0, 1], rate = "600 rpm" }
[granules]
density = "1500 kg/m3"
size = { distribution = "uniform", min = "1 mm", max = "2.5 mm" }
number = 150
[[feed]]
lower = ["2 mm", "2 mm", "6 mm"]
upper = ["18 mm", "18 mm", "12 mm"]
rate = "10 g/s"
velocity = ["0 m/s", "0 m/s", "-0.5 m/s"]
[contact]
youngs_modulus = "2 MPa"
[time]
duration = "1 s"
)";

//! A floor that shakes and a lid that is pressed on what lies on it.
constexpr auto press = R"(
[apparatus]
shape = "box"
size = ["16 mm", "16 mm", "40 mm"]
open = ["bottom", "top"]
[[wall]]
name = "floor"
shape = "plane"
point = ["0 mm", "0 mm", "4 mm"]
normal = [0, 0, 1]
vibrate = { direction = [0, 0, 1], amplitude = "0.1 mm", frequency = "80 Hz" }
[[wall]]
name = "lid"
shape = "disc"
centre = ["8 mm", "8 mm", "30 mm"]
normal = [0, 0, -1]
diameter = "40 mm"
servo = { direction = [0, 0, -1], pressure = "400 Pa", area = "2.56e-4 m2", fastest = "0.2 m/s" }
[granules]
diameter = "2 mm"
density = "2500 kg/m3"
number = 200
start = "loose"
region = { lower = ["0 mm", "0 mm", "5 mm"], upper = ["16 mm", "16 mm", "28 mm"] }
[contact]
youngs_modulus = "2 MPa"
sliding_friction = 0.4
[time]
duration = "1 s"
)";

//! What a run shows of its state, bit by bit.
struct Shown
{
    std::string hash;
    sim::BedStatistics bed;
    sim::Traffic traffic;
    double kinetic = 0, height = 0;
    std::vector<dem::WallLoad> loads;
};

Shown shown(sim::Simulation& simulation)
{
    auto const readings = simulation.readings();
    return {sim::state_hash(simulation.granules(), simulation.comm()),
            sim::bed_statistics(simulation.granules(), simulation.mover(), simulation.comm(), 0.003),
            simulation.traffic(),
            readings.kinetic_energy,
            readings.height,
            simulation.engine().wall_loads()};
}

void expect_same(Shown const& one, Shown const& other, std::string const& which)
{
    EXPECT_EQ(one.hash, other.hash) << which;
    EXPECT_EQ(std::memcmp(&one.bed, &other.bed, sizeof one.bed), 0)
        << which << ": energies " << one.bed.elastic - other.bed.elastic << ", "
        << one.bed.dissipated - other.bed.dissipated << ", " << one.bed.wall_work - other.bed.wall_work << " J";
    EXPECT_EQ(std::memcmp(&one.traffic, &other.traffic, sizeof one.traffic), 0) << which;
    EXPECT_EQ(one.kinetic, other.kinetic) << which;
    EXPECT_EQ(one.height, other.height) << which;
    EXPECT_EQ(one.loads, other.loads) << which;
}

void step_to(sim::Simulation& simulation, double time)
{
    while (simulation.time() < time * (1 - 1e-12)) simulation.step(time - simulation.time());
}

class Alone : public ::testing::TestWithParam<char const*>
{
};

TEST_P(Alone, has_the_same_bits_on_any_number_of_ranks_and_after_a_restart_that_follows_a_new_cut)
{
    par::Communicator const self(MPI_COMM_SELF);
    constexpr double middle = 0.03, end = 0.05;
    auto const data = scene::case_of(GetParam());
    sim::Simulation one(data, self), many(data, all());  // each rank runs the first for itself
    expect_same(shown(one), shown(many), "at the start");

    std::unique_ptr<scene::TemporaryFolder> const folder =
        all().root() ? std::make_unique<scene::TemporaryFolder>() : nullptr;
    std::string path = folder ? *folder / "checkpoint" : "";
    std::vector<std::byte> letters(path.size());
    std::memcpy(letters.data(), path.data(), path.size());
    all().broadcast(letters);
    path.assign(reinterpret_cast<char const*>(letters.data()), letters.size());

    step_to(one, middle);
    step_to(many, middle);
    expect_same(shown(one), shown(many), "in the middle");
    many.engine().rebalance(many.granules());
    if (all().root()) std::filesystem::create_directories(path);
    all().barrier();
    io::CheckpointFolder const checkpoints(path, all());
    checkpoints.write({"test", 0, many.time(), many.steps(), 0}, many.save());
    all().barrier();
    std::vector<std::string> passed_over;
    auto const found = checkpoints.newest(passed_over);
    ASSERT_TRUE(found);
    sim::Simulation again(data, all(), &*found), alone(data, self, &*found);
    all().barrier();

    for (auto* simulation : {&one, &many, &again, &alone}) step_to(*simulation, end);
    auto const expected = shown(one);
    expect_same(expected, shown(many), "on several ranks");
    expect_same(expected, shown(again), "on as many after a restart");
    expect_same(expected, shown(alone), "on one after the restart");
    EXPECT_GT(expected.bed.contacts, 0);
    EXPECT_GT(expected.bed.wall_work, 0) << "a wall at rest tests less";
    if (!data.feeds.empty()) {
        EXPECT_GT(expected.traffic.left, 0) << "something must come and go";
    }
    if (all().size() > 1) {
        EXPECT_GT(many.engine().watch().rebalances, 1) << "no cut was moved by counted work";
        long const owned = static_cast<long>(many.granules().owned);
        EXPECT_LT(all().max(owned), 2 * all().sum(owned) / all().size() + 10) << "the work is not shared out";
    }
}

std::string name_of(::testing::TestParamInfo<char const*> const& info)
{
    constexpr char const* names[]{"drum", "disc", "press"};
    return names[info.index];
}

INSTANTIATE_TEST_SUITE_P(Ranks, Alone, ::testing::Values(drum, disc, press), name_of);
}
