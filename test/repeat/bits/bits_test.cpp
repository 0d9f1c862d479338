// A granules-only run has the same bits on any number of ranks: a rotating drum whose cuts are moved again and again,
// against the same run on one rank, by a hash of the state of every granule.
#include "scene/drum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace
{
using namespace granum;
using math::Vec3;

constexpr double granule = 2e-3, dt = 2e-5;
constexpr int turns = 200, steps = 100;  //!< looks at the ranks; steps in between

struct State
{
    particle::Id id;
    Vec3 position, velocity, spin;
    double collisions, collision_speed, collision_wear, wall_collisions, wall_collision_speed, wall_collision_wear;
};

//! FNV-1a of the states of all granules in the order of their identities, on every rank.
std::uint64_t hash_of(scene::Scene const& scene)
{
    std::vector<std::byte> mine;
    for (std::size_t row = 0; row < scene.granules.owned; ++row) {
        State const state{scene.granules.id[row],
                          scene.granules.position[row],
                          scene.granules.velocity[row],
                          scene.granules.spin[row],
                          scene.granules.collisions[row],
                          scene.granules.collision_speed[row],
                          scene.granules.collision_wear[row],
                          scene.granules.wall_collisions[row],
                          scene.granules.wall_collision_speed[row],
                          scene.granules.wall_collision_wear[row]};
        auto const* bytes = reinterpret_cast<std::byte const*>(&state);
        mine.insert(mine.end(), bytes, bytes + sizeof(State));
    }
    auto bytes = scene.comm.gather(mine);
    scene.comm.broadcast(bytes);
    std::vector<State> all(bytes.size() / sizeof(State));
    std::memcpy(all.data(), bytes.data(), bytes.size());
    std::sort(all.begin(), all.end(), [](auto const& a, auto const& b) { return a.id < b.id; });
    std::uint64_t hash = 14695981039346656037u;
    auto const* first = reinterpret_cast<unsigned char const*>(all.data());
    for (std::size_t k = 0; k < all.size() * sizeof(State); ++k) hash = (hash ^ first[k]) * 1099511628211u;
    return hash;
}

//! Hash after 20,000 steps on the ranks of `comm`, and how often a granule changed its rank on this one.
std::uint64_t drum_on(par::Communicator const& comm, long& moved)
{
    scene::Drum const drum{16 * granule, 14 * granule, 6.0, 0.1};
    auto scene =
        scene::filled_drum(drum, {1e6, 0.25, 1500},
                           {.restitution = 0.6, .sliding_friction = 0.5, .rolling_friction = 0.05}, granule, 0.35);
    // Between two end walls: no granule goes round the drum's length.
    scene.settings.periodic = {};
    for (double const y : {0.0, drum.length}) scene.add_plane({0, y, 0}, {0, y > 0 ? -1.0 : 1.0, 0});
    scene.comm = comm;
    scene.granules.keep({.collisions = true});
    auto& granules = scene.granules;
    if (!comm.root()) granules.resize(0);  // the others get theirs by the first cut
    par::Space const space{{scene.settings.lower, scene.settings.upper}, scene.settings.periodic};
    std::vector<double> const work(granules.owned, 1);
    auto partition = comm.size() > 1 ? par::Partition::balanced(
                                           space, std::span(granules.position.values).first(granules.owned), work, comm)
                                     : par::Partition(space);
    dem::Engine engine(scene.settings, partition, comm);
    engine.prepare(granules);
    moved = 0;
    for (int turn = 0; turn < turns; ++turn) {
        std::vector<particle::Id> before(granules.id.values.begin(),
                                         granules.id.values.begin() + static_cast<long>(granules.owned));
        std::sort(before.begin(), before.end());
        engine.advance(granules, dt, steps);
        if (turn % 5 == 4) engine.rebalance(granules);
        for (std::size_t row = 0; row < granules.owned; ++row)
            moved += !std::binary_search(before.begin(), before.end(), granules.id[row]);
    }
    EXPECT_GT(engine.watch().contacts, 0);
    double met = 0;
    for (std::size_t row = 0; row < granules.owned; ++row) met += granules.collisions[row];
    EXPECT_GT(comm.sum(met), 1000);
    return hash_of(scene);
}

TEST(RotatingDrum, has_the_same_bits_on_any_number_of_ranks)
{
    par::Communicator const all(MPI_COMM_WORLD), self(MPI_COMM_SELF);
    long moved = 0, none = 0;
    auto const together = drum_on(all, moved);
    // One rank runs it alone, the others wait for its answer.
    std::vector<std::byte> alone(sizeof(std::uint64_t));
    if (all.root()) {
        auto const hash = drum_on(self, none);
        std::memcpy(alone.data(), &hash, sizeof hash);
    }
    all.broadcast(alone);
    std::uint64_t expected = 0;
    std::memcpy(&expected, alone.data(), sizeof expected);
    EXPECT_EQ(together, expected);
    if (all.size() > 1) {
        EXPECT_GT(all.sum(moved), 100) << "hardly a granule changed its rank";
    }
}
}
