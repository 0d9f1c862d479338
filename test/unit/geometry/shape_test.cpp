// Shapes: the nearest point from the face, the edge and behind.
#include "granum/geometry/shape.hpp"

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
}

TEST(PlaneShape, keeps_its_normal_behind_it)
{
    Plane const plane{{0, 0, 1}, {0, 0, 1}};
    auto const above = nearest(plane, {5, -3, 1.25});
    EXPECT_DOUBLE_EQ(above.distance, 0.25);
    expect_near(above.point, {5, -3, 1});
    auto const below = nearest(plane, {0, 0, 0.9});
    EXPECT_NEAR(below.distance, -0.1, 1e-15);
    EXPECT_EQ(below.normal, (Vec3{0, 0, 1}));
}

TEST(BoxInside, six_planes_face_its_middle)
{
    for (auto const& shape : box_inside({-1, -2, -3}, {1, 2, 3}))
        EXPECT_GT(nearest(std::get<Plane>(shape), {0, 0, 0}).distance, 0.9);
}

TEST(Frustum, flank_of_a_cone_about_a_slanted_axis_is_met_along_its_normal)
{
    // In (along, away) the flank goes from (0, 1) to (4, 4): length 5, inner normal (0.6, -0.8).
    Vec3 const axis = Vec3{1, 2, 2} / 3.0, out = Vec3{2, 1, -2} / 3.0, base{7, 8, 9};
    Frustum cone{.base = base, .axis = axis, .length = 4, .base_radius = 1, .top_radius = 4, .side = Side::inside};
    Vec3 const foot = base + 2.0 * axis + 2.5 * out, inward = 0.6 * axis - 0.8 * out;
    auto const within = nearest(cone, foot + 0.2 * inward);
    EXPECT_NEAR(within.distance, 0.2, 1e-14);
    expect_near(within.normal, inward);
    expect_near(within.point, foot);
    auto const behind = nearest(cone, foot - 0.2 * inward);
    EXPECT_NEAR(behind.distance, -0.2, 1e-14);
    expect_near(behind.normal, inward);
    cone.side = Side::outside;
    EXPECT_NEAR(nearest(cone, foot + 0.2 * inward).distance, -0.2, 1e-14);
    cone.side = Side::both;
    auto const thin = nearest(cone, foot - 0.2 * inward);
    EXPECT_NEAR(thin.distance, 0.2, 1e-14);
    expect_near(thin.normal, -inward);
}

TEST(Frustum, ends_in_a_ring)
{
    Frustum const cone{.base = {}, .axis = {0, 0, 1}, .length = 4, .base_radius = 1, .top_radius = 4};
    auto const above = nearest(cone, {0, 3.7, 4.4});
    EXPECT_EQ(above.feature, Feature::edge);
    EXPECT_NEAR(above.distance, 0.5, 1e-14);
    expect_near(above.normal, {0, -0.6, 0.8});
}

TEST(Frustum, that_ends_in_a_point_has_a_tip)
{
    Frustum const cone{.base = {}, .axis = {0, 0, 1}, .length = 1, .base_radius = 1, .top_radius = 0};
    auto const above = nearest(cone, {0, 0, 1.5});
    EXPECT_EQ(above.feature, Feature::vertex);
    EXPECT_NEAR(above.distance, 0.5, 1e-15);
    expect_near(above.normal, {0, 0, 1});
}

TEST(SphereShape, is_met_along_its_radius_on_the_side_where_granules_are)
{
    // (2, 3, 6) has the length 7.
    Vec3 const centre{1, -2, 3}, along = Vec3{2, 3, 6} / 7.0;
    Sphere sphere{.centre = centre, .radius = 2, .side = Side::inside};
    auto const within = nearest(sphere, centre + 1.75 * along);
    EXPECT_NEAR(within.distance, 0.25, 1e-14);
    expect_near(within.normal, -along);
    expect_near(within.point, centre + 2.0 * along);
    EXPECT_EQ(within.feature, Feature::face);
    auto const behind = nearest(sphere, centre + 2.25 * along);
    EXPECT_NEAR(behind.distance, -0.25, 1e-14);
    expect_near(behind.normal, -along);
    sphere.side = Side::outside;
    EXPECT_NEAR(nearest(sphere, centre + 2.25 * along).distance, 0.25, 1e-14);
    EXPECT_NEAR(nearest(sphere, centre + 1.75 * along).distance, -0.25, 1e-14);
    expect_near(nearest(sphere, centre + 1.75 * along).normal, along);
    sphere.side = Side::both;
    for (double const away : {1.75, 2.25}) {
        auto const thin = nearest(sphere, centre + away * along);
        EXPECT_NEAR(thin.distance, 0.25, 1e-14);
        expect_near(thin.normal, away < 2 ? -along : along);
    }
    EXPECT_DOUBLE_EQ(nearest(sphere, centre).distance, 2);
    EXPECT_NEAR(norm(nearest(sphere, centre).normal), 1, 1e-15);
}

