// Chambers of solids and bodies in chambers: volumes and areas against closed forms, places against what was drawn.
#include "granum/geometry/bodies_in_chamber.hpp"
#include "granum/geometry/cut_outline.hpp"
#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::geometry;
using math::pi;

Vec3 const up{0, 0, 1};

//! A cone of 50 to 100 mm radius and a column on it, which stand at a height of 1 m; seams and all.
Region funnel()
{
    return Region("cone", cone_frustum({0, 0, 1}, up, 0.2, 0.05, 0.1)) |
           Region("column", cylinder({0, 0, 1.2}, up, 0.15, 0.1));
}

constexpr double funnel_volume = pi * 0.2 / 3 * (0.05 * 0.05 + 0.05 * 0.1 + 0.1 * 0.1) + pi * 0.01 * 0.15;

TEST(ChamberOfSolids, has_the_volume_and_the_ends_of_its_solids)
{
    auto const chamber = chamber_of(funnel());
    EXPECT_DOUBLE_EQ(chamber.bottom(), 1);
    EXPECT_DOUBLE_EQ(chamber.top(), 1.35);
    EXPECT_NEAR(chamber.volume() / funnel_volume, 1, 3e-4);
    EXPECT_NEAR(chamber.volume(1.2, 1.35) / (pi * 0.01 * 0.15), 1, 1e-3);
    EXPECT_NEAR(chamber.area(1) / (pi * 0.0025), 1, 2e-3);
    EXPECT_NEAR(chamber.area(1.35) / (pi * 0.01), 1, 1e-3);
    EXPECT_NEAR(chamber.area(1.3) / (pi * 0.01), 1, 2e-3);
}

TEST(ChamberOfSolids, is_open_across_the_seam_of_two_solids)
{
    auto const chamber = chamber_of(funnel());
    for (double const away : {0.0, 0.03, 0.09}) EXPECT_TRUE(chamber.inside({away, 0, 1.2})) << away;
    EXPECT_FALSE(chamber.inside({0.1001, 0, 1.2}));
    EXPECT_FALSE(chamber.inside({0, 0, 1}));
    EXPECT_TRUE(chamber.inside({0, 0, 1.01}, 0.009));
    EXPECT_FALSE(chamber.inside({0, 0, 1.01}, 0.011));
    EXPECT_FALSE(chamber.parted({0.05, 0, 1.1}, {-0.05, 0, 1.3}));
}

TEST(BodiesInChamber, take_their_volume_and_part_what_is_on_their_sides)
{
    Chamber const plain{.shape = Chamber::Shape::revolution, .profile = {{0, 0.05}, {0.2, 0.1}, {0.35, 0.1}}};
    auto const chamber = with_bodies(plain, {Region("tube", tube({0, 0, 0.02}, up, 0.2, 0.03, 0.04)),
                                             Region("block", Box{{-0.01, -0.01, 0}, {0.01, 0.01, 0.015}})});
    double const taken = pi * (0.0016 - 0.0009) * 0.2 + 4e-4 * 0.015;
    EXPECT_NEAR((plain.volume() - chamber.volume()) / taken, 1, 2e-2);
    EXPECT_NEAR(plain.area(0) - chamber.area(0), 4e-4, 3e-5);
    EXPECT_TRUE(chamber.inside({0, 0, 0.1}));
    EXPECT_FALSE(chamber.inside({0.035, 0, 0.1})) << "in the wall of the tube";
    EXPECT_FALSE(chamber.inside({0, 0, 0.01})) << "in the block";
    EXPECT_TRUE(chamber.parted({0.02, 0, 0.1}, {0.05, 0, 0.1}));
    EXPECT_FALSE(chamber.parted({0.02, 0, 0.1}, {0.02, 0, 0.2}));
    EXPECT_EQ(chamber.region->name(0), "chamber");
    EXPECT_EQ(chamber.region->nearest_solid({0.045, 0, 0.1}), 1u);
    EXPECT_EQ(chamber.region->nearest_solid({0, 0, 0.016}), 2u);
}

TEST(CommonPlace, is_found_in_bodies_that_overlap_and_only_there)
{
    auto const depth = [](Solid const& solid) {
        return [solid](Vec3 const& x) { return -surface_distance(solid, x).distance; };
    };
    auto const met = [&](Solid const& one, Solid const& other, double least) {
        return common_place(depth(one), depth(other), overlap(bounds(one), bounds(other)), least);
    };
    Solid const ball = Ball{{0, 0, 0}, 0.05};
    auto const place = met(ball, Ball{{0.099, 0, 0}, 0.05}, 1e-4);  // 1 mm deep
    ASSERT_TRUE(place);
    EXPECT_LT(norm(*place), 0.05);
    EXPECT_LT(norm(*place - Vec3{0.099, 0, 0}), 0.05);
    EXPECT_FALSE(met(ball, Ball{{0.099, 0, 0}, 0.05}, 6e-4)) << "at most 0.5 mm deep in both";
    EXPECT_FALSE(met(ball, Ball{{0.1001, 0, 0}, 0.05}, 1e-6));
    EXPECT_FALSE(met(ball, Ball{{0.06, 0.06, 0.06}, 0.05}, 1e-6)) << "their boxes overlap, they do not";
    Solid const block = Box{{0, 0, 0}, {0.1, 0.1, 0.1}};
    EXPECT_FALSE(met(block, Box{{0.1, 0, 0}, {0.2, 0.1, 0.1}}, 1e-5)) << "face to face";
    EXPECT_TRUE(met(block, cylinder({0.05, 0.05, -1}, up, 3, 0.002), 1e-4)) << "a rod through it";
}

TEST(CutOutline, is_crossed_where_the_wall_is)
{
    auto const open = funnel() - Region("tube", tube({0, 0, 1.05}, up, 0.2, 0.03, 0.04));
    auto const pieces = cut_outline(open, 0);
    std::vector<double> at;
    double const z = 1.1501;
    for (std::size_t k = 0; k + 2 < pieces.size(); k += 3) {
        auto const &a = pieces[k], &b = pieces[k + 1];
        EXPECT_TRUE(std::isnan(pieces[k + 2][1]));
        if ((a[1] <= z) != (b[1] <= z)) at.push_back(a[0] + (z - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    }
    std::sort(at.begin(), at.end());
    double const r = 0.05 + 0.05 * 0.1501 / 0.2;
    std::vector<double> const expected{-r, -0.04, -0.03, 0.03, 0.04, r};
    ASSERT_EQ(at.size(), expected.size());
    for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(at[k], expected[k], 2e-5) << k;
}
}
