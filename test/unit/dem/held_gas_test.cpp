// Granules in a held gas: relaxation, turning, added mass, impulses, and a state that knows nothing of how it was
// worked out.
#include "scene/held_gas.hpp"
#include "granum/base/random.hpp"
#include "scene/granules.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum;
using math::Vec3;

constexpr double g = 9.81, radius = 1e-3;
constexpr scene::Stuff soft{1e7, 0.25, 1445};

//! One granule in open space with all columns of the gas.
scene::Scene one(Vec3 const& velocity, Vec3 const& spin = {})
{
    scene::Scene scene(soft);
    scene.granules.keep({.added_mass = true, .turning = true});
    scene.settings.gravity = {0, 0, -g};
    scene.add({}, velocity, radius, soft.density, spin);
    return scene;
}

TEST(Drag, brings_a_granule_to_the_steady_speed_exactly_however_stiff)
{
    auto scene = one({});
    scene.granules.drag_rate[0] = 1e7;
    scene.granules.gas_velocity[0] = {0.5, 0, 1};
    scene.prepare();
    scene.run(50, 1e-3);
    EXPECT_NEAR(scene.granules.velocity[0].x, 0.5, 1e-12);
    EXPECT_NEAR(scene.granules.velocity[0].z, 1 - g / 1e7, 1e-12);
}

// m dv/dt + a dv/dt = G + m g + beta (u - v): v goes to u + (G + m g)/beta as exp(-beta t/(m + a)).
TEST(Drag, lets_a_granule_relax_to_the_stream_the_slower_the_more_gas_it_carries)
{
    double const time = 0.02;
    Vec3 const first{0.1, -0.2, 0.3}, stream{2, 1, 3}, force{1e-6, -2e-6, 3e-5};
    for (double const share : {0.0, 0.5}) {
        double error = 0;
        for (double const dt : {2e-5, 1e-5}) {
            auto scene = one(first);
            double const mass = scene.granules.mass[0], added = share * mass, beta = 100 * mass;
            scene.granules.drag_rate[0] = beta / (mass + added);
            scene.granules.added_mass[0] = added;
            scene.granules.gas_velocity[0] = stream;
            scene.granules.gas_force[0] = force;
            scene.prepare();
            scene.run(std::lround(time / dt), dt);
            Vec3 const steady = stream + (force + mass * scene.settings.gravity) / beta;
            Vec3 const exact = steady + std::exp(-beta * time / (mass + added)) * (first - steady);
            double const missed = norm(scene.granules.velocity[0] - exact) / norm(exact);
            EXPECT_LT(missed, 2 * beta * dt / mass);
            if (error > 0) {
                EXPECT_NEAR(error / missed, 2, 0.02) << "an error of first order";
            }
            error = missed;
        }
    }
}

TEST(Drag, ends_at_a_speed_that_depends_neither_on_the_step_nor_on_added_mass)
{
    for (double const dt : {1e-5, 1e-3, 1e-1})
        for (double const added : {0.0, 0.7}) {
            auto scene = one({1, 2, 3});
            double const mass = scene.granules.mass[0];
            scene.granules.added_mass[0] = added * mass;
            scene.granules.drag_rate[0] = 40 / (1 + added);
            scene.granules.gas_velocity[0] = {0.1, -0.2, 0.3};
            scene.prepare();
            scene.run(std::lround(std::max(2 / dt, 100.0)), dt);
            EXPECT_NEAR(scene.granules.velocity[0].x, 0.1, 1e-12);
            EXPECT_NEAR(scene.granules.velocity[0].y, -0.2, 1e-12);
            EXPECT_NEAR(scene.granules.velocity[0].z, 0.3 - g / 40, 1e-12) << "step " << dt << ", added mass " << added;
        }
}