TEST(SphereShape, has_bounds_turns_in_place_about_its_centre_and_faces_with_its_circle)
{
    Body const body{.name = "ball", .shapes = {Sphere{.centre = {1, 2, 3}, .radius = 0.5}}};
    EXPECT_EQ(bounds(body).lower, (Vec3{0.5, 1.5, 2.5}));
    EXPECT_EQ(bounds(body).upper, (Vec3{1.5, 2.5, 3.5}));
    EXPECT_NEAR(facing_area(body, {0.6, 0, 0.8}).value(), pi / 4, 1e-15);
    EXPECT_TRUE(unmoved(body.shapes[0], {.point = {1, 2, -4}, .axis = {0, 0, 1}, .rate = 1}));
    EXPECT_FALSE(unmoved(body.shapes[0], {.point = {1, 2.1, -4}, .axis = {0, 0, 1}, .rate = 1}));
}

TEST(Disc, is_met_from_both_sides_at_its_rim_and_at_its_hole)
{
    Disc const ring{.centre = {0, 0, 1}, .normal = {0, 0, 1}, .radius = 2, .hole = 1};
    EXPECT_EQ(nearest(ring, {1.5, 0, 1.25}).normal, (Vec3{0, 0, 1}));
    EXPECT_EQ(nearest(ring, {1.5, 0, 0.75}).normal, (Vec3{0, 0, -1}));
    EXPECT_DOUBLE_EQ(nearest(ring, {1.5, 0, 0.75}).distance, 0.25);
    auto const rim = nearest(ring, {2.3, 0, 1.4});
    EXPECT_EQ(rim.feature, Feature::edge);
    EXPECT_NEAR(rim.distance, 0.5, 1e-14);
    auto const hole = nearest(ring, {0.4, 0, 1.8});
    EXPECT_NEAR(hole.distance, 1.0, 1e-14);
    expect_near(hole.normal, {-0.6, 0, 0.8});
    EXPECT_NEAR(nearest(ring, {0, 0, 1}).distance, 1, 1e-15);
}

TEST(TriangleShape, seven_regions_give_face_edges_and_corners)
{
    Triangle const triangle{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 3, 0}};
    Vec3 const normal = triangle_normal(triangle);
    EXPECT_EQ(normal, (Vec3{0, 0, 1}));
    auto const at = [&](double x, double y, double z) { return nearest(triangle, normal, {x, y, z}); };
    EXPECT_EQ(at(1, 1, 0.5).feature, Feature::face);
    EXPECT_EQ(at(1, 1, -0.5).normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(at(2, -1, 0).feature, Feature::edge);
    expect_near(at(2, -1, 0).point, {2, 0, 0});
    EXPECT_EQ(at(-1, 1, 0).feature, Feature::edge);
    expect_near(at(-1, 1, 0).point, {0, 1, 0});
    auto const slanted = at(2 + 3, 1.5 + 4, 0);  // out from the middle of the long edge
    EXPECT_EQ(slanted.feature, Feature::edge);
    expect_near(slanted.point, {2, 1.5, 0});
    EXPECT_NEAR(slanted.distance, 5, 1e-14);
    EXPECT_EQ(at(-1, -1, 0).feature, Feature::vertex);
    expect_near(at(6, -0.1, 0).point, {4, 0, 0});
    expect_near(at(-0.1, 5, 0).point, {0, 3, 0});
}

TEST(TriangleShape, no_point_of_it_is_nearer_than_the_nearest)
{
    Triangle const triangle{Vec3{0.1, 0.2, -0.3}, Vec3{1.5, -0.4, 0.2}, Vec3{-0.7, 0.1, 0.05}};  // obtuse
    Vec3 const normal = triangle_normal(triangle);
    for (int i = 0; i < 500; ++i) {
        Vec3 const centre{2 * std::sin(1.0 * i), 2 * std::sin(1.7 * i + 1), 2 * std::sin(2.3 * i + 2)};
        auto const found = nearest(triangle, normal, centre);
        EXPECT_NEAR(norm(centre - found.point), found.distance, 1e-14);
        double least = 1e9;
        int const n = 60;
        for (int a = 0; a <= n; ++a)
            for (int b = 0; a + b <= n; ++b) {
                double const u = double(a) / n, v = double(b) / n;
                Vec3 const point = (1 - u - v) * triangle[0] + u * triangle[1] + v * triangle[2];
                least = std::min(least, norm(centre - point));
            }
        EXPECT_LE(found.distance, least + 1e-14);
        EXPECT_GE(found.distance, least - 0.05);
    }
}
