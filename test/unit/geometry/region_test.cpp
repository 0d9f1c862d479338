// Regions: what is open in an expression of solids, how far the wall is, who bounds, and what a line of sight meets.
#include "granum/geometry/region.hpp"

#include "granum/base/error.hpp"
#include "scene/closed_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace granum::geometry;
using namespace granum::scene;

namespace
{
Vec3 const up{0, 0, 1};

//! A chamber of a cone and a cylinder that touch, with a dome that overlaps, a tube in it and a nozzle through the
//! plate.
Region apparatus()
{
    return (Region("cone", cone_frustum({}, up, 0.4, 0.1, 0.2)) |
            Region("column", cylinder({0, 0, 0.4}, up, 0.6, 0.2)) | Region("dome", Ball{{0, 0, 1}, 0.2})) -
           Region("tube", tube({0, 0, 0.3}, up, 0.3, 0.08, 0.081)) -
           Region("nozzle", cylinder({0, 0, -0.1}, up, 0.25, 0.02));
}

bool open_in_apparatus(Vec3 const& x)
{
    double const r = std::hypot(x.x, x.y);
    bool const cone = x.z > 0 && x.z < 0.4 && r < 0.1 + 0.25 * x.z, column = x.z >= 0.4 && x.z < 1 && r < 0.2;
    bool const dome = norm(x - Vec3{0, 0, 1}) < 0.2;
    bool const wall = x.z > 0.3 && x.z < 0.6 && r > 0.08 && r < 0.081, nozzle = x.z < 0.15 && r < 0.02;
    return (cone || column || dome) && !wall && !nozzle;
}

Vec3 random_point(std::mt19937& random, Vec3 const& lower, Vec3 const& upper)
{
    Vec3 out;
    for (std::size_t d = 0; d < 3; ++d)
        out[d] = lower[d] + (upper[d] - lower[d]) * static_cast<double>(random()) / 4294967296.0;
    return out;
}
}

TEST(Region, distance_has_the_sign_of_open_and_no_wall_is_nearer)
{
    Region const region = apparatus();
    std::mt19937 random(4);
    int open = 0;
    for (int k = 0; k < 3000; ++k) {
        Vec3 const x = random_point(random, {-0.25, -0.25, -0.15}, {0.25, 0.25, 1.25});
        auto const wall = region.at(x);
        ASSERT_EQ(wall.distance > 0, open_in_apparatus(x)) << x.x << " " << x.y << " " << x.z;
        open += wall.distance > 0;
        EXPECT_NEAR(norm(wall.normal), 1, 1e-12);
        for (int turn = 0; turn < 200; ++turn) {
            Vec3 const to = random_point(random, {-1, -1, -1}, {1, 1, 1});
            Vec3 const y = x + (0.999999 * std::abs(wall.distance) / std::max(1.0, norm(to))) * to;
            ASSERT_EQ(open_in_apparatus(y), wall.distance > 0) << "beside " << x.x << " " << x.y << " " << x.z;
        }
    }
    EXPECT_GT(open, 900);
}

TEST(Region, normal_leads_from_the_wall_to_the_open)
{
    Region const region = apparatus();
    std::mt19937 random(4);
    for (int k = 0; k < 3000; ++k) {
        Vec3 const x = random_point(random, {-0.25, -0.25, -0.15}, {0.25, 0.25, 1.25});
        auto const wall = region.at(x);
        double const step = 1e-7;
        EXPECT_GT(region.distance(x + step * wall.normal), wall.distance - step) << "not towards the open";
        EXPECT_NEAR(region.distance(x - step * wall.normal), wall.distance - step, 1e-10);
    }
}

