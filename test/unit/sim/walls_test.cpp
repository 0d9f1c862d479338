// Walls that a case states: what they become, what they do to granules, how they are drawn.
#include "granum/sim/wall_output.hpp"
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::sim;

//! A drum about the y axis of a box without walls; its granules lie in the lower half.
std::string const drum = R"(
[apparatus]
shape = "box"
size = ["70 mm", "20 mm", "70 mm"]
periodic = ["y"]
open = ["left", "right", "bottom", "top"]
[[wall]]
name = "drum"
shape = "cylinder"
base = ["35 mm", "-1 mm", "35 mm"]
axis = [0, 1, 0]
length = "22 mm"
diameter = "60 mm"
side = "inside"
rotate = { point = ["35 mm", "0 mm", "35 mm"], axis = [0, 1, 0], rate = "30 rpm" }
[granules]
diameter = "4 mm"
density = "2500 kg/m3"
number = 150
region = { lower = ["15 mm", "0 mm", "12 mm"], upper = ["55 mm", "20 mm", "58 mm"] }
[contact]
youngs_modulus = "2 MPa"
restitution = 0.5
sliding_friction = 0.6
rolling_friction = 0.05
[time]
duration = "1 s"
)";

TEST(CaseWalls, have_the_shape_and_the_motions_that_they_state)
{
    auto const data = scene::case_of(drum);
    ASSERT_EQ(data.walls.size(), 1u);
    auto const& body = data.walls[0];
    auto const& flank = std::get<geometry::Frustum>(body.shapes.at(0));
    EXPECT_DOUBLE_EQ(flank.base_radius, 0.03);
    EXPECT_DOUBLE_EQ(flank.top_radius, 0.03);
    EXPECT_EQ(flank.axis, (Vec3{0, 1, 0}));
    EXPECT_EQ(flank.side, geometry::Side::inside);
    EXPECT_NEAR(std::get<geometry::Rotation>(body.motions.at(0)).rate, math::pi, 1e-12);
    EXPECT_EQ(body.material, 1u);
}

TEST(CaseWalls, of_a_turning_drum_carry_its_granules_and_feel_their_weight)
{
    auto const simulation = scene::simulation_of(drum);
    auto& engine = simulation->engine();
    auto const centre = [&] {
        Vec3 sum;
        double mass = 0;
        auto const& granules = simulation->granules();
        for (std::size_t row = 0; row < granules.owned; ++row) {
            sum += granules.mass[row] * granules.position[row];
            mass += granules.mass[row];
        }
        return std::pair((1 / mass) * sum, mass);
    };
    auto const [start, mass] = centre();
    EXPECT_EQ(engine.time(), 0) << "what settled before the start does not count";
    EXPECT_NEAR(start.x, 0.035, 0.004) << "at rest they lie in the middle";
    double upward = 0, about = 0;
    int samples = 0;
    while (simulation->time() < 0.5 - 1e-9) {
        simulation->step(0.002);
        if (simulation->time() < 0.2) continue;
        auto const load = engine.wall_loads().at(0);
        upward += load.force.z;
        // About the axis of the drum, from the torque about the origin.
        about += load.torque.y - cross(Vec3{0.035, 0, 0.035}, load.force).y;
        ++samples;
    }
    auto const end = centre().first;
    // Turned about +y, the lowest point of the drum moves towards -x and takes the granules along.
    EXPECT_LT(end.x, start.x - 0.002);
    double const weight = mass * math::standard_gravity;
    EXPECT_NEAR(upward / samples, -weight, 0.1 * weight);
    // The drum lifts the granules' centre off the vertical: the torque on it is their weight times that lever.
    EXPECT_LT(about / samples, 0);
    EXPECT_GT(about / samples, -weight * 0.03);
}

TEST(CaseWalls, may_be_a_sphere)
{
    std::string text = drum;
    auto const from = text.find("shape = \"cylinder\""), to = text.find("side = ");
    text.replace(from, to - from,
                 "shape = \"sphere\"\ncentre = [\"35 mm\", \"10 mm\", \"35 mm\"]\ndiameter = \"60 mm\"\n");
    auto const data = scene::case_of(text);
    auto const& sphere = std::get<geometry::Sphere>(data.walls.at(0).shapes.at(0));
    EXPECT_EQ(sphere.centre, (Vec3{0.035, 0.01, 0.035}));
    EXPECT_DOUBLE_EQ(sphere.radius, 0.03);
    EXPECT_EQ(sphere.side, geometry::Side::inside);
    // Drawn, its corners lie on it and its faces close it.
    auto const surface = body_surface(data.walls[0], {});
    for (auto const& corner : surface.corners) EXPECT_NEAR(norm(corner - sphere.centre), 0.03, 1e-15);
    EXPECT_EQ(surface.faces.size(), 32u * 64);
}

TEST(CaseWalls, are_drawn_where_they_are)
{
    geometry::Body body{.name = "funnel", .shapes = {}};
    body.shapes.push_back(geometry::Frustum{
        .base = {0, 0, 1}, .axis = {0, 0, 1}, .length = 2, .base_radius = 0.5, .top_radius = 1, .side = {}});
    body.shapes.push_back(geometry::Disc{.centre = {0, 0, 1}, .normal = {0, 0, 1}, .radius = 0.5, .hole = 0});
    geometry::Pose pose;
    pose.shift = {10, 0, 0};
    auto const surface = body_surface(body, pose);
    EXPECT_EQ(surface.corners.size(), 2u * 2 * 64);
    EXPECT_EQ(surface.faces.size(), 2u * 64);
    for (auto const& corner : surface.corners) {
        double const radius = std::hypot(corner.x - 10, corner.y);
        EXPECT_TRUE(corner.z == 1 ? radius < 0.5 + 1e-12 : std::abs(radius - 1) < 1e-12);
    }
}
}
