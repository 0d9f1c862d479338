// Solids: the distance is exact on both sides of the surface, the normal is its gradient.
#include "granum/geometry/solid.hpp"

#include "scene/closed_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace granum::geometry;
using namespace granum::scene;
using granum::math::pi;

namespace
{
Vec3 random_point(std::mt19937& random, Bounds const& box, double beyond)
{
    Vec3 out;
    for (std::size_t d = 0; d < 3; ++d) {
        double const size = box.upper[d] - box.lower[d];
        out[d] = box.lower[d] + size * ((1 + 2 * beyond) * static_cast<double>(random()) / 4294967296.0 - beyond);
    }
    return out;
}

//! Distances are exact if (1) their sign is that of `inside`, (2) the point at that distance along the normal lies on
//! the surface, and (3) they nowhere change faster than one moves: (2) bounds them from below, (1) and (3) from above.
using Is = std::function<bool(Vec3 const&)>;
void expect_exact(Solid const& solid, Is const& inside, Is const& on_surface, int tries)
{
    std::mt19937 random(5);
    Bounds const box = bounds(solid);
    double const size = box.size();
    Vec3 last;
    double at_last = 0;
    int within = 0;
    for (int k = 0; k < tries; ++k) {
        Vec3 const x = random_point(random, box, 0.3);
        auto const [distance, normal] = surface_distance(solid, x);
        if (std::abs(distance) > 1e-7 * size) {
            ASSERT_EQ(distance < 0, inside(x)) << x.x << " " << x.y << " " << x.z << ": " << distance;
        }
        within += distance < 0;
        ASSERT_NEAR(norm(normal), 1, 1e-12);
        Vec3 const foot = x - distance * normal;
        ASSERT_NEAR(surface_distance(solid, foot).distance, 0, 1e-12 * size);
        ASSERT_TRUE(on_surface(foot)) << "the foot of " << x.x << " " << x.y << " " << x.z << " is elsewhere";
        ASSERT_LE(std::abs(distance - at_last), norm(x - last) + (k == 0 ? 1e9 : 1e-12));
        Vec3 const aside =
            x + 0.02 * (random_point(random, {{}, size * Vec3{1, 1, 1}}, 0) - 0.5 * size * Vec3{1, 1, 1});
        ASSERT_LE(std::abs(distance - surface_distance(solid, aside).distance), norm(x - aside) + 1e-12);
        last = x, at_last = distance;
    }
    EXPECT_GT(within, tries / 100);
}

//! A point of the surface is one beside which there is inside and outside.
void expect_exact(Solid const& solid, Is const& inside)
{
    double const tiny = 1e-7 * bounds(solid).size();
    std::mt19937 random(6);
    auto const on_surface = [&](Vec3 const& foot) {
        int within = 0;
        for (int turn = 0; turn < 400; ++turn) {
            within += inside(foot + random_point(random, {{-tiny, -tiny, -tiny}, {tiny, tiny, tiny}}, 0));
            if (within > 0 && within <= turn) return true;
        }
        return false;
    };
    expect_exact(solid, inside, on_surface, 4000);
}

Vec3 const axis = Vec3{2, -1, 2} / 3.0, sideways = Vec3{1, 2, 0} / std::sqrt(5.0);
}

TEST(BoxSolid, has_the_distances_of_faces_edges_and_corners)
{
    Solid const box = Box{{0, 0, 0}, {4, 6, 8}};
    EXPECT_DOUBLE_EQ(surface_distance(box, {2, 3, 0.5}).distance, -0.5);
    EXPECT_EQ(surface_distance(box, {2, 3, 0.5}).normal, (Vec3{0, 0, -1}));
    EXPECT_DOUBLE_EQ(surface_distance(box, {2, 3, 9}).distance, 1);
    EXPECT_DOUBLE_EQ(surface_distance(box, {-3, 3, 12}).distance, 5);
    EXPECT_DOUBLE_EQ(surface_distance(box, {-2, -3, 14}).distance, 7);
    expect_exact(box, [](Vec3 const& x) { return x.x > 0 && x.x < 4 && x.y > 0 && x.y < 6 && x.z > 0 && x.z < 8; });
}

TEST(BallSolid, has_the_distance_to_its_centre_less_the_radius)
{
    expect_exact(Ball{{1, 2, 3}, 0.7}, [](Vec3 const& x) { return norm(x - Vec3{1, 2, 3}) < 0.7; });
}

