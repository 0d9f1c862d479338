// Contacts of a sphere with a body: one per side that it touches, none for seams.
#include "granum/geometry/body_search.hpp"

#include "scene/meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace granum::geometry;
using namespace granum::scene;

namespace
{
struct Touched
{
    std::size_t count;
    std::array<Nearest, most_touches> at;
};

Touched touched(BodySearch const& search, Vec3 const& centre, double radius)
{
    std::vector<std::uint32_t> facets;
    search.near(centre, 1.25 * radius, facets);
    BodySearch::Scratch scratch;
    Touched out{};
    out.count = search.touches(centre, radius, facets, scratch, out.at);
    return out;
}

BodySearch of(std::vector<Shape> shapes)
{
    return BodySearch({.name = "body", .shapes = std::move(shapes)});
}

Vec3 random_point(std::mt19937& random, Vec3 const& lower, Vec3 const& upper)
{
    Vec3 out;
    for (std::size_t d = 0; d < 3; ++d)
        out[d] = lower[d] + (upper[d] - lower[d]) * static_cast<double>(random()) / 4294967296.0;
    return out;
}
}

TEST(CoplanarTriangles, are_one_plane_at_every_place_and_overlap)
{
    auto const search = of({jittered_sheet({0, 0, 0}, {10, 0, 0}, {0, 5, 0}, 10, 5)});
    for (double const overlap : {1e-6, 0.003, 0.05, 0.4})
        for (int k = 0; k <= 4000; ++k) {
            auto const found = touched(search, {1 + 8.0 * k / 4000, 1 + 3.0 * k / 4000, 1 - overlap}, 1);
            ASSERT_EQ(found.count, 1u) << "overlap " << overlap << ", place " << k;
            EXPECT_EQ(found.at[0].normal, (Vec3{0, 0, 1}));
            EXPECT_DOUBLE_EQ(found.at[0].distance, 1 - overlap);
        }
}

TEST(CoplanarTriangles, with_hanging_corners_and_doubled_faces_are_one_plane)
{
    Mesh mesh{{{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{4, 4, 0}},
               {Vec3{0, 0, 0}, Vec3{2, 2, 0}, Vec3{0, 4, 0}},
               {Vec3{2, 2, 0}, Vec3{4, 4, 0}, Vec3{0, 4, 0}}}};
    mesh.triangles.push_back(mesh.triangles.front());
    auto const search = of({mesh});
    for (int k = 0; k < 2000; ++k) {
        auto const found = touched(search, {2 + 1.5 * std::sin(0.1 * k), 2 + 1.5 * std::sin(0.17 * k), 0.9}, 1);
        ASSERT_EQ(found.count, 1u);
        EXPECT_NEAR(found.at[0].distance, 0.9, 1e-14);
        EXPECT_NEAR(found.at[0].normal.z, 1, 1e-14);
    }
}

TEST(ConvexBody, has_one_contact_at_the_distance_of_a_box)
{
    Vec3 const half{1, 2, 3};
    auto const search = of({box_mesh(-half, half)});
    std::mt19937 random(7);
    int faces = 0, edges = 0, corners = 0;
    for (int k = 0; k < 20000; ++k) {
        Vec3 const centre = random_point(random, {-2, -3, -4}, {2, 3, 4});
        Vec3 beyond;
        for (std::size_t d = 0; d < 3; ++d) beyond[d] = std::max(0.0, std::abs(centre[d]) - half[d]);
        double const distance = norm(beyond);
        if (distance < 0.5 || distance >= 0.8) continue;  // as deep as a run goes before it stops
        auto const found = touched(search, centre, 0.8);
        ASSERT_EQ(found.count, 1u) << centre.x << " " << centre.y << " " << centre.z;
        EXPECT_NEAR(found.at[0].distance, distance, 1e-12);
        Vec3 normal;
        int beyonds = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            normal[d] = std::copysign(beyond[d], centre[d]) / distance;
            beyonds += beyond[d] > 0;
        }
        EXPECT_NEAR(dot(found.at[0].normal, normal), 1, 1e-12);
        (beyonds == 1 ? faces : beyonds == 2 ? edges : corners) += 1;
    }
    EXPECT_GT(faces, 100);
    EXPECT_GT(edges, 100);
    EXPECT_GT(corners, 100);
}