TEST(AddedMass, lets_forces_of_gas_weight_and_contacts_accelerate_more)
{
    auto scene = one({});
    double const mass = scene.granules.mass[0];
    scene.granules.added_mass[0] = 0.25 * mass;
    scene.granules.gas_force[0] = {2 * mass, 0, 0};
    scene.prepare();
    scene.run(100, 1e-4);
    EXPECT_NEAR(scene.granules.velocity[0].x, 2 / 1.25 * 1e-2, 1e-15);
    EXPECT_NEAR(scene.granules.velocity[0].z, -g / 1.25 * 1e-2, 1e-15);
    EXPECT_EQ(scene.granules.drag_impulse[0], Vec3{});

    // An elastic impact on a plane takes as much longer as the root of what is moved (Hertz).
    double duration[2];
    for (int const heavier : {0, 1}) {
        auto bounce = scene::sphere_on_plane(soft, radius, {0, 0, -0.2}, {.restitution = 1, .sliding_friction = 0});
        bounce.granules.keep({.added_mass = true, .turning = true});
        bounce.granules.added_mass[0] = heavier * 3 * bounce.granules.mass[0];
        bounce.prepare();
        duration[heavier] = scene::run_impact(bounce, 1e-7).duration;
        EXPECT_NEAR(bounce.granules.velocity[0].z, 0.2, 1e-4);
    }
    // Of the sphere: 2.943 (15 m / (16 E* R^1/2 v^1/2))^(2/5).
    EXPECT_NEAR(duration[1] / duration[0], std::pow(4, 0.4), 1e-3);
}

// I dw/dt = gamma (W - w).
TEST(SpinDrag, turns_a_granule_to_the_spin_of_the_gas_and_tells_the_torque_impulse)
{
    double const rate = 150, time = 0.01;
    Vec3 const first{30, -20, 10}, stream{-5, 40, 7};
    double error = 0;
    for (double const dt : {2e-5, 1e-5}) {
        auto scene = one({}, first);
        scene.granules.gas_spin[0] = stream;
        scene.granules.spin_rate[0] = rate;
        scene.granules.spin_impulse[0] = {1e-9, 0, 0};
        scene.prepare();
        scene.run(std::lround(time / dt), dt);
        Vec3 const exact = stream + std::exp(-rate * time) * (first - stream);
        double const missed = norm(scene.granules.spin[0] - exact) / norm(exact);
        EXPECT_LT(missed, rate * dt);
        if (error > 0) {
            EXPECT_NEAR(error / missed, 2, 0.02) << "an error of first order";
        }
        error = missed;
        double const inertia = 0.4 * scene.granules.mass[0] * radius * radius;
        Vec3 const gained = inertia * (scene.granules.spin[0] - first), told = scene.granules.spin_impulse[0];
        EXPECT_LT(norm(told - Vec3{1e-9, 0, 0} - gained), 1e-13 * norm(gained));
        EXPECT_NEAR(scene.granules.velocity[0].z, -g * time, 1e-14) << "a spin of the gas does not lift";
        EXPECT_EQ(scene.granules.drag_impulse[0], Vec3{});
    }
}

TEST(SpinDrag, is_as_exact_as_the_round_off_however_stiff)
{
    auto scene = one({}, {1e3, 0, 0});
    scene.granules.gas_spin[0] = {0, 50, -3};
    scene.granules.spin_rate[0] = 1e9;
    scene.prepare();
    scene.run(20, 1e-4);
    EXPECT_LT(norm(scene.granules.spin[0] - scene.granules.gas_spin[0]), 1e-13);
}

