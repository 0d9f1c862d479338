// The chamber: exact circle areas, volumes of cones, what counts as inside.
#include "granum/geometry/chamber.hpp"

#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

using granum::geometry::Chamber;
using granum::geometry::circle_rectangle_area;
using granum::math::pi;

namespace
{
Chamber cone_and_cylinder()
{
    return {.shape = Chamber::Shape::revolution, .profile = {{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}}};
}
}

TEST(CircleRectangle, whole_half_and_quarter_disc)
{
    EXPECT_NEAR(circle_rectangle_area(2, -3, 3, -3, 3), 4 * pi, 1e-13);
    EXPECT_NEAR(circle_rectangle_area(2, 0, 3, -3, 3), 2 * pi, 1e-13);
    EXPECT_NEAR(circle_rectangle_area(2, -3, 0, 0, 2), pi, 1e-13);
}

TEST(CircleRectangle, segment_and_inner_rectangle)
{
    // Segment of the unit disc beyond x = 1/2: acos(1/2) - sqrt(3)/4.
    EXPECT_NEAR(circle_rectangle_area(1, 0.5, 2, -2, 2), pi / 3 - std::sqrt(3.0) / 4, 1e-14);
    EXPECT_DOUBLE_EQ(circle_rectangle_area(1, -0.1, 0.2, 0.1, 0.3), 0.3 * 0.2);
    EXPECT_EQ(circle_rectangle_area(1, 0.8, 1, 0.8, 1), 0);
}

TEST(CircleRectangle, mirror_images_have_equal_area)
{
    double const area = circle_rectangle_area(1, 0.3, 0.9, 0.2, 0.8);
    EXPECT_NEAR(circle_rectangle_area(1, -0.9, -0.3, 0.2, 0.8), area, 1e-15);
    EXPECT_NEAR(circle_rectangle_area(1, 0.2, 0.8, -0.9, -0.3), area, 1e-15);
}

TEST(Chamber, open_area_of_a_plane_is_the_circle)
{
    Chamber const chamber = cone_and_cylinder();
    int const n = 17;
    for (double z : {0.0, 0.2, 0.45, 0.7, 1.0}) {
        double const low = chamber.lower().x, step = (chamber.upper().x - low) / n;
        double sum = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                sum += chamber.open_area(2, {low + i * step, low + j * step, z},
                                         {low + (i + 1) * step, low + (j + 1) * step, z + 0.01});
        double const r = 0.09 + std::min(z, 0.45) / 0.45 * 0.035;
        EXPECT_NEAR(sum / (pi * r * r), 1, 1e-12) << "z = " << z;
    }
}

TEST(Chamber, open_volumes_add_up_to_the_frustum)
{
    Chamber const chamber = cone_and_cylinder();
    double const frustum = pi * 0.45 / 3 * (0.09 * 0.09 + 0.09 * 0.125 + 0.125 * 0.125);
    EXPECT_NEAR(chamber.volume(0, 0.45), frustum, 1e-15);
    EXPECT_NEAR(chamber.volume(), frustum + pi * 0.125 * 0.125 * 0.55, 1e-15);
    int const n = 12, layers = 7;
    double const low = chamber.lower().x, step = 0.25 / n, rise = 1.0 / layers;
    double sum = 0;
    for (int k = 0; k < layers; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                sum += chamber.open_volume({low + i * step, low + j * step, k * rise},
                                           {low + (i + 1) * step, low + (j + 1) * step, (k + 1) * rise});
    EXPECT_NEAR(sum / chamber.volume(), 1, 1e-12);
}

TEST(Chamber, vertical_faces_of_a_cone_are_cut_by_hyperbolas)
{
    // Against the sum of many chords. With quadrature in z alone a face that the hyperbola leaves early was off by 9 %.
    Chamber const chamber = cone_and_cylinder();
    auto const radius = [](double z) { return std::min(0.125, 0.09 + 0.035 * z / 0.45); };
    int cut = 0;
    for (double const plane : {0.0, 0.0583, 0.0917, -0.1083, 0.1249})
        for (double const from : {-0.125, -0.05, -0.0083, 0.0, 0.06})
            for (double const low : {0.0, 0.2, 0.21, 0.44}) {
                double const to = from + 0.0167, high = low + 0.0667;
                int const layers = 100000;
                double sum = 0;
                for (int k = 0; k < layers; ++k) {
                    double const r = radius(low + (k + 0.5) * (high - low) / layers), half2 = r * r - plane * plane;
                    double const half = half2 > 0 ? std::sqrt(half2) : 0;
                    sum += std::max(0.0, std::min(to, half) - std::max(from, -half)) * (high - low) / layers;
                }
                double const whole = (to - from) * (high - low);
                EXPECT_NEAR(chamber.open_area(0, {plane, from, low}, {1, to, high}), sum, 1e-6 * whole);
                EXPECT_NEAR(chamber.open_area(1, {from, plane, low}, {to, 1, high}), sum, 1e-6 * whole);
                cut += sum > 1e-3 * whole && sum < 0.999 * whole;
            }
    EXPECT_GT(cut, 10);
}

TEST(Chamber, vertical_face_of_a_cylinder_is_the_chord_times_the_height)
{
    Chamber const chamber{.shape = Chamber::Shape::revolution, .profile = {{0, 0.1}, {1, 0.1}}};
    double const chord = 2 * std::sqrt(0.1 * 0.1 - 0.06 * 0.06);
    EXPECT_NEAR(chamber.open_area(0, {0.06, -0.1, 0.2}, {0.1, 0.1, 0.5}), 0.3 * chord, 1e-15);
    EXPECT_NEAR(chamber.open_area(1, {-0.1, -0.06, 0.2}, {0.1, 0.1, 0.5}), 0.3 * chord, 1e-15);
}

TEST(Chamber, inside_keeps_the_margin_to_every_wall)
{
    Chamber const chamber = cone_and_cylinder();
    EXPECT_TRUE(chamber.inside({0, 0, 0.5}, 0.12));
    EXPECT_FALSE(chamber.inside({0, 0, 0.5}, 0.126));
    EXPECT_FALSE(chamber.inside({0, 0, 0.01}, 0.02));
    EXPECT_FALSE(chamber.inside({0.12, 0, 0.1}));
    EXPECT_TRUE(chamber.inside({0, 0.12, 0.6}));
    // Distance to a cone is less than the horizontal gap: 0.01 cos(half angle).
    double const gap = 0.01 * 0.45 / std::hypot(0.45, 0.035);
    double const r = 0.09 + 0.035 * 0.2 / 0.45 - 0.01;
    EXPECT_TRUE(chamber.inside({r, 0, 0.2}, gap * 0.999));
    EXPECT_FALSE(chamber.inside({r, 0, 0.2}, gap * 1.001));
}

TEST(Chamber, box_is_open_up_to_its_walls)
{
    Chamber const box{.size = {1, 2, 3}};
    EXPECT_DOUBLE_EQ(box.open_volume({-1, 0.5, 0}, {0.5, 1, 9}), 0.5 * 0.5 * 3);
    EXPECT_DOUBLE_EQ(box.open_area(2, {0, 0, 1}, {5, 5, 2}), 2);
    EXPECT_FALSE(box.inside({0.5, 0.5, 2.99}, 0.02));
    EXPECT_TRUE(box.inside({0.5, 0.5, 2.97}, 0.02));
}