TEST(ReentrantCorner, of_triangles_has_the_contacts_of_planes)
{
    Vec3 const half{1, 1, 1};
    auto const mesh = of({box_mesh(-half, half)}), planes = of(box_inside(-half, half));
    std::mt19937 random(11);
    std::array<int, 4> seen{};
    for (int k = 0; k < 20000; ++k) {
        Vec3 const centre = random_point(random, -0.85 * half, 0.85 * half);
        auto const a = touched(mesh, centre, 0.25), b = touched(planes, centre, 0.25);
        ASSERT_EQ(a.count, b.count);
        for (std::size_t c = 0; c < a.count; ++c) {
            EXPECT_NEAR(a.at[c].distance, b.at[c].distance, 1e-13);
            EXPECT_NEAR(dot(a.at[c].normal, b.at[c].normal), 1, 1e-13);
        }
        ++seen[std::min<std::size_t>(a.count, 3)];
    }
    for (int const count : seen) EXPECT_GT(count, 10);
}

TEST(FinelyFacettedCylinder, is_the_cylinder_to_the_height_of_its_facets)
{
    int const around = 180;
    auto const mesh = of({cylinder_mesh(1, -1, 1, around)});
    auto const drum =
        of({Frustum{.base = {0, 0, -1}, .length = 2, .base_radius = 1, .top_radius = 1, .side = Side::both}});
    double const sagitta = 1 - std::cos(granum::math::pi / around), tilt = granum::math::pi / around;
    for (double const away : {0.86, 1.14})
        for (int k = 0; k < 3000; ++k) {
            Vec3 const centre{away * std::cos(0.01 * k), away * std::sin(0.01 * k), 0.5 * std::sin(0.37 * k)};
            auto const a = touched(mesh, centre, 0.15), b = touched(drum, centre, 0.15);
            ASSERT_EQ(a.count, 1u) << "angle " << 0.01 * k;
            ASSERT_EQ(b.count, 1u);
            EXPECT_NEAR(a.at[0].distance, b.at[0].distance, sagitta);
            EXPECT_GT(dot(a.at[0].normal, b.at[0].normal), std::cos(1.01 * tilt));
        }
}

TEST(ConcaveFacets, overlap_goes_on_where_the_nearest_facet_changes)
{
    auto const mesh = of({cylinder_mesh(1, -1, 1, 90)});
    double before = touched(mesh, {0.87, 0, 0}, 0.15).at[0].distance;
    for (int k = 1; k < 20000; ++k) {
        double const angle = 1e-4 * k;
        auto const found = touched(mesh, {0.87 * std::cos(angle), 0.87 * std::sin(angle), 0}, 0.15);
        ASSERT_EQ(found.count, 1u);
        EXPECT_NEAR(found.at[0].distance, before, 1e-5);
        before = found.at[0].distance;
    }
}

TEST(SphereInABody, is_touched_once_and_together_with_a_plane_in_the_wedge_between_them)
{
    auto const bowl = of({Sphere{.centre = {0, 0, 1}, .radius = 1, .side = Side::inside}});
    auto const in_bowl = touched(bowl, {0.3, 0, 0.3}, 0.4);
    ASSERT_EQ(in_bowl.count, 1u);
    EXPECT_NEAR(in_bowl.at[0].distance, 1 - std::hypot(0.3, 0.7), 1e-14);
    EXPECT_EQ(touched(bowl, {0, 0, 1}, 0.4).count, 0u);
    auto const ball =
        of({Sphere{.centre = {0, 0, 1}, .radius = 1, .side = Side::outside}, Plane{{0, 0, 0}, {0, 0, 1}}});
    auto const wedged = touched(ball, {0.85, 0, 0.19}, 0.2);
    ASSERT_EQ(wedged.count, 2u);
    EXPECT_NEAR(wedged.at[0].distance, std::hypot(0.85, 0.81) - 1, 1e-14);
    EXPECT_NEAR(wedged.at[1].distance, 0.19, 1e-14);
}