// Spheres on a lattice in a periodic cube, agitated, each in a gas of its own; granule k has id k.
scene::Scene crowd(int edge, std::uint64_t step = 1)
{
    scene::Scene scene(soft, {.restitution = 0.7, .sliding_friction = 0.4, .rolling_friction = 0.05});
    scene.granules.keep({.added_mass = true, .turning = true});
    double const spacing = 2.06 * radius, size = edge * spacing;
    scene.settings.gravity = {1, -2, -g};
    scene.settings.lower = {};
    scene.settings.upper = {size, size, size};
    scene.settings.periodic = {true, true, true};
    scene.slabs = {.origin = 0, .width = size, .periodic = true};
    auto const count = static_cast<std::uint64_t>(edge * edge * edge);
    for (std::uint64_t n = 0; n < count; ++n) {
        std::uint64_t const id = n * step % count;
        base::Random random(4, base::Purpose::test, id, 0);
        auto const k = static_cast<int>(id);
        Vec3 const at{(k % edge + 0.5) * spacing, (k / edge % edge + 0.5) * spacing, (k / edge / edge + 0.5) * spacing};
        auto const row = scene.add(at, 0.3 * Vec3{random.normal(), random.normal(), random.normal()}, radius,
                                   soft.density, 50 * Vec3{random.normal(), random.normal(), random.normal()});
        scene.granules.id[row] = id;
    }
    scene::blow_at_random(scene.granules);
    return scene;
}

TEST(Impulses, of_a_crowd_are_what_the_gas_changed_of_its_momentum)
{
    auto scene = crowd(7);
    auto const& granules = scene.granules;
    auto const momentum = [&] {
        Vec3 sum;
        for (std::size_t row = 0; row < granules.owned; ++row)
            sum += (granules.mass[row] + granules.added_mass[row]) * granules.velocity[row];
        return sum;
    };
    scene.prepare();
    Vec3 const before = momentum();
    double const dt = 8e-6, step_time = 40 * dt;
    Vec3 told, held;
    double moved = 0;
    for (int interval = 0; interval < 25; ++interval) {
        for (std::size_t row = 0; row < granules.owned; ++row) {
            held += step_time * (granules.gas_force[row] + granules.mass[row] * scene.settings.gravity);
            told -= granules.drag_impulse[row];
            moved += norm(granules.mass[row] * granules.velocity[row]) / 25;
        }
        scene.run(40, dt);
        for (std::size_t row = 0; row < granules.owned; ++row) told += granules.drag_impulse[row];
    }
    EXPECT_GT(scene.engine->watch().dissipated.value(), 0);
    EXPECT_GT(scene.engine->watch().rebuilds, 3);
    EXPECT_GT(norm(told), 0.1 * moved);
    EXPECT_LT(norm(momentum() - before - held - told), 1e-13 * moved);
}

TEST(Impulses, of_granules_without_drag_stay_as_they_are)
{
    auto scene = crowd(5);
    for (std::size_t row = 0; row < scene.granules.owned; ++row)
        if (scene.granules.drag_rate[row] == 0) scene.granules.drag_impulse[row] = {1, 2, 3};
    scene.prepare();
    scene.run(500, 8e-6);
    long still = 0;
    for (std::size_t row = 0; row < scene.granules.owned; ++row) {
        if (scene.granules.drag_rate[row] != 0) continue;
        ++still;
        EXPECT_EQ(scene.granules.drag_impulse[row], (Vec3{1, 2, 3}));
    }
    EXPECT_GT(still, 5);
    EXPECT_GT(scene.engine->watch().rebuilds, 1);
}

TEST(FrozenGranules, stay_and_still_tell_what_the_gas_gives)
{
    auto scene = one({});
    scene.granules.position[0] = {0.1, 0, 0};
    scene.granules.added_mass[0] = scene.granules.mass[0];
    scene.granules.drag_rate[0] = 10;
    scene.granules.gas_velocity[0] = {0, 0, 2};
    scene.granules.spin_rate[0] = 5;
    scene.granules.gas_spin[0] = {7, 0, 0};
    scene.settings.frozen = true;
    scene.prepare();
    scene.run(100, 1e-4);
    double const mass = scene.granules.mass[0];
    EXPECT_EQ(scene.granules.position[0], (Vec3{0.1, 0, 0}));
    EXPECT_NEAR(scene.granules.drag_impulse[0].z / (2 * mass * 10 * 2 * 1e-2), 1, 1e-14);
    EXPECT_NEAR(scene.granules.spin_impulse[0].x / (0.4 * mass * radius * radius * 5 * 7 * 1e-2), 1, 1e-14);
}

