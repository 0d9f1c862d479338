// A fluidised bed on several ranks, whose cuts move while it runs, against the same bed on one rank.
#include "scene/case_text.hpp"

#include "granum/grid/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace
{
using namespace granum;

//! Granules on a lattice that is a little out of order, at the bottom of a box with hot gas from below; the gas comes
//! faster than they fall, at one side more of them lie.
std::string bed(int steps_between_shares, std::string const& more)
{
    std::string text = fmt::format(R"(
[apparatus]
shape = "box"
size = ["24 mm", "16 mm", "60 mm"]
[gas]
cells = [6, 4, 15]
temperature = "60 degC"
humidity = "8 g/kg"
velocity = "1.2 m/s"
tolerance = 1e-12
rebalance_every = {}
{}[granules]
diameter = "2 mm"
density = "1500 kg/m3"
[contact]
youngs_modulus = "1 MPa"
restitution = 0.9
[start]
quasi_steady = false
bed_temperature = "20 degC"
[time]
duration = "1 s"
)",
                                   steps_between_shares, more);
    for (int k = 0; k < 12; ++k)
        for (int j = 0; j < 7; ++j)
            for (int i = 0; i < (k < 6 ? 11 : 5); ++i) {
                int const number = i + 11 * (j + 7 * k);
                text += scene::granule_text({.position = {0.0012 + 0.00212 * i + 2e-5 * std::sin(number),
                                                          0.0012 + 0.00212 * j + 2e-5 * std::cos(2 * number),
                                                          0.0012 + 0.00212 * k + 2e-5 * std::sin(5 * number)}});
            }
    return text;
}

struct Granule
{
    particle::Id id;
    math::Vec3 position, velocity, spin;
    double temperature;
};

//! All granules in the order of their identities, on every rank.
std::vector<Granule> all_granules(sim::Simulation& simulation, par::Communicator const& comm)
{
    auto const& granules = simulation.granules();
    std::vector<std::byte> mine;
    for (std::size_t row = 0; row < granules.owned; ++row) {
        Granule const one{granules.id[row], granules.position[row], granules.velocity[row], granules.spin[row],
                          granules.temperature[row]};
        auto const* bytes = reinterpret_cast<std::byte const*>(&one);
        mine.insert(mine.end(), bytes, bytes + sizeof(Granule));
    }
    auto bytes = comm.gather(mine);
    comm.broadcast(bytes);
    std::vector<Granule> all(bytes.size() / sizeof(Granule));
    std::memcpy(all.data(), bytes.data(), bytes.size());
    std::sort(all.begin(), all.end(), [](auto const& a, auto const& b) { return a.id < b.id; });
    return all;
}

//! A hundred steps on one rank and on several; `more` are lines of [gas].
void compare(std::string const& more)
{
    par::Communicator const alone(MPI_COMM_SELF), world;
    sim::Simulation one(scene::case_of(bed(0, more)), alone), several(scene::case_of(bed(20, more)), world);
    double const dt = 2e-4;
    std::vector<long> cells{static_cast<long>(several.gas().mass.size())};
    bool moved = false;
    for (int step = 0; step < 100; ++step) {
        one.step(dt);
        several.step(dt);
        moved = moved || static_cast<long>(several.gas().mass.size()) != cells.front();
    }
    EXPECT_EQ(one.time(), several.time());
    std::vector<double> any{moved ? 1.0 : 0.0};
    world.max(any);
    if (world.size() > 2) {
        EXPECT_EQ(any[0], 1) << "no cell has changed its rank: this shows nothing of moving them";
    }

    auto const mine = all_granules(one, alone), theirs = all_granules(several, world);
    ASSERT_EQ(mine.size(), theirs.size());
    double position = 0, velocity = 0, spin = 0, temperature = 0, fastest = 0, spins = 0, rise = 0;
    for (std::size_t k = 0; k < mine.size(); ++k) {
        ASSERT_EQ(mine[k].id, theirs[k].id);
        position = std::max(position, norm(mine[k].position - theirs[k].position));
        velocity = std::max(velocity, norm(mine[k].velocity - theirs[k].velocity));
        spin = std::max(spin, norm(mine[k].spin - theirs[k].spin));
        temperature = std::max(temperature, std::abs(mine[k].temperature - theirs[k].temperature));
        fastest = std::max(fastest, norm(mine[k].velocity));
        spins = std::max(spins, norm(mine[k].spin));
        rise = std::max(rise, mine[k].temperature - 293.15);
    }
    EXPECT_GT(fastest, 0.05);
    EXPECT_GT(rise, 0.05);
    EXPECT_LT(position, 1e-10 * 0.06);
    EXPECT_LT(velocity, 1e-10 * fastest);
    EXPECT_LT(spin, 1e-10 * spins);
    EXPECT_LT(temperature, 1e-10 * 293.15);

    auto gas_of_one = one.gas(), gas_of_several = several.gas();
    auto const before = gas_of_one.fields(), after = gas_of_several.fields();
    auto const &grid = one.grid(), &shared = several.grid();
    for (std::size_t f = 0; f < before.size(); ++f) {
        std::array<double, 2> off{};
        grid::for_each_cell(shared, [&](int i, int j, int k, grid::Index c) {
            auto const there = grid.at(i + shared.shift[0], j + shared.shift[1], k + shared.shift[2]);
            off[0] = std::max(off[0], std::abs((*before[f].second)[there] - (*after[f].second)[c]));
        });
        grid::for_each_cell(
            grid, [&](int, int, int, grid::Index c) { off[1] = std::max(off[1], std::abs((*before[f].second)[c])); });
        world.max(off);
        EXPECT_LE(off[0], 1e-10 * off[1]) << before[f].first;
    }
    for (auto const* ledger : {&several.ledgers().solids, &several.ledgers().water, &several.ledgers().energy})
        EXPECT_LT(ledger->relative_error(), ledger->bar) << ledger->name;
    EXPECT_LT(several.ledgers().momentum, several.ledgers().momentum_bar);
}

TEST(BedOnRanks, agrees_with_one_rank_after_a_hundred_steps)
{
    compare("");
}

TEST(BedOnRanks, agrees_with_one_rank_where_granules_see_turbulence_and_damp_it)
{
    compare("turbulence = \"k-epsilon\"\ngranule_turbulence = true\ngranule_wake = 0.1\ndispersion = \"langevin\"\n");
}
}
