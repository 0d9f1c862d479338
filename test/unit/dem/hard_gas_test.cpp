// Many hard spheres: what a gas of them conserves, how often they collide, how they cool, and how they come to rest.
#include "scene/hard_granules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace
{
using namespace granum;
using math::Vec3;
using scene::HardScene;

double momentum_scale(HardScene const& scene)
{
    double sum = 0;
    for (std::size_t k = 0; k < scene.granules.owned; ++k)
        sum += scene.granules.mass[k] * norm(scene.granules.velocity[k]);
    return sum;
}

// The collisions of one sphere per second after Enskog with the contact value of Carnahan and Starling.
double enskog(double fraction, double diameter, double temperature)
{
    double const number = fraction / (math::pi / 6 * diameter * diameter * diameter);
    double const contact = (1 - fraction / 2) / std::pow(1 - fraction, 3);
    return 4 * number * diameter * diameter * contact * std::sqrt(math::pi * temperature);
}

TEST(HardGas, elastic_keeps_energy_and_momentum_to_round_off_over_thousands_of_collisions)
{
    struct Kind
    {
        double friction, tangential;
    };
    for (auto const& kind : {Kind{0, 0}, Kind{1e9, 1}}) {  // smooth, perfectly rough
        auto scene =
            scene::hard_gas(8, 0.2, 0.01, {.restitution = 1, .sliding_friction = kind.friction}, 2, kind.tangential);
        scene.prepare_hard();
        double const energy = scene.kinetic_energy(), scale = momentum_scale(scene);
        Vec3 const momentum = scene.momentum();
        scene.run_hard(0.4, 4);
        EXPECT_GT(scene.watch().collisions, 30'000);
        EXPECT_NEAR(scene.kinetic_energy() / energy, 1, 1e-12);
        EXPECT_LE(norm(scene.momentum() - momentum), 1e-13 * scale);
        EXPECT_LE(scene.watch().largest_overlap, 1e-9);
        EXPECT_LE(scene.deepest_overlap(), 1e-9);
    }
}

TEST(HardGas, that_loses_energy_tells_how_much)
{
    auto scene = scene::hard_gas(8, 0.2, 0.01, {.restitution = 0.8, .sliding_friction = 0.3}, 3);
    scene.prepare_hard();
    double const energy = scene.kinetic_energy(), scale = momentum_scale(scene);
    Vec3 const momentum = scene.momentum();
    scene.run_hard(0.2, 3);
    EXPECT_LT(scene.kinetic_energy(), 0.5 * energy);
    EXPECT_NEAR((scene.kinetic_energy() + scene.watch().dissipated) / energy, 1, 1e-12);
    EXPECT_LE(norm(scene.momentum() - momentum), 1e-13 * scale);
}

// Reference case dem-11, of MFiX: 195 spheres of 1 cm and 1 g/cm3 in a periodic box of 8 cm, granular temperature
// 4.742 cm2/s2, kinetic energy 738.15 erg, 5 s; MFiX returns to 738.1 to 738.2 erg between contacts.
TEST(HardGas, of_the_mfix_box_keeps_its_energy)
{
    HardScene scene({.restitution = 1, .sliding_friction = 0});
    scene.settings.lower = {};
    scene.settings.upper = {0.08, 0.08, 0.08};
    scene.settings.periodic = {true, true, true};
    auto const gas = scene::hard_gas(6, 0.2, 4.742e-4, {}, 11);
    for (std::size_t k = 0; k < 195; ++k)
        scene.add(gas.granules.position[k] * (0.08 / gas.settings.upper.x), gas.granules.velocity[k], 0.005, 1000);
    double const wanted = 738.15e-7, scale = std::sqrt(wanted / scene.kinetic_energy());
    for (auto& v : scene.granules.velocity.values) v *= scale;
    scene.prepare_hard();
    for (int k = 0; k < 10; ++k) {
        scene.run_hard(0.5);
        EXPECT_NEAR(scene.kinetic_energy() / wanted, 1, 1e-12);
    }
    EXPECT_LE(scene.deepest_overlap(), 1e-9);
}

TEST(HardGas, elastic_collides_as_often_as_enskog_says)
{
    for (double const fraction : {0.05, 0.2, 0.35}) {
        auto scene = scene::hard_gas(14, fraction, 0.01, {.restitution = 1, .sliding_friction = 0}, 5);
        scene.prepare_hard();
        double const frequency = enskog(fraction, 1e-3, 0.01);
        scene.run_hard(15 / frequency);  // forgets the lattice
        long const before = scene.watch().collisions;
        double const time = 30 / frequency;
        scene.run_hard(time);
        double const each = 2.0 * static_cast<double>(scene.watch().collisions - before) /
                            static_cast<double>(scene.granules.owned) / time;
        EXPECT_NEAR(each / frequency, 1, 0.02) << fraction;
    }
}

// Haff's law at e = 0.9, 5 % solids, T0 = 0.01 m2/s2: -dlnT/dt = 4.876 1/s at first (computed from the Enskog rate).
TEST(HardGas, cools_at_haffs_rate)
{
    EXPECT_NEAR((1 - 0.81) * enskog(0.05, 1e-3, 0.01) / 3, 4.876, 1e-3);
    double mean = 0;
    int const seeds = 5;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        auto warm = scene::hard_gas(13, 0.05, 0.01, {.restitution = 1, .sliding_friction = 0}, seed);
        warm.prepare_hard();
        warm.run_hard(0.1);  // elastic until the lattice is forgotten
        HardScene scene({.restitution = 0.9, .sliding_friction = 0});
        scene.settings.lower = warm.settings.lower;
        scene.settings.upper = warm.settings.upper;
        scene.settings.periodic = warm.settings.periodic;
        scene.granules = warm.granules;
        scene.prepare_hard();
        double const before = scene.granular_temperature();
        scene.run_hard(0.02);
        // T(t) = T0 / (1 + rate t / 2)^2, so that this is the rate at the start.
        mean += 2 * (std::sqrt(before / scene.granular_temperature()) - 1) / 0.02 / seeds;
    }
    EXPECT_NEAR(mean / 4.876, 1, 0.10);
}

TEST(HardGas, of_sizes_from_one_to_ten_never_overlaps)
{
    HardScene scene({.restitution = 0.95, .sliding_friction = 0.1});
    double const width = 0.006;
    scene.settings.lower = {};
    scene.settings.upper = {width, width, width};
    scene.settings.periodic = {true, false, true};
    scene.add_plane({0, 0, 0}, {0, 1, 0});
    scene.add_plane({0, width, 0}, {0, -1, 0});
    std::uint64_t draw = 0;
    for (double const radius : {1e-3, 0.56e-3, 0.32e-3, 0.18e-3, 0.1e-3}) {
        double volume = 0;
        while (volume < 0.03 * width * width * width) {  // equal volumes of five sizes, 15 % in all
            base::Random random(8, base::Purpose::test, draw++, 0);
            Vec3 x{random.uniform() * width, radius + random.uniform() * (width - 2 * radius),
                   random.uniform() * width};
            bool fits = true;
            for (std::size_t k = 0; k < scene.granules.rows() && fits; ++k) {
                Vec3 apart = scene.granules.position[k] - x;
                for (std::size_t d : {0, 2}) apart[d] -= width * std::round(apart[d] / width);
                fits = norm(apart) > 1.0001 * (radius + scene.granules.radius[k]);
            }
            if (!fits) continue;
            scene.add(x, Vec3{random.normal(), random.normal(), random.normal()} * 0.1, radius, 1000);
            volume += 4.0 / 3.0 * math::pi * radius * radius * radius;
        }
    }
    scene.prepare_hard();
    double const energy = scene.kinetic_energy();
    for (int k = 0; k < 4; ++k) {
        scene.run_hard(0.005);
        EXPECT_LE(scene.deepest_overlap(), 1e-9);
    }
    EXPECT_GT(scene.watch().collisions, 1'000);
    EXPECT_LE(scene.watch().largest_overlap, 1e-9);
    EXPECT_NEAR((scene.kinetic_energy() + scene.watch().dissipated) / energy, 1, 1e-12);
}

// Two nested grids of cells, made narrow by many bystanders: a small sphere crosses several before it meets a large
// one.
TEST(HardGas, a_small_sphere_meets_a_large_one_wherever_it_comes_from)
{
    for (int axis = 0; axis < 3; ++axis)
        for (double const side : {-1.0, 1.0}) {
            HardScene scene({.restitution = 1, .sliding_friction = 0});
            scene.settings.lower = {};
            scene.settings.upper = {0.04, 0.04, 0.04};
            scene.settings.periodic = {true, true, true};
            Vec3 const centre{0.021, 0.021, 0.021};
            Vec3 along;
            along[static_cast<std::size_t>(axis)] = side;
            scene.add(centre, {}, 1e-3, 1000);
            auto const shot = scene.add(centre - 0.015 * along, along, 0.5e-3, 1000);
            for (int k = 0; k < 343; ++k)
                scene.add(Vec3{1.0 + k % 7, 1.0 + k / 7 % 7, 1.0 + k / 49} * 1.1e-3, {}, 0.5e-3, 1000);
            scene.prepare_hard();
            scene.run_hard(0.02);
            EXPECT_EQ(scene.watch().collisions, 1) << axis << " " << side;
            // Masses 8 to 1, head-on and elastic.
            EXPECT_NEAR(dot(scene.granules.velocity[shot], along), -7.0 / 9, 1e-12);
            EXPECT_LE(scene.watch().largest_overlap, 1e-12);
        }
}

TEST(HardGas, does_not_depend_on_the_order_of_its_rows)
{
    auto scene = scene::hard_gas(6, 0.2, 0.01, {.restitution = 0.9, .sliding_friction = 0.2}, 6);
    auto shuffled = scene::hard_gas(6, 0.2, 0.01, {.restitution = 0.9, .sliding_friction = 0.2}, 6);
    std::size_t const count = scene.granules.owned;
    for (std::size_t k = 0; k < count; ++k) {
        std::size_t const from = (k * 83 + 5) % count;
        shuffled.granules.id[k] = from;
        shuffled.granules.position[k] = scene.granules.position[from];
        shuffled.granules.velocity[k] = scene.granules.velocity[from];
    }
    for (auto* one : {&scene, &shuffled}) {
        one->prepare_hard();
        one->run_hard(0.01, 3);  // a few collisions each: round-off has not grown yet
    }
    EXPECT_EQ(scene.watch().collisions, shuffled.watch().collisions);
    for (std::size_t k = 0; k < count; ++k) {
        std::size_t const same = shuffled.granules.id[k];
        EXPECT_LE(norm(shuffled.granules.position[k] - scene.granules.position[same]), 1e-12);
        EXPECT_LE(norm(shuffled.granules.spin[k] - scene.granules.spin[same]),
                  1e-6 * (1 + norm(scene.granules.spin[same])));
    }
}

TEST(HardPile, comes_to_rest_by_itself_and_its_floor_carries_its_weight)
{
    HardScene scene({.restitution = 0.6, .sliding_friction = 0.3});
    scene.settings.gravity = {0, 0, -9.81};
    double const radius = 1e-3;
    scene.enclose({}, {0.01, 0.01, 0.05});
    double weight = 0;
    for (int k = 0; k < 100; ++k) {
        base::Random random(9, base::Purpose::test, static_cast<std::uint64_t>(k), 0);
        int const layer = k / 16, x = k % 4, y = k / 4 % 4;
        auto const row = scene.add({1.2e-3 + 2.4e-3 * x + 1e-4 * random.uniform(), 1.2e-3 + 2.4e-3 * y,
                                    1.2e-3 + 2.4e-3 * layer + 1e-4 * random.uniform()},
                                   {}, radius, 1000);
        weight += 9.81 * scene.granules.mass[row];
    }
    scene.prepare_hard();
    double energy = scene.potential_energy();
    double const first = energy;
    for (int k = 0; k < 25; ++k) {
        scene.run_hard(0.01);
        EXPECT_LE(scene.deepest_overlap(), 1e-9);
    }
    EXPECT_GT(scene.watch().collapses, 0);
    EXPECT_GT(scene.watch().time_driven, 0.05);
    EXPECT_LE(scene.watch().largest_overlap, 1e-9);
    EXPECT_LT(scene.kinetic_energy(), 1e-3 * first);
    EXPECT_NEAR((scene.kinetic_energy() + scene.potential_energy() + scene.watch().dissipated) / first, 1, 1e-6);
    Vec3 const before = scene.watch().wall_impulse;
    scene.run_hard(0.05, 5);
    EXPECT_NEAR((scene.watch().wall_impulse - before).z / (0.05 * weight), 1, 0.02);
    EXPECT_LE(scene.kinetic_energy() + scene.potential_energy(), first);
}

TEST(HardPile, of_one_ball_at_rest_weighs_what_the_ball_weighs)
{
    HardScene scene({.restitution = 0.9, .sliding_friction = 0});
    scene.settings.gravity = {0, 0, -9.81};
    scene.add_plane({0, 0, 0}, {0, 0, 1});
    scene.add({0, 0, 0.002}, {}, 0.001, 1000);
    scene.prepare_hard();
    scene.run_hard(1, 20);
    EXPECT_GT(scene.watch().collapses, 0);
    EXPECT_NEAR(scene.granules.position[0].z, 0.001, 1e-6);
    scene.run_hard(0.1, 10);
    EXPECT_NEAR(scene.watch().wall_force.z / (9.81 * scene.granules.mass[0]), 1, 0.02);
    EXPECT_LE(scene.watch().largest_overlap, 1e-9);
}

// What the columns and the memory do not hold must not matter: a second engine takes over.
void expect_that_another_goes_on_the_same(HardScene& scene)
{
    auto copy = scene.granules;
    dem::HardSpheres other(scene.settings, scene.options);
    other.resume(copy, scene.hard->memory());
    long const before = scene.watch().collisions + scene.watch().time_driven_steps;
    for (int k = 0; k < 20; ++k) {
        scene.run_hard(0.002);
        other.step(copy, 0.002);
    }
    EXPECT_GT(scene.watch().collisions + scene.watch().time_driven_steps, before + 100);
    for (std::size_t k = 0; k < copy.owned; ++k) {
        EXPECT_EQ(copy.position[k], scene.granules.position[k]) << k;
        EXPECT_EQ(copy.velocity[k], scene.granules.velocity[k]) << k;
        EXPECT_EQ(copy.spin[k], scene.granules.spin[k]) << k;
    }
}

TEST(HardPile, goes_on_in_another_engine_with_the_same_bits)
{
    for (double const until : {0.01, 0.15}) {
        HardScene scene({.restitution = 0.6, .sliding_friction = 0.3});
        scene.settings.gravity = {0, 0, -9.81};
        scene.enclose({}, {0.01, 0.01, 0.05});
        for (int k = 0; k < 48; ++k)
            scene.add({1.2e-3 + 2.4e-3 * (k % 4), 1.2e-3 + 2.4e-3 * (k / 4 % 4), 1.2e-3 + 2.4e-3 * (k / 16)},
                      {0.1 * std::sin(k), 0.1 * std::cos(k), 0}, 1e-3, 1000);
        scene.prepare_hard();
        scene.run_hard(until, 10);
        EXPECT_EQ(scene.hard->memory().packed_steps > 0, until > 0.1) << "in flight and in time-driven steps";
        expect_that_another_goes_on_the_same(scene);
    }
}

TEST(HardGas, goes_on_in_another_engine_that_knows_who_has_just_collided)
{
    auto scene = scene::hard_gas(8, 0.05, 0.01, {.restitution = 0.8, .sliding_friction = 0.2}, 4);
    scene.options.contact_time = 3e-3;
    scene.prepare_hard();
    scene.run_hard(0.01, 2);
    EXPECT_GT(scene.watch().kept_elastic, 10);
    expect_that_another_goes_on_the_same(scene);
}

// A ball that flies to and fro between two plates: each takes twice its momentum at every visit.
TEST(HardGas, tells_what_it_gives_to_each_wall)
{
    HardScene scene({.restitution = 1, .sliding_friction = 0});
    scene.add_plane({0, 0, 0}, {1, 0, 0});
    scene.add_plane({0.01, 0, 0}, {-1, 0, 0});
    scene.add({0.005, 0.002, 0}, {1, 0, 0}, 0.001, 1000);
    scene.prepare_hard();
    scene.run_hard(0.099, 7);  // 99 mm at 8 mm a crossing, the first after 4: six visits to each
    double const given = 2 * scene.granules.mass[0];
    auto const& loads = scene.watch().loads;
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_NEAR(loads[0].impulse.x / given, -6, 1e-12);
    EXPECT_NEAR(loads[1].impulse.x / given, 6, 1e-12);
    EXPECT_NEAR(loads[1].turn.z / given, -6 * 0.002, 1e-12) << "about the origin: -y times the impulse along x";
}
}
