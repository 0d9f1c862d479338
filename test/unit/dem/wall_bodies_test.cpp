// Granules and wall bodies: triangles are the surfaces that they make up, walls that move do what their motion says,
// and what a wall receives is what granules gave.
#include "scene/granules.hpp"
#include "scene/meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;
using namespace granum::scene;
using geometry::Body;
using particle::Id;

namespace
{
constexpr double radius = 1e-3;

Stuff const soft{1e7, 0.25, 2000};

Scene on(std::vector<Body> walls, dem::PairProperties const& properties = {0.6, 0.3, 0.0})
{
    Scene scene(soft, properties);
    scene.settings.gravity = {0, 0, -9.81};
    for (auto& wall : walls) wall.material = 1;
    scene.settings.walls = std::move(walls);
    return scene;
}

Body plane_at(double z)
{
    return {.name = "plane", .shapes = {geometry::Plane{{0, 0, z}, {0, 0, 1}}}};
}

//! Lets a sphere settle on the walls below it, then pushes it along.
void settle_and_push(Scene& scene, Vec3 const& velocity, double dt)
{
    scene.prepare();
    for (int k = 0; k < 10; ++k) {
        scene.run(400, dt);
        scene.granules.velocity[0] = {};
        scene.granules.spin[0] = {};
    }
    scene.granules.velocity[0] = velocity;
}
}

TEST(SphereOverATriangleMesh, slides_over_a_hundred_coplanar_triangles_as_on_a_plane)
{
    // 100 triangles: 25 by 2 cells, two each, four radii wide.
    double const dt = 2e-6, speed = 1.0;
    Vec3 const from{4 * radius, 4.1 * radius, 0.999 * radius};
    auto mesh = jittered_sheet({0, 0, 0}, {100 * radius, 0, 0}, {0, 8 * radius, 0}, 25, 2);
    ASSERT_EQ(mesh.triangles.size(), 100u);
    for (double const friction : {0.0, 0.3}) {
        dem::PairProperties const properties{0.6, friction, 0};
        auto rough = on({{.name = "mesh", .shapes = {mesh}}}, properties), plain = on({plane_at(0)}, properties);
        for (auto* scene : {&rough, &plain}) {
            scene->add(from, {}, radius, 2000);
            settle_and_push(*scene, {speed, 0.01, 0}, dt);
        }
        double kick = 0;
        for (int k = 0; k < 450; ++k) {
            rough.run(100, dt);
            plain.run(100, dt);
            kick = std::max(kick, std::abs(rough.granules.velocity[0].z));
        }
        auto const &a = rough.granules, &b = plain.granules;
        EXPECT_GT(a.position[0].x, 60 * radius) << "it did not get far";
        EXPECT_LT(kick, 1e-6 * speed) << "friction " << friction;
        EXPECT_NEAR(a.velocity[0].x, b.velocity[0].x, 1e-9 * speed) << "friction " << friction;
        EXPECT_NEAR(a.spin[0].y, b.spin[0].y, 1e-6) << "friction " << friction;
    }
}

TEST(SphereOverATriangleMesh, glides_across_periodic_faces_where_the_mesh_ends_and_begins)
{
    double const dt = 2e-6, speed = 1.0, length = 20 * radius;
    auto scene = on({{.name = "mesh", .shapes = {jittered_sheet({0, 0, 0}, {length, 0, 0}, {0, 8 * radius, 0}, 5, 2)}}},
                    {0.6, 0.0, 0});
    scene.settings.lower = {0, -1, -1};
    scene.settings.upper = {length, 1, 1};
    scene.settings.periodic = {true, false, false};
    scene.settings.skin = radius;
    scene.slabs = {.origin = 0, .width = length, .periodic = true};
    scene.add({4 * radius, 4.1 * radius, 0.999 * radius}, {}, radius, 2000);
    settle_and_push(scene, {speed, 0.01, 0}, dt);
    double kick = 0;
    int crossings = 0;
    for (int k = 0; k < 300; ++k) {
        double const before = scene.granules.position[0].x;
        scene.run(100, dt);
        crossings += scene.granules.position[0].x < before;
        kick = std::max(kick, std::abs(scene.granules.velocity[0].z));
    }
    EXPECT_EQ(crossings, 3);
    EXPECT_LT(kick, 1e-6 * speed);
}

