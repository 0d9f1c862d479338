// The part of a ball in a box: boxes that fill space share the ball out, and caps and octants have their known volumes.
#include "granum/geometry/ball_in_box.hpp"
#include "granum/base/random.hpp"
#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using math::Vec3;

double const whole = 4.0 / 3 * math::pi;

TEST(BallInBox, is_the_whole_ball_inside_and_nothing_outside)
{
    EXPECT_NEAR(geometry::ball_in_box({1, 2, 3}, 1, {0, 1, 2}, {2, 3, 4}), whole, 1e-14);
    EXPECT_EQ(geometry::ball_in_box({1, 2, 3}, 1, {2, 1, 2}, {3, 3, 4}), 0);
}

TEST(BallInBox, is_a_cap_behind_a_face_and_an_octant_behind_a_corner)
{
    for (double const h : {0.1, 0.5, 1.3})
        for (std::size_t d = 0; d < 3; ++d) {
            Vec3 low{-5, -5, -5};
            low[d] = 1 - h;
            // Polya: a cap of height h has the volume pi h^2 (3 R - h) / 3.
            EXPECT_NEAR(geometry::ball_in_box({}, 1, low, {5, 5, 5}), math::pi * h * h * (3 - h) / 3, 1e-14);
        }
    EXPECT_NEAR(geometry::ball_in_box({}, 1, {0, 0, 0}, {5, 5, 5}), whole / 8, 1e-14);
    EXPECT_NEAR(geometry::ball_in_box({}, 1, {0, 0, -5}, {5, 5, 5}), whole / 4, 1e-14);
}

TEST(BallInBox, of_boxes_that_fill_space_adds_up_to_the_ball)
{
    for (std::uint64_t k = 0; k < 200; ++k) {
        base::Random random(1, base::Purpose::test, k, 0);
        auto const draw = [&] { return 1.2 * (2 * random.uniform() - 1); };
        Vec3 const corner{draw(), draw(), draw()};
        double const thickness = 0.3 + random.uniform();
        double sum = 0;
        for (int layer = 0; layer < 3; ++layer)
            for (int side = 0; side < 4; ++side) {
                Vec3 low{-9, -9, -9}, high{9, 9, 9};
                ((side & 1) != 0 ? low.x : high.x) = corner.x;
                ((side & 2) != 0 ? low.y : high.y) = corner.y;
                if (layer > 0) low.z = corner.z + (layer - 1) * thickness;
                if (layer < 2) high.z = corner.z + layer * thickness;
                double const part = geometry::ball_in_box({}, 1, low, high);
                EXPECT_GE(part, 0);
                sum += part;
            }
        EXPECT_NEAR(sum / whole, 1, 1e-13) << corner.x << " " << corner.y << " " << corner.z;
    }
}

TEST(BallInBox, does_not_depend_on_the_direction_that_it_is_sliced_along)
{
    for (std::uint64_t k = 0; k < 1000; ++k) {
        base::Random random(2, base::Purpose::test, k, 0);
        auto const draw = [&] { return 1.2 * (2 * random.uniform() - 1); };
        Vec3 const low{draw(), draw(), draw()}, high = low + Vec3{draw() + 1.2, draw() + 1.2, draw() + 1.2};
        double const one = geometry::ball_in_box({}, 1, low, high);
        double const turned = geometry::ball_in_box({}, 1, {low.y, low.z, low.x}, {high.y, high.z, high.x});
        EXPECT_NEAR(one, turned, 5e-5 * whole);
    }
}

TEST(BallInBox, of_a_cube_inside_the_ball_is_the_cube)
{
    EXPECT_NEAR(geometry::ball_in_box({}, 1, {-0.5, -0.4, -0.3}, {0.5, 0.3, 0.2}), 1.0 * 0.7 * 0.5, 1e-14);
}
}
