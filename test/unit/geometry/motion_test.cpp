// Motion of walls: the pose is a function of time, and the surface velocity is its derivative.
#include "granum/geometry/body.hpp"

#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum::geometry;
using granum::math::pi;

namespace
{
void expect_near(Vec3 const& a, Vec3 const& b, double tolerance = 1e-14)
{
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(a[d], b[d], tolerance) << "component " << d;
}

Pose pose_of(std::vector<Motion> const& motions, double time)
{
    return pose(motions, 0, time, {});
}
}

TEST(Translation, goes_at_its_speed_from_start_to_stop)
{
    std::vector<Motion> const motions{Translation{{2, 0, -1}, {1, 3}}};
    expect_near(pose_of(motions, 0.5).shift, {0, 0, 0});
    expect_near(pose_of(motions, 0.5).velocity, {0, 0, 0});
    expect_near(pose_of(motions, 2).shift, {2, 0, -1});
    expect_near(pose_of(motions, 2).velocity, {2, 0, -1});
    expect_near(pose_of(motions, 9).shift, {4, 0, -2});
    expect_near(pose_of(motions, 9).velocity, {0, 0, 0});
}

TEST(Rotation, a_quarter_turn_takes_x_to_y)
{
    std::vector<Motion> const motions{Rotation{.point = {1, 0, 0}, .axis = {0, 0, 1}, .rate = pi / 2}};
    auto const now = pose_of(motions, 1);
    expect_near(now.to_space({2, 0, 5}), {1, 1, 5});
    expect_near(now.to_body({1, 1, 5}), {2, 0, 5});
    expect_near(now.direction_to_space({1, 0, 0}), {0, 1, 0});
    expect_near(now.velocity_at({1, 1, 5}), {-pi / 2, 0, 0});
    expect_near(now.spin, {0, 0, pi / 2});
}

TEST(Vibration, swings_by_its_amplitude_and_begins_where_it_was_drawn)
{
    std::vector<Motion> const motions{
        Vibration{.direction = {0, 0, 1}, .amplitude = 0.002, .frequency = 50, .phase = pi / 2, .when = {0.1}}};
    expect_near(pose_of(motions, 0.1).shift, {0, 0, 0});
    expect_near(pose_of(motions, 0.11).shift, {0, 0, -0.004});
    expect_near(pose_of(motions, 0.105).velocity, {0, 0, -0.002 * 2 * pi * 50}, 1e-12);
}

TEST(SumOfMotions, velocity_of_the_surface_is_the_derivative_of_the_pose)
{
    std::vector<Motion> const motions{
        Rotation{{0.3, -0.2, 0.1}, Vec3{1, 2, 2} / 3.0, 4.0, {}}, Translation{{0.5, 0.1, -0.7}, {}},
        Rotation{{-1, 0.4, 0.2}, Vec3{2, -1, 2} / 3.0, -3.0, {}}, Vibration{Vec3{0, 0.6, 0.8}, 0.05, 2.0, 0.4, {}}};
    double const time = 0.37, h = 1e-5;
    for (Vec3 const& drawn : {Vec3{0, 0, 0}, Vec3{1, -2, 0.5}, Vec3{-0.3, 0.7, 3}}) {
        auto const at = [&](double t) { return pose_of(motions, t).to_space(drawn); };
        auto const now = pose_of(motions, time);
        expect_near(now.to_body(at(time)), drawn, 1e-14);
        expect_near(now.velocity_at(at(time)), (at(time + h) - at(time - h)) / (2 * h), 1e-7);
    }
}

TEST(SumOfMotions, a_pose_never_depends_on_how_time_was_reached)
{
    std::vector<Motion> const motions{Rotation{{}, {0, 0, 1}, 100.0, {}}, Translation{{1, 0, 0}, {}}};
    auto const first = pose_of(motions, 12.345);
    for (int k = 0; k < 100; ++k) pose_of(motions, 0.1 * k);
    EXPECT_EQ(pose_of(motions, 12.345).to_space({1, 2, 3}), first.to_space({1, 2, 3}));
}

