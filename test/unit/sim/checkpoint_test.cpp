// A run in two legs ends with the same bits as in one: every number of the state, for granules alone and for a spray
// that is cut while droplets fly, deposits dry and granules touch.
#include "granum/sim/output.hpp"
#include "granum/sim/state_hash.hpp"
#include "scene/case_text.hpp"
#include "scene/lab.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <map>

using namespace granum;

namespace
{
par::Communicator const& alone()
{
    static par::Communicator const comm{MPI_COMM_SELF};
    return comm;
}

//! What sections hold, by name, but for those in the order of memory: granules are compared by their hash, deposits
//! below, contacts by the steps that follow from them.
std::map<std::string, std::vector<std::byte>> contents(io::Sections const& sections)
{
    std::map<std::string, std::vector<std::byte>> out;
    for (auto const& section : sections) {
        auto const& name = section.name;
        bool const in_order_of_memory =
            name.starts_with("granules.") || name == "contacts" || name.starts_with("deposits");
        if (!in_order_of_memory) out[name] = section.bytes;
    }
    return out;
}

void expect_same(sim::Simulation& one, sim::Simulation& other)
{
    EXPECT_EQ(one.time(), other.time());
    EXPECT_EQ(sim::state_hash(one.granules(), alone()), sim::state_hash(other.granules(), alone()));
    auto a = contents(one.save()), b = contents(other.save());
    // How often lists were made is the only number that may differ: going on makes one more.
    for (auto* all : {&a, &b}) std::memset((*all)["common"].data() + (*all)["common"].size() - 8, 0, 8);
    ASSERT_EQ(a.size(), b.size());
    for (auto const& [name, bytes] : a) EXPECT_TRUE(bytes == b[name]) << "section " << name << " differs";
    if (!one.data().spray.present) return;
    for (std::size_t row = 0; row < one.granules().owned; ++row) {
        auto const id = one.granules().id[row];
        auto const &mine = one.deposits().on(id), &theirs = other.deposits().on(id);
        ASSERT_EQ(mine.size(), theirs.size());
        if (mine.empty()) continue;
        EXPECT_EQ(std::memcmp(mine.data(), theirs.data(), mine.size() * sizeof mine[0]), 0) << id;
    }
}

//! Steps to `first`, saves, steps on to `last`; what was saved does the same; both must agree.
void cut(sim::Case const& data, double first, double last)
{
    scene::TemporaryFolder const folder;
    sim::Simulation whole(data, alone());
    while (whole.time() < first) whole.step(1e9);
    io::CheckpointFolder const checkpoints(folder / "checkpoint", alone());
    checkpoints.write({"test", 0, whole.time(), whole.steps(), 0}, whole.save());
    std::vector<std::string> passed_over;
    auto const found = checkpoints.newest(passed_over);
    ASSERT_TRUE(found);
    sim::Simulation again(data, alone(), &*found);
    expect_same(whole, again);
    ASSERT_FALSE(whole.engine().save_contacts().empty()) << "the cut is to be in the middle of contacts";
    for (auto* simulation : {&whole, &again})
        while (simulation->time() < last) simulation->step(1e9);
    EXPECT_GT(whole.time(), first);
    expect_same(whole, again);
}
}

TEST(Continued, granules_alone_end_with_the_same_bits)
{
    std::string text = R"(
format = 1
[apparatus]
shape = "box"
size = ["20 mm", "20 mm", "40 mm"]
[granules]
diameter = "2 mm"
density = "1500 kg/m3"
mass = "2 g"
start = "loose"
[time]
duration = "1 s"
)";
    auto const data = scene::case_of(text);
    for (double const first : {0.02, 0.05}) cut(data, first, first + 0.03);
}

TEST(Continued, granules_that_carry_gas_along_and_remember_it_end_with_the_same_bits)
{
    auto const data = scene::case_of(R"(
[apparatus]
shape = "box"
size = ["24 mm", "24 mm", "48 mm"]
[gas]
density = "1.2 kg/m3"
viscosity = "1.8e-5 Pa s"
velocity = "0.6 m/s"
cells = [4, 4, 8]
virtual_mass = "zuber"
history = 12
shear_lift = "saffman-mei"
spin_lift = "rubinow-keller"
torque = "dennis"
[granules]
diameter = "2 mm"
density = "300 kg/m3"
mass = "1 g"
start = "loose"
[time]
duration = "1 s"
)");
    for (double const first : {0.02, 0.05}) cut(data, first, first + 0.03);
}