TEST(HalfSpaceSolid, is_behind_its_plane)
{
    Solid const half = HalfSpace{{0, 0, 1}, axis};
    EXPECT_NEAR(surface_distance(half, Vec3{0, 0, 1} + 2.5 * axis + 7.0 * sideways).distance, 2.5, 1e-14);
    EXPECT_NEAR(surface_distance(half, Vec3{0, 0, 1} - 2.5 * axis).distance, -2.5, 1e-14);
}

TEST(CylinderSolid, has_the_distances_of_flank_end_and_rim_about_any_axis)
{
    Vec3 const base{1, -2, 0.5};
    Solid const solid = cylinder(base, axis, 4, 2);
    auto const at = [&](double along, double away) {
        return surface_distance(solid, base + along * axis + away * sideways).distance;
    };
    EXPECT_NEAR(dot(axis, sideways), 0, 1e-15);
    EXPECT_NEAR(at(2, 3), 1, 1e-14);
    EXPECT_NEAR(at(2, 1.5), -0.5, 1e-14);
    EXPECT_NEAR(at(3.9, 1), -0.1, 1e-14);
    EXPECT_NEAR(at(7, 6), 5, 1e-14);  // 3 up and 4 out of the rim
    EXPECT_NEAR(at(-1, 0), 1, 1e-14);
    expect_exact(solid, [&](Vec3 const& x) {
        double const along = dot(x - base, axis), away = norm(x - base - along * axis);
        return along > 0 && along < 4 && away < 2;
    });
}

TEST(ConeSolid, has_the_distance_along_the_normal_of_its_flank)
{
    // Flank from (radius 1, height 0) to (4, 4): length 5, normal (0.8, -0.6).
    Solid const solid = cone_frustum({}, {0, 0, 1}, 4, 1, 4);
    EXPECT_NEAR(surface_distance(solid, Vec3{2.5, 0, 2} + 0.3 * Vec3{0.8, 0, -0.6}).distance, 0.3, 1e-14);
    EXPECT_NEAR(surface_distance(solid, Vec3{2.5, 0, 2} - 0.3 * Vec3{0.8, 0, -0.6}).distance, -0.3, 1e-14);
    EXPECT_NEAR(surface_distance(solid, {0, 0, 0.2}).distance, -0.2, 1e-14);
    expect_exact(solid, [](Vec3 const& x) { return x.z > 0 && x.z < 4 && std::hypot(x.x, x.y) < 1 + 0.75 * x.z; });
    expect_exact(cone_frustum({}, {0, 0, 1}, 2, 1, 0),
                 [](Vec3 const& x) { return x.z > 0 && x.z < 2 && std::hypot(x.x, x.y) < 1 - 0.5 * x.z; });
}

TEST(TubeSolid, is_hollow_and_open_at_both_ends)
{
    Solid const solid = tube({}, {0, 0, 1}, 3, 0.9, 1);
    EXPECT_NEAR(surface_distance(solid, {0, 0, 1.5}).distance, 0.9, 1e-14);
    EXPECT_NEAR(surface_distance(solid, {0, 0.94, 1.5}).distance, -0.04, 1e-14);
    EXPECT_NEAR(surface_distance(solid, {0, 0.5, 3.3}).distance, 0.5, 1e-14);  // 0.4 out and 0.3 up to the inner rim
    expect_exact(solid, [](Vec3 const& x) {
        double const away = std::hypot(x.x, x.y);
        return x.z > 0 && x.z < 3 && away > 0.9 && away < 1;
    });
}

TEST(TurnedSolid, is_the_inside_of_its_profile_in_either_order_of_corners)
{
    std::vector<ProfilePoint> const profile{{0, 0.09}, {0.2, 0.2}, {0.45, 0.125}, {0.45, 0.2}, {1, 0.05}};
    auto const radius = [&](double z) {
        double out = 0;
        for (std::size_t k = 1; k < profile.size(); ++k)
            if (z > profile[k - 1].height && z <= profile[k].height)
                out = profile[k - 1].radius + (z - profile[k - 1].height) /
                                                  (profile[k].height - profile[k - 1].height) *
                                                  (profile[k].radius - profile[k - 1].radius);
        return out;
    };
    auto const inside = [&](Vec3 const& x) { return x.z > 0 && x.z < 1 && std::hypot(x.x, x.y) < radius(x.z); };
    expect_exact(turned(profile), inside);
    std::vector<ProfilePoint> const clockwise{{1, 0},     {1, 0.05}, {0.45, 0.2}, {0.45, 0.125},
                                              {0.2, 0.2}, {0, 0.09}, {0, 0}};
    expect_exact(Revolution({}, {0, 0, 1}, clockwise), inside);
}