TEST(ThinSheet, is_met_on_the_side_of_the_centre_and_around_its_edge)
{
    auto const search = of({jittered_sheet({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 3, 3)});
    EXPECT_EQ(touched(search, {0.1, 0.2, -0.25}, 0.3).at[0].normal, (Vec3{0, 0, -1}));
    auto const beside = touched(search, {1.2, 0.1, 0.1}, 0.3);
    ASSERT_EQ(beside.count, 1u);
    EXPECT_NE(beside.at[0].feature, Feature::face);
    EXPECT_NEAR(beside.at[0].distance, std::hypot(0.2, 0.1), 1e-14);
    EXPECT_EQ(touched(search, {1.2, 1.2, 0.2}, 0.3).count, 0u);
}

TEST(SectionsOfAChamber, push_once_where_they_meet)
{
    std::vector<Shape> const shapes{
        Plane{{0, 0, 0}, {0, 0, 1}},
        Frustum{.base = {}, .length = 0.4, .base_radius = 0.1, .top_radius = 0.2, .side = Side::inside},
        Frustum{.base = {0, 0, 0.4}, .length = 0.4, .base_radius = 0.2, .top_radius = 0.2, .side = Side::inside},
        Frustum{.base = {0, 0, 0.8}, .length = 0.4, .base_radius = 0.2, .top_radius = 0.3, .side = Side::inside}};
    auto const search = of(shapes);
    double before = touched(search, {0.1125 - 0.018, 0, 0.05}, 0.02).at[0].distance;
    for (int k = 0; k <= 10000; ++k) {  // up along the wall: a reentrant kink at 0.4, a convex one at 0.8
        double const z = 0.05 + 1.0 * k / 10000;
        double const wall = z < 0.4 ? 0.1 + 0.25 * z : z < 0.8 ? 0.2 : 0.2 + 0.25 * (z - 0.8);
        auto const found = touched(search, {wall - 0.018, 0, z}, 0.02);
        ASSERT_GE(found.count, 1u) << "z = " << z;
        // The cone makes 14 degrees with the cylinder: two sides are touched in the reentrant kink only.
        ASSERT_LE(found.count, std::abs(z - 0.4) < 0.01 ? 2u : 1u) << "z = " << z;
        EXPECT_NEAR(found.at[0].distance, before, 1.1e-4);
        before = found.at[0].distance;
    }
    EXPECT_EQ(touched(search, {0.09, 0, 0.01}, 0.02).count, 2u);
}

TEST(TriangleTree, finds_every_triangle_that_a_sphere_reaches_into)
{
    std::mt19937 random(3);
    Mesh mesh;
    for (int k = 0; k < 3000; ++k) {
        Vec3 const at = random_point(random, {0, 0, 0}, {1, 1, 1});
        auto const off = [&] { return at + random_point(random, {-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}); };
        mesh.triangles.push_back({off(), off(), off()});
    }
    auto const search = of({mesh});
    for (int k = 0; k < 300; ++k) {
        Vec3 const centre = random_point(random, {-0.1, -0.1, -0.1}, {1.1, 1.1, 1.1});
        std::vector<std::uint32_t> facets;
        search.near(centre, 0.1, facets);
        std::sort(facets.begin(), facets.end());
        std::vector<std::uint32_t> wanted;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            if (nearest(mesh.triangles[t], triangle_normal(mesh.triangles[t]), centre).distance < 0.1)
                wanted.push_back(t);
        EXPECT_EQ(facets, wanted);
    }
}
