// The granule engine on several ranks: nothing is lost on the way, and the answer is that of one rank.
#include "granum/base/error.hpp"
#include "granum/base/random.hpp"
#include "granum/particle/rows.hpp"
#include "scene/granules.hpp"
#include "scene/held_gas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <span>

namespace
{
using namespace granum;
using math::Vec3;

// Every rank builds the whole scene; keep only the granules of this rank's slab.
void share_out(scene::Scene& scene, int cells)
{
    scene.comm = par::Communicator(MPI_COMM_WORLD);
    double const lower = scene.settings.lower.x, upper = scene.settings.upper.x;
    scene.slabs = par::Slabs::balanced(lower, (upper - lower) / cells, scene.settings.periodic[0],
                                       std::vector<double>(static_cast<std::size_t>(cells), 1.0), scene.comm.size());
    std::vector<std::uint32_t> mine;
    for (std::uint32_t row = 0; row < scene.granules.owned; ++row)
        if (scene.slabs.owner(scene.granules.position[row].x) == scene.comm.rank()) mine.push_back(row);
    particle::reorder(scene.granules, mine);
}

struct State
{
    particle::Id id;
    Vec3 position, velocity, spin, drag_impulse, spin_impulse;
};

// All granules in the order of their ids, on every rank.
std::vector<State> collect(scene::Scene const& scene)
{
    std::vector<std::byte> mine;
    for (std::size_t row = 0; row < scene.granules.owned; ++row) {
        auto const& granules = scene.granules;
        bool const turning = granules.groups.turning;
        State const state{granules.id[row],           granules.position[row],
                          granules.velocity[row],     granules.spin[row],
                          granules.drag_impulse[row], turning ? granules.spin_impulse[row] : Vec3{}};
        auto const* bytes = reinterpret_cast<std::byte const*>(&state);
        mine.insert(mine.end(), bytes, bytes + sizeof(State));
    }
    auto bytes = scene.comm.gather(mine);
    scene.comm.broadcast(bytes);
    std::vector<State> out(bytes.size() / sizeof(State));
    std::memcpy(out.data(), bytes.data(), bytes.size());
    std::sort(out.begin(), out.end(), [](auto const& a, auto const& b) { return a.id < b.id; });
    return out;
}

constexpr double radius = 2e-3, density = 1445;

scene::Scene collapse()
{
    scene::Scene scene({1e7, 0.25, density}, {.restitution = 0.6, .sliding_friction = 0.4, .rolling_friction = 0.02});
    scene.settings.gravity = {3, 0, -9.81};  // leaning, so that the heap slides across the slabs
    geometry::Chamber chamber;
    chamber.size = {0.08, 0.03, 0.1};
    scene.enclose(chamber.lower(), chamber.upper());
    for (auto const& position : particle::random_loose(chamber, radius, 1000, 5))
        scene.add(position, {}, radius, density);
    return scene;
}

// A dense periodic box without walls, sheared: velocity along y and x grows with z and y.
scene::Scene shear(int columns = 10, int rows = 7, int levels = 6)
{
    scene::Scene scene({1e7, 0.25, density}, {.restitution = 0.6, .sliding_friction = 0.4, .rolling_friction = 0.05});
    scene.settings.lower = {};
    scene.settings.upper = {columns * 0.0048, rows * 0.036 / 7, levels * 0.005};
    scene.settings.periodic = {true, true, true};
    int id = 0;
    for (int k = 0; k < levels; ++k)
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i, ++id) {
                base::Random random(1, base::Purpose::test, static_cast<std::uint64_t>(id), 0);
                Vec3 const centre{(i + 0.5) * 0.0048, (j + 0.5) * 0.036 / 7, (k + 0.5) * 0.005};
                auto const off = [&] { return 3e-4 * std::clamp(random.normal(), -1.5, 1.5); };  // never deep overlaps
                Vec3 const at = centre + Vec3{off(), off(), off()};
                scene.add(at, {0.8 * std::sin(130 * at.y) + 1.2, 0.5 * random.normal(), 0.5 * std::sin(200 * at.x)},
                          radius, density, {20, 40 * random.normal(), 0});
            }
    return scene;
}

TEST(Ranks, conserve_the_granules_of_a_collapse_and_end_at_rest)
{
    auto scene = collapse();
    share_out(scene, 8);
    scene.prepare();
    scene.run(5'000, 2e-5);
    auto const all = collect(scene);
    ASSERT_EQ(all.size(), 1000u);
    for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k].id, k);
    double const weight_z = scene.comm.sum(scene.engine->watch().wall_force.z);
    double const weight = 1000 * 4.0 / 3.0 * math::pi * radius * radius * radius * density * 9.81;
    EXPECT_NEAR(weight_z / weight, 1, 0.1);
}