TEST(RotationInPlace, leaves_a_drum_where_it_is_and_moves_its_surface)
{
    Body drum{.name = "drum",
              .shapes = {Frustum{.base = {0, -1, 2}, .axis = {0, 1, 0}, .length = 2, .base_radius = 1, .top_radius = 1},
                         Disc{.centre = {0, 1, 2}, .normal = {0, 1, 0}, .radius = 1}},
              .motions = {Rotation{.point = {0, 5, 2}, .axis = {0, 1, 0}, .rate = 3}}};
    ASSERT_EQ(rotations_in_place(drum), 1u);
    auto const now = pose(drum.motions, 1, 7.7, {});
    EXPECT_FALSE(now.turned);
    EXPECT_EQ(now.to_body({0.1, 0.2, 0.3}), (Vec3{0.1, 0.2, 0.3}));
    expect_near(now.velocity_at({0, 0, 1}), {-3, 0, 0});
    // The same surface velocity as of a body that does turn.
    expect_near(pose(drum.motions, 0, 7.7, {}).velocity_at({0.3, 0.2, 1}), now.velocity_at({0.3, 0.2, 1}), 1e-13);
    drum.shapes.push_back(Disc{.centre = {0.1, 1, 2}, .normal = {0, 1, 0}, .radius = 0.1});
    EXPECT_EQ(rotations_in_place(drum), 0u);
}

TEST(Servo, moves_towards_the_granules_until_they_press_as_wanted)
{
    Servo const servo{.direction = {0, 0, -1}, .pressure = 1000, .area = 0.01, .fastest = 0.1, .when = {0, 5}};
    double const mass = 1e-3, dt = 1e-5;
    EXPECT_EQ(servo_speed(servo, 0.1, {}, mass, 5, dt), 0) << "it stands after its time";
    EXPECT_EQ(servo_speed(servo, 0, {}, 0, 0, dt), 0.1) << "nothing resists";
    EXPECT_EQ(servo_speed(servo, 0, {3, 4, 10}, mass, 0, dt), 0) << "10 N on 0.01 m2 up: as wanted";
    EXPECT_DOUBLE_EQ(servo_speed(servo, 0.1, {}, mass, 0, dt), 0.1) << "it goes on as fast as it can";
    EXPECT_LT(servo_speed(servo, 0, {0, 0, 11}, mass, 0, dt), 0);
    EXPECT_DOUBLE_EQ(servo_speed(servo, 0, {0, 0, 1e9}, mass, 0, dt), -0.1);
    // 5 N more than what resists and a brake of 100 N s/m: at rest at first, it tends to half of its speed.
    double speed = 0;
    for (int k = 0; k < 1000; ++k) speed = servo_speed(servo, speed, {0, 0, 5}, mass, 0, dt);
    EXPECT_NEAR(speed, 0.05, 1e-12);
    ServoState const state{.travelled = 1e-4, .speed = 0.1};
    std::vector<Motion> const motions{servo};
    expect_near(pose(motions, 0, 0, state).shift, {0, 0, -1e-4});
    expect_near(pose(motions, 0, 0, state).velocity, {0, 0, -0.1});
}

TEST(FacingArea, of_discs_and_closed_and_open_meshes)
{
    Body const disc{.name = "lid", .shapes = {Disc{.centre = {}, .normal = {0, 0.6, 0.8}, .radius = 2, .hole = 1}}};
    EXPECT_NEAR(*facing_area(disc, {0, 0, 1}), 0.8 * 3 * pi, 1e-14);
    Vec3 const o{}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    Body const sheet{.name = "sheet", .shapes = {Mesh{{{o, x, y}}}}};
    EXPECT_DOUBLE_EQ(*facing_area(sheet, z), 0.5);
    EXPECT_DOUBLE_EQ(*facing_area(sheet, -z), 0.5);
    Body const closed{.name = "tetrahedron", .shapes = {Mesh{{{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}}}}};
    EXPECT_DOUBLE_EQ(*facing_area(closed, z), 0.5);
    EXPECT_FALSE(facing_area({.name = "plane", .shapes = {Plane{{}, z}}}, z));
}

TEST(Bounds, enclose_a_slanted_cylinder)
{
    double const s = std::sqrt(0.5);
    auto const box =
        bounds({.name = "tube",
                .shapes = {Frustum{
                    .base = {1, 0, 0}, .axis = {s, 0, s}, .length = 1, .base_radius = 0.5, .top_radius = 0.5}}});
    expect_near(box.lower, {1 - 0.5 * s, -0.5, -0.5 * s});
    expect_near(box.upper, {1 + 1.5 * s, 0.5, 1.5 * s});
}