TEST(ChamberSolid, has_the_inside_of_the_chamber)
{
    Chamber const round{.shape = Chamber::Shape::revolution, .profile = {{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}}};
    expect_exact(solid(round), [&](Vec3 const& x) { return round.inside(x); });
    Chamber const square{.size = {0.2, 0.1, 0.5}};
    expect_exact(solid(square), [&](Vec3 const& x) { return square.inside(x); });
}

TEST(Bounds, of_solids_are_tight)
{
    auto const box = bounds(cylinder({1, 2, 3}, {0.6, 0, 0.8}, 5, 1));
    // The end circles reach 0.8 along x, 1 along y and 0.6 along z.
    EXPECT_NEAR(box.lower.x, 1 - 0.8, 1e-14);
    EXPECT_NEAR(box.upper.x, 1 + 3 + 0.8, 1e-14);
    EXPECT_NEAR(box.lower.y, 1, 1e-14);
    EXPECT_NEAR(box.upper.z, 3 + 4 + 0.6, 1e-14);
}

TEST(Fault, is_told_of_what_is_no_solid)
{
    EXPECT_FALSE(fault(Box{{0, 0, 0}, {1, 1, 1}}));
    EXPECT_FALSE(fault(tube({}, {0, 0, 1}, 1, 0.1, 0.2)));
    double const nan = std::nan("");
    auto const said = [](Solid const& solid) { return fault(solid).value_or("(nothing)"); };
    EXPECT_NE(said(Box{{0, 0, 0}, {1, 0, 1}}).find("not above the lower"), std::string::npos);
    EXPECT_NE(said(Box{{nan, 0, 0}, {1, 1, 1}}).find("no number"), std::string::npos);
    EXPECT_NE(said(Ball{{}, 0}).find("no radius"), std::string::npos);
    EXPECT_NE(said(HalfSpace{{}, {0, 0, 2}}).find("no normal"), std::string::npos);
    EXPECT_NE(said(cylinder({}, {0, 0, 0}, 1, 1)).find("no axis"), std::string::npos);
    EXPECT_NE(said(cylinder({}, {0, 0, 1}, 0, 1)).find("no volume"), std::string::npos);
    EXPECT_NE(said(cylinder({}, {0, 0, 1}, 1, 0)).find("no volume"), std::string::npos);
    EXPECT_NE(said(tube({}, {0, 0, 1}, 1, 0.2, 0.2)).find("no volume"), std::string::npos);
    EXPECT_NE(said(cone_frustum({}, {0, 0, 1}, 1, 1, -1)).find("below 0"), std::string::npos);
    EXPECT_NE(said(Revolution({}, {0, 0, 1}, {{0, 0}, {1, 1}, {1, 0}, {0, 2}})).find("crosses itself"),
              std::string::npos);
    EXPECT_NE(said(Revolution({}, {0, 0, 1}, {})).find("no volume"), std::string::npos);
    EXPECT_NE(said(std::shared_ptr<ClosedMesh const>{}).find("no mesh"), std::string::npos);
}

TEST(ClosedMesh, of_a_box_has_the_distances_of_the_box)
{
    Vec3 const low{-1, 0, 2}, high{1, 3, 2.5};
    Solid const box = Box{low, high}, mesh = closed(box_surface(low, high, 3));
    EXPECT_NEAR(std::get<std::shared_ptr<ClosedMesh const>>(mesh)->volume(), 3, 1e-13);
    std::mt19937 random(1);
    for (int k = 0; k < 20000; ++k) {
        Vec3 const x = random_point(random, {low, high}, 0.4);
        auto const a = surface_distance(box, x), b = surface_distance(mesh, x);
        ASSERT_NEAR(a.distance, b.distance, 1e-13);
        if (std::abs(a.distance) > 1e-3 && dot(a.normal, b.normal) < 1 - 1e-9) {
            ASSERT_NEAR(surface_distance(box, x - a.distance * b.normal).distance, 0, 1e-9)
                << "the other nearest place";
        }
    }
}

//! Meshes on which the sign is easily got wrong.
struct Nasty
{
    char const* name;
    Triangles triangles;
};

class NastyMesh : public testing::TestWithParam<Nasty>
{
};

TEST_P(NastyMesh, has_exact_distances_with_the_sign_of_the_solid_angle)
{
    auto const& triangles = GetParam().triangles;
    auto const on_surface = [&](Vec3 const& x) {
        return std::any_of(triangles.begin(), triangles.end(),
                           [&](Triangle const& one) { return nearest(one, triangle_normal(one), x).distance < 1e-12; });
    };
    auto const inside = [&](Vec3 const& x) { return turns_round(triangles, x) > 0.5; };
    expect_exact(closed(triangles), inside, on_surface, static_cast<int>(4'000'000 / triangles.size()));
}