TEST(SphereOverATriangleMesh, lost_by_friction_what_the_law_says)
{
    double const dt = 2e-6, friction = 0.1;
    auto scene = on({{.name = "mesh", .shapes = {jittered_sheet({0, 0, 0}, {0.1, 0, 0}, {0, 0.01, 0}, 25, 2)}}},
                    {0.6, friction, 0});
    scene.add({4e-3, 4.1e-3, 0.999 * radius}, {}, radius, 2000);
    settle_and_push(scene, {1, 0, 0}, dt);
    scene.run(20000, dt);  // 0.04 s: slides on until 2/7 of the speed is lost, at 0.29 s
    EXPECT_NEAR(scene.granules.velocity[0].x, 1 - friction * 9.81 * 0.04, 1e-5);
}

TEST(SphereOverATriangleMesh, keeps_its_tangential_spring_from_triangle_to_triangle)
{
    // Rolling down a slope: the spring holds two sevenths of the pull, on every triangle.
    double const dt = 2e-6;
    auto rough = on({{.name = "mesh", .shapes = {jittered_sheet({0, 0, 0}, {0.05, 0, 0}, {0, 0.008, 0}, 50, 2)}}});
    auto plain = on({plane_at(0)});
    for (auto* scene : {&rough, &plain}) {
        scene->settings.gravity = {1, 0, -9.81};
        scene->add({4e-3, 4.1e-3, 0.999 * radius}, {}, radius, 2000);
        settle_and_push(*scene, {0.2, 0.005, 0}, dt);
        scene->granules.spin[0] = {-0.005 / radius, 0.2 / radius, 0};
    }
    double largest = 0;
    for (int k = 0; k < 300; ++k) {
        for (auto* scene : {&rough, &plain}) scene->run(200, dt);
        auto const a = rough.engine->save_contacts(), b = plain.engine->save_contacts();
        ASSERT_EQ(a.size(), 1u);
        ASSERT_EQ(b.size(), 1u);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[0].history[c], b[0].history[c], 1e-6 * radius * 1e-3);
        largest = std::max(largest, std::abs(b[0].history[0]));
    }
    EXPECT_GT(largest, 1e-6 * radius) << "there was no spring to compare";
    EXPECT_GT(rough.granules.position[0].x, 20 * radius);
}

TEST(FacettedCylinder, lets_a_sphere_swing_as_the_cylinder_does)
{
    double const drum = 20 * radius, dt = 4e-6;
    auto facets = on({{.name = "mesh", .shapes = {cylinder_mesh(drum, -0.01, 0.01, 720)}}}, {0.9, 0.5, 0});
    auto smooth = on({{.name = "drum",
                       .shapes = {geometry::Frustum{.base = {0, 0, -0.01},
                                                    .length = 0.02,
                                                    .base_radius = drum,
                                                    .top_radius = drum,
                                                    .side = geometry::Side::inside}}}},
                     {0.9, 0.5, 0});
    for (auto* scene : {&facets, &smooth}) {
        scene->settings.gravity = {9.81, 0, 0};  // across the axis
        scene->add({(drum - radius) * std::cos(0.5), (drum - radius) * std::sin(0.5), 0}, {}, radius, 2000);
        scene->prepare();
        scene->run(40000, dt);  // most of a swing
    }
    EXPECT_NEAR(facets.granules.position[0].y, smooth.granules.position[0].y, 0.02 * drum);
    EXPECT_LT(smooth.granules.position[0].y, 0) << "it should have swung to the other side";
    double const away = std::hypot(facets.granules.position[0].x, facets.granules.position[0].y);
    EXPECT_NEAR(away, drum - radius, 0.02 * radius);
}

