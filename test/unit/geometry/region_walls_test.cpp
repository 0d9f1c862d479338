// Walls for granules: exact shapes where a solid stands alone, triangles for the rest, and both where the wall is.
#include "granum/geometry/region_walls.hpp"

#include "scene/closed_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace granum::geometry;
using namespace granum::scene;

namespace
{
Vec3 const up{0, 0, 1};

double distance_to(Mesh const& mesh, Vec3 const& x)
{
    double least = 10;
    for (auto const& triangle : mesh.triangles)
        least = std::min(least, nearest(triangle, triangle_normal(triangle), x).distance);
    return least;
}
template <class Smooth>
double distance_to(Smooth const& shape, Vec3 const& x)
{
    return nearest(shape, x).distance;
}

double distance_to(std::vector<Body> const& bodies, Vec3 const& x)
{
    double least = 10;
    for (auto const& body : bodies)
        for (auto const& shape : body.shapes)
            least = std::min(least, std::visit([&](auto const& one) { return distance_to(one, x); }, shape));
    return least;
}

//! In the open the walls must be as far as the region says, to the height of facets. Beside a seam of joined solids the
//! region says less.
void expect_walls(Region const& region, std::vector<Body> const& bodies, double off, bool seam = false)
{
    std::mt19937 random(2);
    auto const draw = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    int open = 0;
    for (int k = 0; k < 3000 && open < 300; ++k) {
        Vec3 const low = region.lower(), high = region.upper();
        Vec3 const x{draw(low.x, high.x), draw(low.y, high.y), draw(low.z, high.z)};
        double const distance = region.distance(x);
        if (distance <= 0) continue;
        ++open;
        double const found = distance_to(bodies, x);
        EXPECT_GT(found, distance - off) << x.x << " " << x.y << " " << x.z;
        if (!seam) {
            EXPECT_LT(found, distance + off) << x.x << " " << x.y << " " << x.z;
        }
    }
    EXPECT_GT(open, 100);
}

template <class One>
int count(std::vector<Body> const& bodies)
{
    int out = 0;
    for (auto const& body : bodies)
        for (auto const& shape : body.shapes) out += std::holds_alternative<One>(shape);
    return out;
}
}

TEST(SurfaceShapes, of_every_solid_are_where_its_surface_is)
{
    Vec3 const axis = Vec3{2, -1, 2} / 3.0;
    std::vector<ProfilePoint> const profile{{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}},
        waist{{0, 0.3}, {0.3, 0.1}, {0.6, 0.4}};
    for (Solid const& solid :
         {Solid{Box{{-1, 0, 2}, {1, 2, 3}}}, Solid{Ball{{1, 2, 3}, 0.5}}, Solid{cylinder({1, 0, 0}, axis, 1, 0.4)},
          Solid{cone_frustum({1, 0, 0}, axis, 1, 0.4, 0)}, Solid{tube({1, 0, 0}, axis, 1, 0.35, 0.4)},
          Solid{turned(profile)}, Solid{turned(waist)}, Solid{closed(ball_surface({}, 1, 12))}}) {
        Region const inside("inside", solid);
        expect_walls(inside, {{.name = "wall", .shapes = surface_shapes(solid, true)}}, 1e-12);
        // Around it, in a box with walls far away.
        Bounds const box = bounds(solid);
        Vec3 const beyond = 0.2 * (box.upper - box.lower);
        Region const around = Region("box", Box{box.lower - beyond, box.upper + beyond}) - inside;
        std::vector<Body> bodies{{.name = "wall", .shapes = surface_shapes(solid, false)},
                                 {.name = "box", .shapes = box_inside(around.lower(), around.upper())}};
        expect_walls(around, bodies, 1e-12);
    }
    auto const plane = std::get<Plane>(surface_shapes(HalfSpace{{0, 0, 1}, up}, true).at(0));
    EXPECT_EQ(plane.normal, -up);
}

