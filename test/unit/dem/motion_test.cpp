// Motion through the engine: falling, bouncing, sliding into rolling, rolling to a stop, energy, refusals.
#include "granum/base/error.hpp"
#include "scene/granules.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum;
using math::Vec3;

constexpr double g = 9.81;
constexpr scene::Stuff soft{1e7, 0.25, 1445};

TEST(FreeFall, is_the_parabola_and_the_bounce_reaches_the_square_of_the_restitution)
{
    double const radius = 0.1, drop = 0.4, e = 0.9;
    auto scene = scene::sphere_on_plane({1e9, 0.25, 2600}, radius, {}, {.restitution = e});
    scene.settings.gravity = {0, 0, -g};
    scene.granules.position[0].z = radius + drop;
    scene.prepare();
    double const dt = 1e-6;
    scene.run(200'000, dt);
    EXPECT_NEAR(scene.granules.position[0].z, radius + drop - 0.5 * g * 0.04, 1e-9);
    EXPECT_NEAR(scene.granules.velocity[0].z, -g * 0.2, 1e-9);
    double highest = 0;
    while (scene.granules.velocity[0].z < 0) scene.run(1, dt);
    while (scene.granules.velocity[0].z > 0) {
        scene.run(1, dt);
        highest = std::max(highest, scene.granules.position[0].z);
    }
    EXPECT_NEAR((highest - radius) / drop, e * e, 5e-3);
}

TEST(SlidingSphere, rolls_after_two_sevenths_of_the_speed_over_the_friction)
{
    double const radius = 5e-4, speed = 0.1;
    for (double const friction : {0.2, 0.6, 1.0}) {
        auto scene = scene::sphere_on_plane({1e8, 0.25, 1e4}, radius, {speed, 0, 0},
                                            {.restitution = 0.5, .sliding_friction = friction});
        scene.settings.gravity = {0, 0, -g};
        scene.settings.laws.lever = dem::Lever::radius;
        // Placed where the spring carries its weight.
        double const modulus = 1e8 / (1 - 0.0625), weight = scene.granules.mass[0] * g;
        scene.granules.position[0].z = radius - std::pow(0.75 * weight / (modulus * std::sqrt(radius)), 2.0 / 3.0);
        scene.prepare();
        double const dt = 5e-7;
        double time = 0;
        while (scene.granules.velocity[0].x - radius * scene.granules.spin[0].y > 1e-4 * speed && time < 0.1) {
            scene.run(1, dt);
            time += dt;
        }
        double const expected = 2 * speed / (7 * friction * g);
        EXPECT_NEAR(time / expected, 1, 0.01) << friction;
        scene.run(1000, dt);
        EXPECT_NEAR(scene.granules.velocity[0].x / speed, 5.0 / 7, 2e-3);
        EXPECT_NEAR(scene.granules.spin[0].y * radius / speed, 5.0 / 7, 2e-3);
    }
}

TEST(RollingSphere, stops_after_the_distance_that_the_rolling_friction_sets)
{
    double const radius = 0.01, speed = 1;
    auto scene = scene::sphere_on_plane({1e7, 0.25, 1445}, radius, {speed, 0, 0},
                                        {.restitution = 0.3, .sliding_friction = 0.8, .rolling_friction = 0.1},
                                        {0, speed / radius, 0});
    scene.settings.gravity = {0, 0, -g};
    scene.settings.laws.lever = dem::Lever::radius;
    double const modulus = 1e7 / (1 - 0.0625), weight = scene.granules.mass[0] * g;
    scene.granules.position[0].z = radius - std::pow(0.75 * weight / (modulus * std::sqrt(radius)), 2.0 / 3.0);
    scene.prepare();
    scene.run(150'000, 1e-5);  // 1.5 s; it stops after 1.4271 s
    EXPECT_NEAR(scene.granules.position[0].x / 0.71356, 1, 0.05);
    EXPECT_NEAR(scene.granules.velocity[0].x, 0, 0.02);
}

// Spheres dropped as a loose cloud into a box.
scene::Scene collapse(long count, dem::PairProperties const& properties)
{
    double const radius = 2e-3;
    scene::Scene scene(soft, properties);
    scene.settings.gravity = {0, 0, -g};
    geometry::Chamber chamber;
    chamber.size = {0.04, 0.04, 0.2};
    scene.enclose(chamber.lower(), chamber.upper());
    for (auto const& position : particle::random_loose(chamber, radius, count, 7))
        scene.add(position, {}, radius, soft.density);
    return scene;
}

TEST(EnergyAudit, of_a_collapse_of_a_thousand_granules_is_closed)
{
    auto scene = collapse(1000, {.restitution = 0.7, .sliding_friction = 0.4, .rolling_friction = 0.02});
    scene.prepare();
    double const before = scene.kinetic_energy() + scene.potential_energy();
    scene.run(15'000, 1e-5);
    auto const& watch = scene.engine->watch();
    double const after =
        scene.kinetic_energy() + scene.potential_energy() + watch.elastic.value() + watch.dissipated.value();
    double const moved = before - scene.potential_energy();
    EXPECT_GT(watch.dissipated.value(), 0.9 * moved);  // it came to rest, so the audit is not trivial
    EXPECT_NEAR((after - before) / before, 0, 1e-3);
    EXPECT_NEAR((after - before) / moved, 0, 2e-3);
}

TEST(Watch, sees_the_walls_carry_the_weight_of_a_settled_bed)
{
    auto scene = collapse(500, {.restitution = 0.3, .sliding_friction = 0.4, .rolling_friction = 0.02});
    scene.prepare();
    scene.run(8'000, 2e-5);
    double const weight = 500 * scene.granules.mass[0] * g;
    EXPECT_NEAR(scene.engine->watch().wall_force.z / weight, 1, 0.01);
    EXPECT_NEAR(scene.engine->watch().wall_force.x / weight, 0, 0.01);
}

TEST(PeriodicBox, keeps_momentum_and_lets_granules_meet_across_every_face)
{
    for (std::size_t d = 0; d < 3; ++d) {
        scene::Scene scene(soft, {.restitution = 1});
        scene.settings.lower = {0, 0, 0};
        scene.settings.upper = {0.1, 0.1, 0.1};
        scene.settings.periodic = {true, true, true};
        scene.slabs = {.origin = 0, .width = 0.1, .periodic = true};
        Vec3 left{0.05, 0.05, 0.05}, right = left, velocity;
        left[d] = 0.097;
        right[d] = 0.003;
        velocity[d] = 0.5;
        scene.add(left, velocity, 1e-3, 1445);
        scene.add(right, -velocity, 1e-3, 1445);
        scene.prepare();
        scene.run(2000, 1e-5);
        EXPECT_NEAR(norm(scene.momentum()), 0, 1e-12 * scene.granules.mass[0]);
        auto const first = scene.row(0);
        EXPECT_NEAR(scene.granules.velocity[first][d], -0.5, 2e-3);
        EXPECT_GE(scene.granules.position[first][d], -1e-3);
    }
}

TEST(PeriodicBox, of_two_diameters_is_refused)
{
    scene::Scene scene(soft);
    scene.settings.lower = {};
    scene.settings.upper = {0.1, 0.004, 0.1};
    scene.settings.periodic = {false, true, false};
    scene.add({0.05, 0.002, 0.05}, {}, 1e-3, 1445);
    EXPECT_THROW(scene.prepare(), base::NumericsError);
    scene.settings.upper.y = 0.0045;
    EXPECT_NO_THROW(scene.prepare());
}

TEST(Engine, names_the_granule_whose_state_is_not_finite)
{
    scene::Scene scene(soft);
    scene.add({}, {}, 1e-3, 1445);
    scene.add({1, 0, 0}, {}, 1e-3, 1445);
    scene.prepare();
    scene.run(3, 1e-5);
    auto const bad = scene.row(1);
    scene.granules.velocity[bad].y = std::nan("");
    try {
        scene.run(1, 1e-5);
        FAIL() << "a velocity that is no number went unnoticed";
    } catch (base::NumericsError const& error) {
        EXPECT_NE(std::string(error.what()).find("granule 1 "), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("step 4"), std::string::npos) << error.what();
    }
}

TEST(Engine, stops_where_two_granules_overlap_by_more_than_half_a_radius_and_counts_above_a_tenth)
{
    for (auto const& [apart, fails] : {std::pair{1.4e-3, true}, std::pair{1.85e-3, false}}) {
        scene::Scene scene(soft);
        scene.add({}, {}, 1e-3, 1445);
        scene.add({apart, 0, 0}, {}, 1e-3, 1445);
        if (fails) {
            EXPECT_THROW(scene.prepare(), base::NumericsError);
        } else {
            scene.prepare();
            EXPECT_EQ(scene.engine->watch().warned_overlaps, 1);
            EXPECT_NEAR(scene.engine->watch().largest_overlap, 0.15, 1e-12);
        }
    }
}

TEST(StepBounds, are_those_of_the_tabulated_granules)
{
    struct Row
    {
        double radius, density, modulus, poisson, rayleigh, hertz;
    };
    for (auto const& row :
         {Row{0.6e-3, 1000, 1.2e8, 0.30, 9.480e-6, 3.141e-5}, Row{0.3e-3, 1445, 1e7, 0.25, 1.953e-5, 4.975e-5},
          Row{1.25e-3, 2526, 1e8, 0.25, 3.402e-5, 1.032e-4}}) {
        dem::Settings settings;
        settings.laws.add({row.modulus, row.poisson, false});
        auto const bounds = dem::step_bounds(settings, row.radius, row.density, 1.0);
        ASSERT_EQ(bounds.size(), 2u);
        EXPECT_NEAR(bounds[0].seconds / (0.2 * row.rayleigh), 1, 1e-3);
        EXPECT_NEAR(bounds[1].seconds / (row.hertz / 20), 1, 1e-3);
    }
}

TEST(Flank, that_goes_on_as_a_cylinder_pushes_once_where_they_meet)
{
    // A granule pressed outward at the height where two equal cylinders meet feels one wall, not two.
    scene::Scene scene(soft, {.restitution = 1, .sliding_friction = 0});
    geometry::Frustum below{.length = 0.5, .base_radius = 0.1, .top_radius = 0.1, .side = geometry::Side::inside};
    auto above = below;
    above.base.z = 0.5;
    scene.settings.walls = {{.name = "chamber", .shapes = {below, above}, .material = 1}};
    for (double const height : {0.4, 0.4999, 0.5, 0.5001}) {
        scene.granules = {};
        scene.add({0.1 - 0.95e-3, 0, height}, {}, 1e-3, 1445);
        scene.prepare();
        EXPECT_EQ(scene.engine->watch().contacts, 1) << height;
        EXPECT_NEAR(scene.engine->watch().wall_force.z, 0, 1e-12);
        EXPECT_LT(scene.engine->watch().wall_force.x, 0);
    }
}
}