TEST(LoadsOnWalls, are_the_weight_of_a_bed_at_rest_in_a_box_of_triangles_and_of_planes)
{
    Vec3 const lower{0, 0, 0}, upper{8 * radius, 8 * radius, 40 * radius};
    for (bool const triangles : {true, false}) {
        auto scene = on({{.name = "box",
                          .shapes = triangles ? std::vector<geometry::Shape>{box_mesh(lower, upper)}
                                              : geometry::box_inside(lower, upper)}},
                        {0.3, 0.3, 0.0});
        double mass = 0;
        for (int k = 0; k < 48; ++k) {
            double const x = 1.6 + 1.5 * (k % 4), y = 1.6 + 1.5 * (k / 4 % 4), z = 1.5 + 2.3 * (k / 16);
            auto const row = scene.add({x * radius + 1e-5 * std::sin(k), y * radius * 1.01, z * radius}, {},
                                       radius * (k % 3 == 0 ? 0.7 : 0.65), 2000);
            mass += scene.granules.mass[row];
        }
        scene.prepare();
        for (int k = 0; k < 60; ++k) {
            scene.run(500, 4e-6);
            for (auto& v : scene.granules.velocity.values) v *= 0.5;
            for (auto& w : scene.granules.spin.values) w *= 0.5;
        }
        Vec3 momentum_before, momentum_after, given;
        auto const momentum = [&] {
            Vec3 sum;
            for (std::size_t row = 0; row < scene.granules.owned; ++row)
                sum += scene.granules.mass[row] * scene.granules.velocity[row];
            return sum;
        };
        // Each step changes the momentum by weight and wall loads alone, the mean of the loads at both its ends.
        double const dt = 4e-6;
        momentum_before = momentum();
        Vec3 last = scene.engine->wall_loads()[0].force;
        int const steps = 200;
        for (int k = 0; k < steps; ++k) {
            scene.run(1, dt);
            Vec3 const now = scene.engine->wall_loads()[0].force;
            given += (-0.5 * dt) * (last + now);
            last = now;
        }
        momentum_after = momentum();
        Vec3 const weight{0, 0, -9.81 * mass};
        Vec3 const off = momentum_after - momentum_before - given - (steps * dt) * weight;
        EXPECT_LT(norm(off), 1e-9 * norm(weight) * steps * dt) << (triangles ? "triangles" : "planes");
        EXPECT_NEAR(last.z / weight.z, 1, 0.01);
    }
}

TEST(RotatingPlane, gives_a_sphere_the_velocity_of_its_surface)
{
    double const rate = 5, dt = 2e-6;
    Body turntable = plane_at(0);
    turntable.motions = {geometry::Rotation{.point = {}, .axis = {0, 0, 1}, .rate = rate}};
    auto scene = on({turntable});
    // One let go without rolling is dragged along until it rolls.
    scene.add({0.02, 0, 0.9995 * radius}, {}, radius, 2000);
    scene.prepare();
    scene.run(100, dt);
    EXPECT_GT(scene.granules.velocity[0].y, 1e-4);
    scene.run(40000, dt);
    // When sliding has ended the lowest point moves with the surface below it.
    auto const& g = scene.granules;
    Vec3 const lowest = g.velocity[0] + cross(g.spin[0], Vec3{0, 0, -radius});
    Vec3 const surface = cross(Vec3{0, 0, rate}, g.position[0]);
    EXPECT_LT(norm(lowest - surface), 0.01 * norm(surface));
}

TEST(RotationInPlace, keeps_the_neighbour_list)
{
    Body turntable = plane_at(0);
    turntable.motions = {geometry::Rotation{.point = {}, .axis = {0, 0, 1}, .rate = 1000}};
    auto scene = on({turntable});
    scene.settings.gravity = {};
    scene.add({0.02, 0, 1.01 * radius}, {}, radius, 2000);
    scene.prepare();
    scene.run(1000, 1e-5);
    EXPECT_EQ(scene.engine->watch().rebuilds, 1);
}