TEST(Ranks, conserve_momentum_without_walls)
{
    auto scene = shear();
    share_out(scene, 6);
    Vec3 const before = [&] {
        Vec3 const mine = scene.momentum();
        return Vec3{scene.comm.sum(mine.x), scene.comm.sum(mine.y), scene.comm.sum(mine.z)};
    }();
    scene.prepare();
    scene.run(1000, 2e-5);
    Vec3 const mine = scene.momentum();
    Vec3 const after{scene.comm.sum(mine.x), scene.comm.sum(mine.y), scene.comm.sum(mine.z)};
    EXPECT_NEAR(norm(after - before) / norm(before), 0, 1e-10);
    EXPECT_EQ(scene.comm.sum(static_cast<long>(scene.granules.owned)), 420);
}

TEST(Ranks, agree_with_one_rank_because_history_migrates)
{
    auto apart = shear(), alone = shear();
    share_out(apart, 6);
    alone.slabs = {.origin = 0, .width = 0.048, .periodic = true};
    // A thin skin makes many rebuilds, so that many granules change their rank with contacts in progress.
    apart.settings.skin = alone.settings.skin = 2e-4;
    apart.prepare();
    alone.prepare();
    long moved = 0;
    for (int round = 0; round < 20; ++round) {
        std::vector<particle::Id> const before(
            apart.granules.id.values.begin(),
            apart.granules.id.values.begin() + static_cast<long>(apart.granules.owned));
        apart.run(10, 1e-5);
        alone.run(10, 1e-5);
        for (std::size_t row = 0; row < apart.granules.owned; ++row)
            moved += std::find(before.begin(), before.end(), apart.granules.id[row]) == before.end();
    }
    if (apart.comm.size() > 1) {
        EXPECT_GT(apart.comm.sum(moved), 10);
    }
    EXPECT_GT(apart.engine->watch().rebuilds, 10);
    auto const one = collect(alone);  // each rank ran it for itself
    auto const many = collect(apart);
    ASSERT_EQ(many.size(), one.size());
    double const length = 0.048, speed = 1;
    for (std::size_t k = 0; k < one.size(); ++k) {
        for (std::size_t d = 0; d < 3; ++d) {
            double const width = alone.settings.upper[d];
            double const apart_by = one[k].position[d] - many[k].position[d];
            EXPECT_NEAR((apart_by - width * std::round(apart_by / width)) / length, 0, 1e-9) << "granule " << k;
            EXPECT_NEAR((one[k].velocity[d] - many[k].velocity[d]) / speed, 0, 1e-9) << "granule " << k;
            EXPECT_NEAR((one[k].spin[d] - many[k].spin[d]) * radius / speed, 0, 1e-9) << "granule " << k;
        }
    }
    // The energy that is lost is counted once per pair, however the pairs are split.
    EXPECT_NEAR(apart.comm.sum(apart.engine->watch().dissipated.value()) / alone.engine->watch().dissipated.value(), 1,
                1e-6);
}

// The same on one rank, on several, and on one rank step by step.
struct Alike
{
    scene::Scene alone, apart, slow;

    Alike(std::function<scene::Scene()> const& make, int cells, int steps, double dt)
        : alone(make()), apart(make()), slow(make())
    {
        share_out(apart, cells);
        double const lower = alone.settings.lower.x, upper = alone.settings.upper.x;
        alone.slabs = slow.slabs = {.origin = lower, .width = upper - lower, .periodic = alone.settings.periodic[0]};
        for (auto* scene : {&apart, &alone, &slow}) scene->prepare();
        apart.run(steps, dt);
        alone.run(steps, dt);
        for (int step = 0; step < steps; ++step) slow.run(1, dt);
    }

    // Compares them bit by bit, and answers with the states.
    std::vector<State> compare() const
    {
        EXPECT_EQ(slow.engine->watch().sweeps, 0);
        EXPECT_EQ(alone.engine->watch().late_lists + apart.engine->watch().late_lists, 0);
        auto const one = collect(alone), many = collect(apart), stepped = collect(slow);
        EXPECT_EQ(many.size(), one.size());
        EXPECT_EQ(stepped.size(), one.size());
        long others = 0, behind = 0;
        for (std::size_t k = 0; k < std::min({one.size(), many.size(), stepped.size()}); ++k) {
            others += std::memcmp(&one[k], &many[k], sizeof(State)) != 0;
            // Each call rounds the impulses once.
            behind += std::memcmp(&one[k], &stepped[k], offsetof(State, drag_impulse)) != 0;
        }
        EXPECT_EQ(others, 0) << "granules that other ranks have otherwise";
        EXPECT_EQ(behind, 0) << "granules that sweeps have otherwise";
        EXPECT_EQ(alone.engine->watch().dissipated.value(), slow.engine->watch().dissipated.value());
        return one;
    }
};