TEST(Region, knows_which_solid_bounds)
{
    Region const region = apparatus();
    auto const at = [&](Vec3 const& x) { return region.name(region.nearest_solid(x)); };
    EXPECT_EQ(at({0.19, 0, 0.8}), "column");
    EXPECT_EQ(at({0.11, 0, 0.1}), "cone");
    EXPECT_EQ(at({0, 0, 1.15}), "dome");
    EXPECT_EQ(at({0.075, 0, 0.5}), "tube");
    EXPECT_EQ(at({0.085, 0, 0.5}), "tube");
    EXPECT_EQ(at({0.03, 0, 0.1}), "nozzle");
    EXPECT_EQ(region.solids(), 5u);
    EXPECT_TRUE(region.open_inside(0));
    EXPECT_FALSE(region.open_inside(3));
}

TEST(Region, bounds_are_those_of_what_can_be_open)
{
    Region const region = apparatus();
    EXPECT_NEAR(norm(region.lower() - Vec3{-0.2, -0.2, 0}), 0, 1e-14);
    EXPECT_NEAR(norm(region.upper() - Vec3{0.2, 0.2, 1.2}), 0, 1e-14);
    Region const cut = region & Region("half", HalfSpace{{0, 0, 0.7}, up}) & Region("box", Box{{0, -1, -1}, {1, 1, 1}});
    EXPECT_NEAR(norm(cut.lower() - Vec3{0, -0.2, 0}), 0, 1e-14);
    EXPECT_FALSE(std::isfinite(Region("half", HalfSpace{{0, 0, 0.7}, up}).lower().x));
}

TEST(Region, difference_of_expressions_is_open_in_the_one_and_not_in_the_other)
{
    // A shell is a ball less a ball; taking it away leaves what is inside and outside of it.
    Region const shell = Region("outer", Ball{{}, 1}) - Region("inner", Ball{{}, 0.9});
    Region const rest = Region("box", Box{{-2, -2, -2}, {2, 2, 2}}) - shell;
    for (double const r : {0.0, 0.5, 0.89, 0.91, 0.99, 1.01, 1.9}) {
        EXPECT_EQ(rest.distance({r, 0, 0}) > 0, r < 0.9 || r > 1) << r;
        EXPECT_EQ(shell.distance({r, 0, 0}) > 0, r > 0.9 && r < 1) << r;
    }
    EXPECT_NEAR(rest.distance({0.5, 0, 0}), 0.4, 1e-14);
    EXPECT_NEAR(rest.distance({1.25, 0, 0}), 0.25, 1e-14);
    EXPECT_NEAR(rest.distance({0.94, 0, 0}), -0.04, 1e-14);
    Region const nested = (Region("a", Ball{{}, 1}) & Region("b", Ball{{0.5, 0, 0}, 1})) |
                          (Region("c", Ball{{3, 0, 0}, 1}) - Region("d", Ball{{3, 0, 0}, 0.5}));
    EXPECT_NEAR(nested.distance({0.25, 0, 0}), 0.75, 1e-14);
    EXPECT_LT(nested.distance({-0.75, 0, 0}), 0);
    EXPECT_LT(nested.distance({3, 0, 0}), 0);
    EXPECT_NEAR(nested.distance({3.75, 0, 0}), 0.25, 1e-14);
}

TEST(Region, a_bad_solid_is_a_wrong_case)
{
    try {
        Region const region("nozzle", cylinder({}, up, 0, 1));
        FAIL() << "no complaint";
    } catch (granum::base::CaseError const& error) {
        EXPECT_EQ(std::string(error.what()), "nozzle encloses no volume: a length or a radius is 0");
        EXPECT_EQ(static_cast<int>(error.exit), 2);
    }
}

TEST(Sight, ends_at_walls_of_any_thickness)
{
    for (double const thickness : {1e-1, 1e-3, 1e-5, 1e-7}) {
        Region const region = Region("box", Box{{-1, -1, -1}, {1, 1, 1}}) -
                              Region("plate", Box{{-2, -2, 0.123}, {2, 2, 0.123 + thickness}});
        EXPECT_TRUE(region.blocked({0.1, 0.2, -0.5}, {0.3, 0.1, 0.5})) << thickness;
        EXPECT_TRUE(region.blocked({-0.9, 0.2, 0.12}, {0.9, 0.1, 0.126 + thickness})) << thickness;
        EXPECT_FALSE(region.blocked({0.1, 0.2, -0.5}, {0.3, 0.1, 0.122}));
        EXPECT_FALSE(region.blocked({-0.9, 0.2, 0.1229}, {0.9, 0.1, 0.1229}));
    }
}