TEST(TranslatingWall, pushes_a_sphere_off_at_its_restitution)
{
    double const e = 0.8, speed = 0.5;
    Body piston = plane_at(0);
    piston.motions = {geometry::Translation{{0, 0, speed}}};
    auto scene = on({piston}, {e, 0.3, 0});
    scene.settings.gravity = {};
    scene.add({0, 0, 3 * radius}, {}, radius, 2000);
    scene.prepare();
    scene.run(10000, 1e-6);
    EXPECT_NEAR(scene.granules.velocity[0].z, (1 + e) * speed, 0.005 * (1 + e) * speed);
    EXPECT_GT(scene.engine->watch().rebuilds, 1) << "the piston left its place";
}

TEST(VibratingPlate, throws_a_sphere_to_the_height_of_its_take_off)
{
    // A plate that rises by 4 mm in a half period at 25 Hz: the sphere leaves where the plate slows down by g, with the
    // speed and at the height of the plate there.
    double const amplitude = 2e-3, frequency = 25, omega = 2 * math::pi * frequency, dt = 1e-6;
    Body plate{.name = "plate", .shapes = {geometry::Disc{.centre = {}, .normal = {0, 0, 1}, .radius = 0.01}}};
    plate.motions = {geometry::Vibration{{0, 0, 1}, amplitude, frequency, -0.5 * math::pi, {}}};
    auto scene = on({plate}, {0.1, 0.3, 0});
    scene.add({0, 0, 0.9999 * radius}, {}, radius, 2000);
    scene.prepare();
    double highest = 0;
    for (int k = 0; k < 900; ++k) {
        scene.run(50, dt);
        highest = std::max(highest, scene.granules.position[0].z);
    }
    double const sine = 9.81 / (amplitude * omega * omega);  // of the phase at take-off
    double const speed = amplitude * omega * std::sqrt(1 - sine * sine);
    double const height = radius + amplitude * (1 + sine) + speed * speed / (2 * 9.81);
    EXPECT_NEAR(highest - radius, height - radius, 0.02 * (height - radius));
}

TEST(Servo, presses_a_packing_with_the_wanted_pressure)
{
    double const width = 8 * radius, wanted = 300;
    Vec3 const lower{0, 0, 0}, upper{width, width, 1};
    auto shapes = geometry::box_inside(lower, upper);
    Body lid{.name = "lid", .shapes = {geometry::Plane{{0, 0, 10.5 * radius}, {0, 0, -1}}}};
    lid.motions = {
        geometry::Servo{.direction = {0, 0, -1}, .pressure = wanted, .area = width * width, .fastest = 0.05}};
    auto scene = on({{.name = "box", .shapes = shapes}, lid}, {0.3, 0.3, 0.0});
    scene.settings.gravity = {};
    for (int k = 0; k < 64; ++k)
        scene.add({(1 + 2 * (k % 4) + 1e-2 * std::sin(k)) * radius, (1 + 2 * (k / 4 % 4)) * radius,
                   (1 + 2 * (k / 16)) * radius},
                  {}, 0.97 * radius, 2000);
    scene.prepare();
    scene.run(60000, 4e-6);
    auto const loads = scene.engine->wall_loads();
    EXPECT_NEAR(loads[1].force.z / (width * width), wanted, 0.005 * wanted);
    EXPECT_NEAR(norm(loads[0].force + loads[1].force), 0, 0.005 * norm(loads[1].force));
    EXPECT_GT(scene.engine->servos()[1].travelled, radius);
    EXPECT_LT(std::abs(scene.engine->servos()[1].speed), 0.01 * 0.05);
}

