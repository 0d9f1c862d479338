// The rows of hard spheres beside those of the soft engine: cooling after Haff, and impacts that slide throughout.
#include "scene/hard_granules.hpp"
#include "table.hpp"

namespace
{
using namespace granum;
using math::Vec3;
using scene::HardScene;
using verify::below;
using verify::relative;

// A gas of 5 % solids and 0.01 m2/s2 that has forgotten its lattice, with restitution 0.9 from now on.
HardScene mixed(int side, std::uint32_t seed)
{
    auto warm = scene::hard_gas(side, 0.05, 0.01, {.restitution = 1, .sliding_friction = 0}, seed);
    warm.prepare_hard();
    warm.run_hard(0.1);
    HardScene scene({.restitution = 0.9, .sliding_friction = 0});
    scene.settings.lower = warm.settings.lower;
    scene.settings.upper = warm.settings.upper;
    scene.settings.periodic = warm.settings.periodic;
    scene.granules = warm.granules;
    scene.prepare_hard();
    return scene;
}

TEST(HardCooling, starts_at_the_rate_of_haff)
{
    double mean = 0;
    int const seeds = 5;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        auto scene = mixed(13, seed);
        double const before = scene.granular_temperature();
        scene.run_hard(0.02);
        mean += 2 * (std::sqrt(before / scene.granular_temperature()) - 1) / 0.02 / seeds;
    }
    relative("P10", "hard spheres, 0.05 solids, restitution 0.9: initial -d ln T/dt, mean of 5 seeds, 1/s", 4.876, mean,
             0.10);
}

TEST(HardCooling, follows_the_law_of_haff_over_a_million_collisions)
{
    auto scene = mixed(22, 1);
    double const start = scene.granular_temperature();
    double const tau = 2 / (4.8761 * std::sqrt(start / 0.01));
    double time = 0;
    for (double const at : {1.0, 5.0, 20.0, 100.0}) {
        scene.run_hard(at * tau - time);
        time = at * tau;
        relative("D10",
                 fmt::format("{} hard spheres: temperature at {} tau over that at the start", scene.granules.owned, at),
                 1 / std::pow(1 + at, 2), scene.granular_temperature() / start, 0.05);
    }
    while (scene.watch().collisions < 1'000'000) scene.run_hard(20 * tau);
    below("D10", "hard spheres, a million collisions: largest overlap over a radius", 1e-9,
          scene.watch().largest_overlap);
}

TEST(HardImpacts, that_slide_are_those_of_rigid_bodies)
{
    for (double const degrees : {40.0, 60.0}) {
        double const angle = degrees * math::pi / 180, radius = 2.5e-3;
        HardScene scene({.restitution = 0.98, .sliding_friction = 0.092});
        scene.add_plane({0, 0, 0}, {0, 0, 1});
        scene.add({0, 0, 2 * radius}, {3.9 * std::sin(angle), 0, -3.9 * std::cos(angle)}, radius, 4000);
        scene.prepare_hard();
        scene.run_hard(2 * radius / (3.9 * std::cos(angle)));
        relative("P4", fmt::format("hard sphere, oblique at {} deg: tangential restitution", degrees),
                 degrees == 40 ? 0.7829 : 0.8948, scene.granules.velocity[0].x / (3.9 * std::sin(angle)), 1e-3);
    }
    HardScene scene({.restitution = 0.5, .sliding_friction = 0.4}, 0);
    scene.add_plane({0, 0, 0}, {0, 0, 1});
    scene.add({0, 0, 0.11}, {0, 0, -0.2}, 0.1, 2700, {0, -21, 0});
    scene.prepare_hard();
    scene.run_hard(0.1);
    relative("P7", "hard sphere with 21 rad/s: tangential velocity after, m/s", -0.12, scene.granules.velocity[0].x,
             1e-3);
    relative("P7", "hard sphere with 21 rad/s: spin after, rad/s", 18, -scene.granules.spin[0].y, 1e-3);
}
}
