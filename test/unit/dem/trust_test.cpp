// What the granule engine owes whatever the granules do: momentum, energy, and contacts that remember.
#include "granum/base/random.hpp"
#include "scene/granules.hpp"

#include <gtest/gtest.h>

#include <map>

namespace
{
using namespace granum;
using math::Vec3;

constexpr scene::Stuff soft{1e7, 0.25, 1445};
constexpr double radius = 1e-3;

// Spheres on a lattice in a periodic cube that flies, turning and agitated at random.
scene::Scene periodic_gas(int edge, double solids, double speed, dem::PairProperties const& properties)
{
    scene::Scene scene(soft, properties);
    double const spacing = 2 * radius * std::cbrt(math::pi / (6 * solids)), size = edge * spacing;
    scene.settings.lower = {};
    scene.settings.upper = {size, size, size};
    scene.settings.periodic = {true, true, true};
    scene.slabs = {.origin = 0, .width = size, .periodic = true};
    for (int k = 0; k < edge * edge * edge; ++k) {
        base::Random random(3, base::Purpose::test, static_cast<std::uint64_t>(k), 0);
        auto const draw = [&] { return Vec3{random.normal(), random.normal(), random.normal()}; };
        Vec3 const at{(k % edge + 0.5) * spacing, (k / edge % edge + 0.5) * spacing, (k / edge / edge + 0.5) * spacing};
        Vec3 const velocity = speed * draw(), spin = (speed / radius) * draw();
        scene.add(at, velocity + Vec3{0.3, -0.2, 0.1}, radius, soft.density, spin);
    }
    return scene;
}

TEST(Momentum, of_a_rubbing_and_rolling_crowd_in_a_periodic_box_is_kept_to_round_off)
{
    auto scene = periodic_gas(7, 0.45, 0.5, {.restitution = 0.7, .sliding_friction = 0.5, .rolling_friction = 0.1});
    scene.prepare();
    Vec3 const before = scene.momentum();
    double moving = 0;
    for (std::size_t row = 0; row < scene.granules.owned; ++row)
        moving += scene.granules.mass[row] * norm(scene.granules.velocity[row]);
    scene.run(5000, 8e-6);
    EXPECT_GT(scene.engine->watch().dissipated.value(), 0.1 * moving * moving / scene.granules.mass[0] / 343 / 2);
    EXPECT_LT(norm(scene.momentum() - before) / moving, 1e-13);
}

TEST(EnergyLedger, of_an_elastic_gas_closes_over_a_hundred_thousand_steps)
{
    auto scene = periodic_gas(6, 0.2, 0.3, {.restitution = 1, .sliding_friction = 0});
    for (auto& spin : scene.granules.spin.values) spin = {};
    scene.prepare();
    double const before = scene.kinetic_energy();
    double const contact =
        scene::hertz_time(0.5 * soft.youngs_modulus / (1 - 0.0625), radius / 2, scene.granules.mass[0] / 2, 0.7);
    double farthest = 0;
    for (int round = 0; round < 100; ++round) {
        scene.run(1000, contact / 50);
        auto const& watch = scene.engine->watch();
        farthest = std::max(
            farthest,
            std::abs((scene.kinetic_energy() + watch.elastic.value() + watch.dissipated.value()) / before - 1));
    }
    EXPECT_LT(farthest, 1e-4);
}

// A sphere that slides and rolls down from another, which stands on a slippery floor; both glide along x with `drift`.
// Seen from the lower sphere, nothing depends on the drift, however often it takes them across periodic sides.
struct Pair
{
    Vec3 apart, velocity, spin;  //!< of the upper sphere, seen from the lower
};
Pair slide_down(double drift)
{
    scene::Scene scene(soft, {.restitution = 0.5, .sliding_friction = 0.4, .rolling_friction = 0.05});
    double const size = 8 * radius;
    scene.settings.gravity = {0, 0, -9.81};
    scene.settings.lower = {};
    scene.settings.upper = {size, size, size};
    scene.settings.periodic = {true, true, false};
    scene.settings.laws.pair(0, 1, {.restitution = 0.5, .sliding_friction = 0});
    scene.slabs = {.origin = 0, .width = size, .periodic = true};
    scene.add_plane({0, 0, 0}, {0, 0, 1});
    double const lean = 0.3, reach = 2 * radius * 0.9999;
    Vec3 const low{4 * radius, 4 * radius, radius * 0.9999};
    scene.add(low, {drift, 0, 0}, radius, soft.density);
    scene.add(low + Vec3{reach * std::sin(lean) * 0.6, reach * std::sin(lean) * 0.8, reach * std::cos(lean)},
              {drift, 0, 0}, radius, soft.density);
    scene.prepare();
    scene.run(3000, 5e-6);
    auto const lower = scene.row(0), upper = scene.row(1);
    Vec3 apart = scene.granules.position[upper] - scene.granules.position[lower];
    for (std::size_t d = 0; d < 2; ++d) apart[d] -= size * std::round(apart[d] / size);
    return {apart, scene.granules.velocity[upper] - Vec3{drift, 0, 0}, scene.granules.spin[upper]};
}

TEST(ContactHistory, of_a_long_slide_is_carried_across_periodic_sides)
{
    Pair const still = slide_down(0), moving = slide_down(4.0);  // 60 radii: across the box seven times
    EXPECT_GT(norm(still.spin) * radius, 1e-3);
    EXPECT_NEAR(norm(moving.apart - still.apart) / radius, 0, 1e-9);
    EXPECT_NEAR(norm(moving.velocity - still.velocity), 0, 1e-9);
    EXPECT_NEAR(norm(moving.spin - still.spin) * radius, 0, 1e-9);
}

// A heap of spheres of two sizes that falls together, its granules named 0, 1, ... and added in `order`.
scene::Scene heap(std::vector<std::uint64_t> const& order)
{
    scene::Scene scene(soft, {.restitution = 0.6, .sliding_friction = 0.4, .rolling_friction = 0.05});
    scene.settings.gravity = {1, 2, -9.81};
    scene.enclose({0, 0, 0}, {0.024, 0.024, 0.04});
    for (auto const id : order) {
        base::Random random(9, base::Purpose::test, id, 0);
        int const k = static_cast<int>(id);
        Vec3 const at{(k % 8 + 0.5) * 3e-3, (k / 8 % 8 + 0.5) * 3e-3, (k / 64 + 0.5) * 3e-3};
        auto const row = scene.add(at, 0.2 * Vec3{random.normal(), random.normal(), random.normal()},
                                   id % 2 == 0 ? radius : 0.6 * radius, soft.density);
        scene.granules.id[row] = id;
    }
    return scene;
}

// As when others are added or taken out: those that touch meanwhile keep the springs that they have strained.
TEST(ContactHistory, survives_that_the_granules_are_taken_over_anew)
{
    auto scene = periodic_gas(4, 0.5, 0.05, {.restitution = 0.7, .sliding_friction = 10});  // none slides
    scene.prepare();
    double const dt = 2e-6;
    while (scene.engine->contacts().size() < 20) scene.run(20, dt);
    std::map<std::pair<dem::Id, dem::Id>, double> before;
    auto const strain = [](dem::Contact const& contact) { return contact.history[0]; };
    for (auto const& contact : scene.engine->contacts()) before[{contact.low, contact.high}] = strain(contact);
    scene.engine->prepare(scene.granules);
    int strained = 0;
    for (auto const& contact : scene.engine->contacts()) {
        auto const found = before.find({contact.low, contact.high});
        ASSERT_NE(found, before.end());
        EXPECT_NEAR(strain(contact), found->second, 1e-6 * std::abs(found->second));
        strained += found->second != 0;
    }
    EXPECT_GT(strained, 10);
}

TEST(Materials, are_told_apart_by_what_they_are_not_by_their_number)
{
    std::vector<std::uint64_t> order(512);
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    auto first = heap(order), third = heap(order);
    auto& laws = third.settings.laws;
    auto const properties = laws.pair(0, 0);
    laws.add(laws.materials[0]);
    for (std::uint32_t other : {1u, 2u}) laws.pair(other, 2, properties);
    laws.pair(0, 0, {.restitution = 0.1});
    for (auto& material : third.granules.material.values) material = 2;
    for (auto* scene : {&first, &third}) {
        scene->prepare();
        scene->run(5000, 1e-5);
    }
    EXPECT_GT(first.engine->watch().contacts, 50);
    for (std::size_t row = 0; row < order.size(); ++row)
        EXPECT_EQ(norm(first.granules.position[row] - third.granules.position[row]), 0) << row;
}

TEST(InputOrder, of_granules_changes_not_a_bit)
{
    std::vector<std::uint64_t> sorted(512), shuffled;
    for (std::size_t k = 0; k < sorted.size(); ++k) sorted[k] = k;
    for (std::size_t k = 0; k < sorted.size(); ++k) shuffled.push_back((k * 197 + 31) % 512);
    auto first = heap(sorted), second = heap(shuffled);
    first.prepare(), second.prepare();
    first.run(4000, 6e-6), second.run(4000, 6e-6);
    long different = 0;
    for (auto const id : sorted) {
        auto const a = first.row(id), b = second.row(id);
        different += !(first.granules.position[a] == second.granules.position[b] &&
                       first.granules.velocity[a] == second.granules.velocity[b] &&
                       first.granules.spin[a] == second.granules.spin[b]);
    }
    EXPECT_EQ(different, 0) << "of 512 granules";
}
}