TEST(WallBodies, of_solids_that_stand_alone_are_exact)
{
    Region const region = Region("chamber", turned({{0, 0.2}, {0.4, 0.4}, {1, 0.4}})) -
                          Region("tube", tube({0, 0, 0.3}, up, 0.4, 0.2, 0.204)) -
                          Region("ball", Ball{{0, 0, 0.5}, 0.05});
    auto const bodies = wall_bodies(region, 0.03);
    ASSERT_EQ(bodies.size(), 3u);
    EXPECT_EQ(bodies[0].name, "chamber");
    EXPECT_EQ(bodies[1].name, "tube");
    EXPECT_EQ(count<Plane>(bodies), 2);
    EXPECT_EQ(count<Frustum>(bodies), 2 + 2);
    EXPECT_EQ(count<Disc>(bodies), 2);
    EXPECT_EQ(count<Sphere>(bodies), 1);
    EXPECT_EQ(count<Mesh>(bodies), 0);
    EXPECT_EQ(std::get<Frustum>(bodies[0].shapes[1]).side, Side::inside);
    expect_walls(region, bodies, 1e-12);
}

TEST(WallBodies, of_solids_that_meet_are_one_mesh)
{
    double const resolution = 0.025;
    Region const region = Region("column", cylinder({}, up, 1, 0.4)) -
                          Region("nozzle", cylinder({0.1, 0, -0.1}, up, 0.3, 0.1)) -
                          Region("ball", Ball{{0, 0, 0.6}, 0.1});
    auto const bodies = wall_bodies(region, resolution);
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[0].name, "ball");
    EXPECT_EQ(bodies[1].name, "column");
    EXPECT_EQ(count<Mesh>(bodies), 1);
    // Chords of the nozzle, of up to 1.5 h: h^2 / 8 r.
    expect_walls(region, bodies, 2.25 * resolution * resolution / (8 * 0.1));
}

TEST(WallBodies, of_joined_solids_and_of_internals_that_touch_are_meshes)
{
    double const resolution = 0.05;
    Region const chamber =
        Region("low", Box{{-1, -1, 0}, {1, 1, 1}}) | Region("high", Box{{-0.5, -0.5, 1}, {0.5, 0.5, 2}});
    expect_walls(chamber, wall_bodies(chamber, resolution), 2e-3 * resolution, true);
    // A corner of the step and one of the upper box.
    for (Vec3 const& on : {Vec3{0.5, 0.5, 1}, Vec3{-0.5, 0.5, 2}, Vec3{0.7, 0.2, 1}})
        EXPECT_LT(distance_to(wall_bodies(chamber, resolution), on), 2e-3 * resolution);
    // The chamber stands alone, the two blocks in it do not: their surface is drawn in endless space.
    Region const blocks = Region("room", Box{{-1, -1, -1}, {1, 1, 1}}) -
                          Region("a", Box{{-0.5, -0.5, -0.5}, {0, 0.3, 0.2}}) -
                          Region("b", Box{{-0.2, -0.2, -0.2}, {0.5, 0.5, 0.5}});
    auto const bodies = wall_bodies(blocks, resolution);
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(count<Plane>(bodies), 6);
    EXPECT_EQ(bodies[1].name, "a");
    expect_walls(blocks, bodies, 2e-3 * resolution);
}

TEST(Region, without_solids_that_bound_everywhere_is_the_rest)
{
    Region const region =
        (Region("a", Ball{{}, 1}) | Region("b", Ball{{1, 0, 0}, 1})) - Region("c", Ball{{0.5, 0, 0}, 0.3});
    EXPECT_FALSE(region.bounds_everywhere(0));
    EXPECT_TRUE(region.bounds_everywhere(2));
    EXPECT_LT(region.distance({0.5, 0, 0}), 0);
    EXPECT_GT(region.without({2})->distance({0.5, 0, 0}), 0);
    EXPECT_FALSE(Region("a", Ball{{}, 1}).without({0}));
    EXPECT_GT((~region).distance({0.5, 0, 0}), 0);
    EXPECT_LT((~region).distance({0, 0, 0}), 0);
}