TEST(HistoryByBody, goes_on_over_edges_of_triangles_and_is_apart_in_corners)
{
    // A sphere at rest in the corner of a box, pushed so that all three springs are loaded.
    auto scene = on({{.name = "box", .shapes = {box_mesh({0, 0, 0}, {0.01, 0.01, 0.01})}}});
    scene.settings.gravity = {-3, -4, -9};
    scene.add({0.999 * radius, 0.998 * radius, 0.999 * radius}, {}, radius, 2000);
    settle_and_push(scene, {}, 2e-6);
    auto const records = scene.engine->save_contacts();
    ASSERT_EQ(records.size(), 3u);
    EXPECT_NE(records[0].high, records[1].high);
    for (auto const& record : records) EXPECT_EQ(record.high >> 63, 1u);
}

TEST(RestartWithMovingWalls, goes_on_with_the_same_bits)
{
    double const dt = 4e-6;
    Body drum{.name = "drum", .shapes = {cylinder_mesh(8 * radius, -0.004, 0.004, 24)}};
    drum.motions = {geometry::Rotation{.point = {}, .axis = {0, 0, 1}, .rate = 20},
                    geometry::Vibration{{1, 0, 0}, 1e-4, 100, 0, {}}};
    Body lid{.name = "lid", .shapes = {geometry::Disc{.centre = {0, 0, 0.004}, .normal = {0, 0, 1}, .radius = 0.02}}};
    lid.motions = {geometry::Servo{.direction = {0, 0, -1}, .pressure = 50, .area = 2e-4, .fastest = 0.02}};
    Body floor{.name = "floor", .shapes = {geometry::Plane{{0, 0, -0.003}, {0, 0, 1}}}};
    auto scene = on({drum, lid, floor});
    scene.settings.gravity = {9.81, 0, -2};
    for (int k = 0; k < 40; ++k)
        scene.add({(k % 5 - 2) * 2.1 * radius, (k / 5 % 4 - 1.5) * 2.1 * radius, (k / 20 - 0.5) * 2.1 * radius}, {},
                  radius, 2000);
    scene.prepare();
    auto const touches_drum = [&] {
        for (auto const& record : scene.engine->save_contacts())
            if (record.high >> 40 == Id{1} << 23) return true;
        return false;
    };
    for (int k = 0; k < 1000 && !touches_drum(); ++k) scene.run(20, dt);
    ASSERT_TRUE(touches_drum());

    auto copy = on({drum, lid, floor});
    copy.settings.gravity = scene.settings.gravity;
    copy.granules = scene.granules;
    copy.engine = std::make_unique<dem::Engine>(copy.settings, copy.slabs, copy.comm);
    copy.engine->set_clock(scene.engine->time(), scene.engine->servos());
    auto const saved = scene.engine->save_contacts();
    copy.engine->resume(copy.granules, saved);
    int turned = 0;
    for (int k = 0; k < 100; ++k) {
        for (auto* one : {&scene, &copy}) one->run(100, dt);
        EXPECT_EQ(scene.engine->wall_loads(), copy.engine->wall_loads());
        turned += scene.engine->wall_loads()[0].torque.z != 0;
    }
    EXPECT_GT(turned, 10) << "the drum should have been touched";
    for (std::size_t a = 0; a < 40; ++a)
        for (std::size_t b = 0; b < 40; ++b)
            if (scene.granules.id[a] == copy.granules.id[b]) {
                EXPECT_EQ(scene.granules.position[a], copy.granules.position[b]);
                EXPECT_EQ(scene.granules.spin[a], copy.granules.spin[b]);
            }
    EXPECT_EQ(scene.engine->servos(), copy.engine->servos());
}

TEST(DirectionCode, keeps_a_direction_and_its_own_code)
{
    for (int k = 0; k < 10000; ++k) {
        Vec3 v{std::sin(1.0 * k), std::sin(1.7 * k + 1), std::sin(2.9 * k + 2)};
        if (k < 27) v = {k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
        if (norm(v) == 0) continue;
        v = v / norm(v);
        auto const code = dem::code_of(v);
        EXPECT_LT(norm(dem::direction_of(code) - v), 6e-6);
        EXPECT_LT(norm(dem::direction_of(dem::code_of(dem::direction_of(code))) - dem::direction_of(code)), 1e-15);
        EXPECT_EQ(code >> 40, 0u);
    }
}