TEST(Continued, granules_and_gas_around_bodies_end_with_the_same_bits)
{
    auto const data = scene::case_of(R"(
[apparatus]
shape = "solids"
[[apparatus.solid]]
shape = "cone"
base = ["0 mm", "0 mm", "0 mm"]
length = "60 mm"
base_diameter = "30 mm"
top_diameter = "50 mm"
[[apparatus.solid]]
shape = "cylinder"
base = ["0 mm", "0 mm", "60 mm"]
length = "40 mm"
diameter = "50 mm"
[[internal]]
shape = "tube"
base = ["0 mm", "0 mm", "8 mm"]
length = "40 mm"
inner_diameter = "16 mm"
outer_diameter = "18 mm"
[gas]
density = "1.2 kg/m3"
viscosity = "1.8e-5 Pa s"
velocity = "1 m/s"
cells = [8, 8, 16]
[granules]
diameter = "2 mm"
density = "600 kg/m3"
mass = "3 g"
start = "loose"
[time]
duration = "1 s"
)");
    cut(data, 0.01, 0.02);
}

TEST(Continued, a_spray_ends_with_the_same_bits)
{
    scene::TemporaryFolder const folder;
    scene::write_lab_case(folder / "case.toml", {{"parcels", "1200"}, {"cells", "[8, 8, 32]"}});
    cut(sim::read_case(folder / "case.toml").data, 0.01, 0.02);
}

TEST(Continued, a_spray_on_granules_that_pass_heat_ends_with_the_same_bits)
{
    scene::TemporaryFolder const folder;
    scene::write_lab_case(folder / "case.toml",
                          {{"parcels", "1200"},
                           {"cells", "[8, 8, 32]"},
                           {"youngs_modulus", "\"10 MPa\"\nconduction = \"hertz\"\nheat_conductivity = \"50 W/m/K\""}});
    cut(sim::read_case(folder / "case.toml").data, 0.01, 0.02);
}

TEST(Continued, droplets_and_granules_that_see_turbulence_end_with_the_same_bits)
{
    for (auto const* model : {"k-epsilon", "k-omega-sst"}) {
        scene::TemporaryFolder const folder;
        scene::write_lab_case(folder / "case.toml",
                              {{"parcels", "1200"},
                               {"cells", fmt::format("[8, 8, 32]\nturbulence = \"{}\"\ngranule_turbulence = "
                                                     "true\ngranule_wake = 0.1\ndispersion = \"langevin\"",
                                                     model)},
                               {"droplet_median", "\"40 um\"\ndispersion = \"discrete-walk\""}});
        cut(sim::read_case(folder / "case.toml").data, 0.01, 0.02);
    }
}

// From now on new state enters the checkpoint. Whoever meets a failure here added a member: save it in
// sim/checkpoint.cpp or output_state.cpp, or say there why the next step does not depend on it; then put the new size.
TEST(Continued, no_member_was_added_to_the_state_without_a_thought)
{
    std::size_t columns = 0;
    particle::Store const store;
    particle::for_every_column(store, [&](auto const&) { ++columns; });
    EXPECT_EQ(columns, 36u) << "columns are saved by themselves; their number is here for the memory per granule";
    EXPECT_EQ(sizeof(drying::Deposit), 576u);
    EXPECT_EQ(sizeof(spray::Droplet), 168u);
    EXPECT_EQ(sizeof(gas::State), 21 * sizeof(grid::Field) + 9 * sizeof(double));
    EXPECT_EQ(sizeof(sim::SprayTotals), 96u);
    EXPECT_EQ(sizeof(gas::Balance), 96u) << "the sweeps of a step are its cost, not its state";
    EXPECT_EQ(sizeof(sim::HeatTotals), 56u);
    EXPECT_EQ(sizeof(sim::Sample),
              8 + sizeof(sim::Readings) + sizeof(sim::SprayTotals) + sizeof(sim::BedStatistics) + sizeof(sim::Traffic));
    EXPECT_EQ(sizeof(sim::Traffic), 48u);
    EXPECT_EQ(sizeof(sim::Feed), sizeof(sim::FeedCase) + sizeof(std::vector<sim::GranuleCase>) + 16);
    EXPECT_EQ(sizeof(sim::Readings), 104u);
}