TEST_P(NastyMesh, has_the_right_sign_beside_its_edges_and_corners)
{
    auto const& triangles = GetParam().triangles;
    Solid const solid = closed(triangles);
    std::mt19937 random(3);
    double const size = bounds(solid).size();
    Vec3 const one{1, 1, 1};
    for (int k = 0; k < static_cast<int>(2'000'000 / triangles.size()); ++k) {
        auto const& triangle = triangles[random() % triangles.size()];
        double const part = k % 3 == 0 ? 0.0 : static_cast<double>(random()) / 4294967296.0;
        Vec3 const on_edge = triangle[0] + part * (triangle[1] - triangle[0]);
        double const far = size * std::pow(10.0, -1 - static_cast<double>(random() % 6));
        Vec3 const x = on_edge + random_point(random, {-far * one, far * one}, 0);
        double const distance = surface_distance(solid, x).distance;
        if (std::abs(distance) > 1e-9 * size) {
            ASSERT_EQ(distance<0, turns_round(triangles, x)> 0.5) << x.x << " " << x.y << " " << x.z;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, NastyMesh,
    testing::Values(
        Nasty{"sheet", box_surface({0, 0, 0}, {1, 1, 1e-4}, 4)},
        Nasty{"needle", turned_surface({{0, 0}, {0, 0.003}, {1, 0}}, 24)},
        Nasty{"knife",
              {{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0.01}},
               {Vec3{0, 0, 0}, {1, 1, 0.01}, {0, 1, 0.01}},
               {Vec3{0, 0, 0}, {1, 1, -0.01}, {1, 0, 0}},
               {Vec3{0, 0, 0}, {0, 1, -0.01}, {1, 1, -0.01}},
               {Vec3{0, 1, -0.01}, {0, 1, 0.01}, {1, 1, 0.01}},
               {Vec3{0, 1, -0.01}, {1, 1, 0.01}, {1, 1, -0.01}},
               {Vec3{0, 0, 0}, {0, 1, 0.01}, {0, 1, -0.01}},
               {Vec3{1, 0, 0}, {1, 1, -0.01}, {1, 1, 0.01}}}},
        Nasty{"star",
              rough_ball([](Vec3 const& n) { return 0.3 + 0.7 * std::pow(std::abs(n.x * n.y * n.z) * 5.2, 3); }, 12)},
        Nasty{"saddle_corner",
              {{Vec3{0, 0, 0}, {1, 0, 0.6}, {0.7, 0.7, -0.6}},
               {Vec3{0, 0, 0}, {0.7, 0.7, -0.6}, {0, 1, 0.6}},
               {Vec3{0, 0, 0}, {0, 1, 0.6}, {-0.7, 0.7, -0.6}},
               {Vec3{0, 0, 0}, {-0.7, 0.7, -0.6}, {-1, 0, 0.6}},
               {Vec3{0, 0, 0}, {-1, 0, 0.6}, {-0.7, -0.7, -0.6}},
               {Vec3{0, 0, 0}, {-0.7, -0.7, -0.6}, {0, -1, 0.6}},
               {Vec3{0, 0, 0}, {0, -1, 0.6}, {0.7, -0.7, -0.6}},
               {Vec3{0, 0, 0}, {0.7, -0.7, -0.6}, {1, 0, 0.6}},
               {Vec3{0, 0, -2}, {0.7, 0.7, -0.6}, {1, 0, 0.6}},
               {Vec3{0, 0, -2}, {0, 1, 0.6}, {0.7, 0.7, -0.6}},
               {Vec3{0, 0, -2}, {-0.7, 0.7, -0.6}, {0, 1, 0.6}},
               {Vec3{0, 0, -2}, {-1, 0, 0.6}, {-0.7, 0.7, -0.6}},
               {Vec3{0, 0, -2}, {-0.7, -0.7, -0.6}, {-1, 0, 0.6}},
               {Vec3{0, 0, -2}, {0, -1, 0.6}, {-0.7, -0.7, -0.6}},
               {Vec3{0, 0, -2}, {0.7, -0.7, -0.6}, {0, -1, 0.6}},
               {Vec3{0, 0, -2}, {1, 0, 0.6}, {0.7, -0.7, -0.6}}}},
        Nasty{"hollow_ball", together(ball_surface({}, 1, 10), turned_round(ball_surface({}, 0.95, 10)))}),
    [](auto const& one) { return std::string(one.param.name); });