// Granules whose state or impulses differ in any bit.
long differing(scene::Scene const& a, scene::Scene const& b)
{
    long out = 0;
    for (std::size_t row = 0; row < a.granules.owned; ++row) {
        auto const other = b.row(a.granules.id[row]);
        auto const same = [&](auto const& column, auto const& others) { return column[row] == others[other]; };
        auto const &x = a.granules, &y = b.granules;
        out += !(same(x.position, y.position) && same(x.velocity, y.velocity) && same(x.spin, y.spin) &&
                 same(x.drag_impulse, y.drag_impulse) && same(x.spin_impulse, y.spin_impulse));
    }
    return out;
}

TEST(HeldGas, leaves_a_state_in_which_the_order_of_rows_and_the_list_are_not_seen)
{
    auto first = crowd(7), shuffled = crowd(7, 197), often = crowd(7);
    often.settings.skin = 0.03 * radius;
    for (auto* scene : {&first, &shuffled, &often}) {
        scene->prepare();
        for (int interval = 0; interval < 20; ++interval) scene->run(50, 8e-6);
    }
    EXPECT_GT(often.engine->watch().rebuilds, 2 * first.engine->watch().rebuilds);
    EXPECT_EQ(first.engine->watch().late_lists + often.engine->watch().late_lists, 0);
    EXPECT_EQ(differing(first, shuffled), 0) << "of 343 granules";
    EXPECT_EQ(differing(first, often), 0) << "of 343 granules";
}

TEST(HeldGas, goes_on_with_the_same_bits_from_a_saved_state)
{
    auto scene = crowd(6), copy = crowd(6);
    scene.prepare();
    scene.run(300, 8e-6);
    copy.granules = scene.granules;
    copy.engine = std::make_unique<dem::Engine>(copy.settings, copy.slabs, copy.comm);
    auto const saved = scene.engine->save_contacts();
    EXPECT_GT(saved.size(), 50u);
    copy.engine->resume(copy.granules, saved);
    for (auto* one : {&scene, &copy}) one->run(300, 8e-6);
    EXPECT_EQ(differing(scene, copy), 0) << "of 216 granules";
}

TEST(HeldGas, moves_granules_that_do_not_touch_to_the_same_bits_in_every_kernel)
{
    std::vector<scene::Scene> scenes;
    for (auto const* kernel : dem::kernel::kernels()) {
        auto& scene = scenes.emplace_back(crowd(5));
        scene.settings.kernel = std::string(kernel->name);
        scene.settings.periodic = {};
        for (auto& at : scene.granules.position.values) at *= 5;
        scene.settings.upper *= 5;
        scene.prepare();
        scene.run(500, 8e-6);
        EXPECT_EQ(scene.engine->watch().dissipated.value(), 0);
        EXPECT_EQ(differing(scenes.front(), scene), 0) << kernel->name;
    }
}

TEST(HeldGas, lets_a_call_begin_with_a_sweep_and_no_list_be_late_when_all_becomes_faster)
{
    auto scene = crowd(7);
    scene.prepare();
    scene.run(12, 1e-6);
    EXPECT_EQ(scene.engine->watch().sweeps, 2);
    auto& granules = scene.granules;
    auto const too_late = [&] { return scene.engine->watch().late_lists; };
    for (std::size_t row = 0; row < granules.owned; ++row) granules.velocity[row] *= 20;
    scene.run(12, 1e-6);
    EXPECT_EQ(too_late(), 0) << "velocities changed from outside";
    for (std::size_t row = 0; row < granules.owned; ++row) {
        granules.velocity[row] = {};
        granules.drag_rate[row] = 1e8;
        granules.gas_velocity[row] = {20, 0, 0};
    }
    scene.run(12, 1e-6);
    EXPECT_EQ(too_late(), 0) << "a stiff drag began";
    scene.run(12, 2e-5);
    EXPECT_EQ(too_late(), 0) << "a longer step";
}
}