TEST(Ranks, have_the_bits_of_one_rank_across_periodic_faces_and_in_sweeps)
{
    // Wide enough that layers are as thin as they may be.
    constexpr int columns = 24;
    Alike const scenes([] { return shear(columns, 17, 17); }, columns, 200, 1e-5);
    EXPECT_GT(scenes.alone.engine->watch().sweeps, 20);
    EXPECT_GT(scenes.apart.engine->watch().sweeps, 20);
    EXPECT_GT(scenes.apart.engine->watch().rebuilds, 3);
    long crossed = 0;
    for (auto const& state : scenes.compare()) {
        auto const column = static_cast<double>(state.id % columns);
        crossed += std::abs(state.position.x - (column + 0.5) * 0.0048) > 0.5 * columns * 0.0048;
    }
    EXPECT_GT(crossed, 20);
}

TEST(Ranks, have_the_bits_of_one_rank_in_strips_across_wide_layers)
{
    auto const wide = [](bool periodic) {
        // Across a periodic domain strips are counted from the middle both ways, so it must be twice as wide.
        if (periodic) return shear(90, 84, 7);
        auto scene = shear(46, 44, 25);
        scene.settings.periodic = {};
        Vec3 const margin{0.002, 0.002, 0.002};
        scene.enclose(scene.settings.lower - margin, scene.settings.upper + margin);
        return scene;
    };
    for (bool const periodic : {false, true}) {
        SCOPED_TRACE(periodic ? "periodic" : "between walls");
        Alike const scenes([&] { return wide(periodic); }, periodic ? 90 : 46, 60, 1e-5);
        EXPECT_GT(scenes.alone.engine->watch().strips, 1);
        EXPECT_GT(scenes.apart.comm.max(scenes.apart.engine->watch().strips), 1);
        EXPECT_GT(scenes.alone.engine->watch().sweeps, 3);
        EXPECT_GT(scenes.apart.engine->watch().sweeps, 3);
        scenes.compare();
    }
}

// Each granule in a gas of its own; in one half of the box there is none, so that some ranks begin without.
TEST(Ranks, have_the_bits_of_one_rank_in_a_held_gas)
{
    constexpr int columns = 24;
    auto const blown = [] {
        auto scene = shear(columns, 17, 17);
        auto& granules = scene.granules;
        granules.keep({.added_mass = true, .turning = true});
        scene::blow_at_random(granules);
        for (std::size_t row = 0; row < granules.owned; ++row) {
            if (granules.position[row].x > 0.5 * scene.settings.upper.x) continue;
            granules.drag_rate[row] = granules.added_mass[row] = granules.spin_rate[row] = 0;
            granules.gas_force[row] = granules.drag_impulse[row] = {};
        }
        scene.settings.gravity = {1, -2, 3};
        return scene;
    };
    Alike const scenes(blown, columns, 200, 1e-5);
    EXPECT_GT(scenes.alone.engine->watch().sweeps, 20);
    EXPECT_GT(scenes.apart.engine->watch().sweeps, 20);
    EXPECT_GT(scenes.apart.engine->watch().rebuilds, 3);
    auto const states = scenes.compare();
    auto const given = [&](auto const& impulse) {
        return std::count_if(states.begin(), states.end(),
                             [&](State const& state) { return impulse(state) != Vec3{}; });
    };
    EXPECT_GT(given([](State const& state) { return state.drag_impulse; }), 1000);
    EXPECT_GT(given([](State const& state) { return state.spin_impulse; }), 1000);
}

// Something that belongs to granules: a number per id.
struct Labels : particle::Attachment
{
    std::map<particle::Id, double> of;
    void take(particle::Id id, std::vector<std::byte>& bytes) override
    {
        auto const* first = reinterpret_cast<std::byte const*>(&of.at(id));
        bytes.insert(bytes.end(), first, first + sizeof(double));
        of.erase(id);
    }
    void give(particle::Id id, std::span<std::byte const> bytes) override
    {
        std::memcpy(&of[id], bytes.data(), sizeof(double));
    }
};

TEST(Ranks, carry_what_is_attached_to_a_granule)
{
    auto scene = shear();
    share_out(scene, 6);
    Labels labels;
    for (std::size_t row = 0; row < scene.granules.owned; ++row)
        labels.of[scene.granules.id[row]] = 0.5 * static_cast<double>(scene.granules.id[row]);
    scene.engine = std::make_unique<dem::Engine>(scene.settings, scene.slabs, scene.comm);
    scene.engine->attach(labels);
    scene.engine->prepare(scene.granules);
    scene.run(500, 2e-5);
    scene.engine->bring_home(scene.granules);
    EXPECT_EQ(labels.of.size(), scene.granules.owned);
    for (std::size_t row = 0; row < scene.granules.owned; ++row) {
        EXPECT_EQ(labels.of.at(scene.granules.id[row]), 0.5 * static_cast<double>(scene.granules.id[row]));
        EXPECT_EQ(scene.slabs.owner(scene.granules.position[row].x), scene.comm.rank());
    }
}

TEST(Ranks, all_stop_when_one_meets_a_failure)
{
    auto scene = shear();
    share_out(scene, 6);
    scene.prepare();
    scene.run(5, 1e-5);
    if (scene.comm.root()) scene.granules.velocity[0].x = std::nan("");
    EXPECT_THROW(scene.run(2, 1e-5), base::NumericsError);
}
}
