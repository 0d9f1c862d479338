#include "granum/geometry/wall.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum::geometry;

TEST(Plane, is_touched_from_the_side_of_its_normal)
{
    Plane const plane{{0, 0, 1}, {0, 0, 1}};
    auto const near = touch(plane, {5, -3, 1.25}, 0.5);
    ASSERT_TRUE(near);
    EXPECT_DOUBLE_EQ(near->distance, 0.25);
    EXPECT_EQ(near->normal, (Vec3{0, 0, 1}));
    EXPECT_FALSE(touch(plane, {5, -3, 1.75}, 0.5));
    EXPECT_LT(touch(plane, {0, 0, 0.9}, 0.5)->distance, 0);
}

TEST(Cylinder, pushes_towards_its_axis)
{
    ConeWall const wall{0, 2, 4, 2};
    auto const near = touch(wall, {0, -1.7, 1}, 0.5);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->distance, 0.3, 1e-15);
    EXPECT_NEAR(near->normal.y, 1, 1e-15);
    EXPECT_FALSE(near->edge);
    EXPECT_FALSE(touch(wall, {0, 0, 1}, 0.5));
    EXPECT_FALSE(touch(wall, {0, 1.7, 4.6}, 0.5));
}

TEST(Cone, is_touched_along_the_normal_of_its_flank)
{
    // Flank from (1, 0) to (4, 4) in (r, z): length 5, inner normal (-0.8, 0.6).
    ConeWall const wall{0, 1, 4, 4};
    Vec3 const foot{2.5, 0, 2}, centre = foot + 0.2 * Vec3{-0.8, 0, 0.6};
    auto const near = touch(wall, centre, 0.5);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->distance, 0.2, 1e-14);
    EXPECT_NEAR(near->normal.x, -0.8, 1e-14);
    EXPECT_NEAR(near->normal.z, 0.6, 1e-14);
    EXPECT_NEAR(norm(near->normal), 1, 1e-14);
    // Behind the flank the distance is negative and the normal still points inside.
    auto const behind = touch(wall, foot - 0.2 * Vec3{-0.8, 0, 0.6}, 0.5);
    EXPECT_NEAR(behind->distance, -0.2, 1e-14);
    EXPECT_NEAR(behind->normal.x, -0.8, 1e-14);
}

TEST(Cone, ends_in_an_edge)
{
    ConeWall const wall{0, 1, 4, 4};
    auto const above = touch(wall, {0, 4 - 0.3, 4.4}, 0.6);
    ASSERT_TRUE(above);
    EXPECT_TRUE(above->edge);
    EXPECT_NEAR(above->distance, 0.5, 1e-14);
    EXPECT_NEAR(above->normal.y, -0.6, 1e-14);
    EXPECT_NEAR(above->normal.z, 0.8, 1e-14);
}
}