TEST(Sight, passes_through_holes_and_seams_only)
{
    Region const region = apparatus();
    EXPECT_FALSE(region.blocked({0, 0, 0.2}, {0, 0, 0.9})) << "through the tube and the seam";
    EXPECT_FALSE(region.blocked({0.15, 0, 0.3}, {0.15, 0, 1.1})) << "beside the tube";
    EXPECT_FALSE(region.blocked({-0.15, 0.1, 0.4}, {0.15, 0.1, 0.4})) << "within the seam, past the tube";
    EXPECT_TRUE(region.blocked({-0.15, 0, 0.4}, {0.15, 0, 0.4})) << "within the seam, through the tube";
    EXPECT_TRUE(region.blocked({0, 0, 0.5}, {0.15, 0, 0.5}));
    EXPECT_TRUE(region.blocked({0.05, 0, 0.1}, {-0.05, 0, 0.1})) << "through the nozzle";
    EXPECT_TRUE(region.blocked({0, 0, 0.5}, {0.5, 0, 0.5})) << "the end is outside";
    EXPECT_TRUE(region.blocked({0.0805, 0, 0.5}, {0, 0, 0.5})) << "it begins in the wall";
    EXPECT_TRUE(region.blocked({0.19, 0, 0.41}, {0.12, 0, 0.01})) << "the cone is convex, but this end is outside";
    EXPECT_FALSE(region.blocked({0.1, 0.1, 0.7}, {0.1, 0.1, 0.7}));
}

TEST(Sight, agrees_with_looking_everywhere_along_the_line)
{
    Region const region = apparatus();
    std::mt19937 random(9);
    int seen = 0, hidden = 0;
    for (int k = 0; k < 3000; ++k) {
        Vec3 const a = random_point(random, {-0.2, -0.2, 0}, {0.2, 0.2, 1.2});
        Vec3 const b = random_point(random, {-0.2, -0.2, 0}, {0.2, 0.2, 1.2});
        if (!open_in_apparatus(a) || !open_in_apparatus(b)) continue;
        bool open = true;
        for (int step = 0; step <= 20000 && open; ++step) open = open_in_apparatus(a + (step / 20000.0) * (b - a));
        bool const blocked = region.blocked(a, b);
        if (!open) {
            EXPECT_TRUE(blocked);
        }
        // A line that only grazes a wall may have been missed by looking at places.
        if (open && blocked) {
            double least = 1;
            for (int step = 0; step <= 20000; ++step)
                least = std::min(least, region.distance(a + (step / 20000.0) * (b - a)));
            EXPECT_LT(least, 1e-4);
        }
        ++(blocked ? hidden : seen);
    }
    EXPECT_GT(seen, 200);
    EXPECT_GT(hidden, 200);
}

TEST(OpenPlace, is_the_middle_or_beside_the_wall_that_fills_it)
{
    Vec3 const low{0, 0, 0}, high{1, 1, 1}, middle{0.5, 0.5, 0.5};
    Region const box("box", Box{{-5, -5, -5}, {5, 5, 5}});
    EXPECT_LT(norm(*open_place(box, low, high) - middle), 0.04);
    Region const plate = box - Region("plate", Box{{-9, -9, 0.3}, {9, 9, 0.7}});
    auto const beside = open_place(plate, low, high);
    ASSERT_TRUE(beside);
    EXPECT_GT(plate.distance(*beside), 0);
    EXPECT_TRUE(beside->z < 0.3 || beside->z > 0.7);
    // All but a corner is closed.
    Region const corner = box - Region("block", Box{{-9, -9, -9}, {0.9, 9, 9}});
    EXPECT_GT(corner.distance(open_place(corner, low, high).value()), 0);
    EXPECT_FALSE(open_place(box, {6, 6, 6}, {7, 7, 7}));
}
