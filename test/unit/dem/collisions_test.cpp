// Collisions that the engine counts: what it says of them against what the velocities show.
#include "granum/dem/kernel/kernel.hpp"
#include "scene/granules.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using math::Vec3;

scene::Scene counting(double restitution, std::string const& kernel, double threshold = 0)
{
    scene::Scene out({1e7, 0.25, 1500}, {.restitution = restitution, .sliding_friction = 0.3});
    out.granules.keep({.collisions = true});
    out.settings.kernel = kernel;
    out.settings.wear_threshold = threshold;
    return out;
}

std::vector<std::string> names()
{
    std::vector<std::string> out;
    for (auto const* kernel : dem::kernel::kernels()) out.emplace_back(kernel->name);
    return out;
}
}

TEST(Collisions, of_two_unlike_granules_are_told_as_their_velocities_change)
{
    for (auto const& kernel : names()) {
        auto scene = counting(0.7, kernel);
        scene.add({-1.01e-3, 0, 0}, {1.5, 0, 0}, 1e-3, 1500);
        scene.add({2.01e-3, 0, 0}, {-0.5, 0, 0}, 2e-3, 1500);
        double const before = scene.kinetic_energy();
        scene.prepare();
        scene.run(4000, 1e-7);
        auto const& g = scene.granules;
        ASSERT_LT(g.velocity[0].x, 0) << "they have parted";
        double lost = 0;
        for (std::size_t row : {0u, 1u}) {
            EXPECT_EQ(g.collisions[row], 1) << kernel;
            double const change = std::abs(g.velocity[row].x - (g.id[row] == 0 ? 1.5 : -0.5));
            EXPECT_NEAR(g.collision_speed[row], change, 5e-3 * change) << kernel;
            lost += g.collision_wear[row] * g.mass[row];
        }
        EXPECT_NEAR(lost, before - scene.kinetic_energy(), 0.01 * lost) << kernel;
        EXPECT_NEAR(g.collision_wear[0] * g.mass[0], g.collision_wear[1] * g.mass[1], 1e-9 * lost) << "half each";
    }
}

TEST(Collisions, with_a_wall_count_each_blow_and_only_what_is_above_the_threshold)
{
    for (auto const& kernel : names()) {
        // A granule between two walls: each blow leaves half of its speed.
        auto scene = counting(0.5, kernel, 0.05);
        scene.add_plane({0, 0, 0}, {1, 0, 0});
        scene.add_plane({3e-3, 0, 0}, {-1, 0, 0});
        scene.add({1.5e-3, 0, 0}, {1, 0, 0}, 1e-3, 1500);
        scene.prepare();
        scene.run(200000, 1e-7);
        auto const& g = scene.granules;
        double speed = 1, changes = 0, wear = 0;
        for (int blow = 0; blow < static_cast<int>(g.wall_collisions[0]); ++blow) {
            changes += 1.5 * speed;
            wear += std::max(0.0, 0.5 * speed * speed * 0.75 - 0.05);
            speed *= 0.5;
        }
        EXPECT_GE(g.wall_collisions[0], 3) << kernel;
        EXPECT_NEAR(std::abs(g.velocity[0].x), speed, 0.02 * speed) << kernel;
        EXPECT_NEAR(g.wall_collision_speed[0], changes, 0.02 * changes) << kernel;
        EXPECT_NEAR(g.wall_collision_wear[0], wear, 0.03 * wear) << kernel;
    }
}

TEST(Collisions, are_not_counted_anew_while_a_contact_lasts_and_lists_are_made_anew)
{
    auto scene = counting(0.3, "");
    scene.settings.gravity = {0, 0, -9.81};
    scene.add_plane({0, 0, 0}, {0, 0, 1});
    scene.add({0, 0, 1e-3 - 2.6e-7}, {}, 1e-3, 1500);
    scene.prepare();
    for (int k = 0; k < 20; ++k) {
        scene.run(200, 1e-6);
        scene.engine->prepare(scene.granules);
    }
    EXPECT_EQ(scene.granules.wall_collisions[0], 0) << "it lay there from the start";
}
