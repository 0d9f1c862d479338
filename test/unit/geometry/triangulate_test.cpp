// The wall of a region as triangles: closed, on the wall, with its edges and corners.
#include "granum/geometry/triangulate.hpp"

#include "granum/base/error.hpp"
#include "granum/geometry/body_search.hpp"
#include "scene/closed_meshes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace granum::geometry;
using namespace granum::scene;
using granum::math::pi;

namespace
{
Vec3 const up{0, 0, 1};

//! Edges that are not gone along in the one direction as often as in the other.
int open_edges(Mesh const& mesh)
{
    auto const corners = join_corners(mesh.triangles, 0);
    int open = 0;
    auto const edges = find_edges(corners);
    for (auto const& edge : edges.edges) {
        int balance = 0;
        for (auto const& use : edges.at(edge)) balance += use.forward ? 1 : -1;
        open += balance != 0;
    }
    return open;
}

//! Volume that the normals point into, as they lead to the open.
double enclosed(Mesh const& mesh)
{
    double sum = 0;
    for (auto const& [a, b, c] : mesh.triangles) sum -= dot(a, cross(b, c)) / 6;
    return sum;
}

double farthest_corner(Region const& region, Mesh const& mesh)
{
    double out = 0;
    for (auto const& triangle : mesh.triangles)
        for (auto const& corner : triangle) out = std::max(out, std::abs(region.distance(corner)));
    return out;
}

double distance_to(BodySearch const& search, Vec3 const& x, double reach)
{
    std::vector<std::uint32_t> facets;
    search.near(x, reach, facets);
    BodySearch::Scratch scratch;
    std::array<Nearest, most_touches> out;
    return search.touches(x, reach, facets, scratch, out) > 0 ? out[0].distance : reach;
}
}

TEST(Triangulate, a_box_has_its_exact_edges_and_corners)
{
    Region const region("box", Box{{0, 0, 0}, {0.31, 0.22, 0.4}});
    for (double const resolution : {0.1, 0.031}) {
        auto const mesh = triangulate(region, resolution);
        EXPECT_EQ(open_edges(mesh), 0);
        EXPECT_LT(farthest_corner(region, mesh), 1e-3 * resolution);
        EXPECT_NEAR(enclosed(mesh) / (0.31 * 0.22 * 0.4), 1, 1e-5);
        BodySearch const search({.name = "mesh", .shapes = {mesh}});
        for (Vec3 const& on : {Vec3{0, 0, 0}, Vec3{0.31, 0.22, 0.4}, Vec3{0, 0.22, 0.117}, Vec3{0.17, 0, 0.4}})
            EXPECT_LT(distance_to(search, on, 0.01), 1e-3 * resolution);
    }
}

TEST(Triangulate, a_tilted_body_has_its_edges_and_corners)
{
    // A cube on its corner, of half spaces; its volume is that of the cube.
    Vec3 const x = Vec3{1, 2, 2} / 3.0, y = Vec3{2, 1, -2} / 3.0, z = Vec3{2, -2, 1} / 3.0;
    Region region("ball", Ball{{}, 2});
    for (auto const& n : {x, y, z}) region = region & Region("a", HalfSpace{n, n}) & Region("b", HalfSpace{-n, -n});
    auto const mesh = triangulate(region, 0.13);
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_LT(farthest_corner(region, mesh), 1e-3 * 0.13);
    EXPECT_NEAR(enclosed(mesh) / 8, 1, 1e-4);
    BodySearch const search({.name = "mesh", .shapes = {mesh}});
    for (double const a : {-1.0, 1.0})
        for (double const b : {-1.0, 1.0}) {
            EXPECT_LT(distance_to(search, a * x + b * y + z, 0.1), 1e-3 * 0.13) << "corner";
            EXPECT_LT(distance_to(search, a * x + b * y + 0.37 * z, 0.1), 1e-3 * 0.13) << "edge";
        }
}

TEST(Triangulate, a_ball_has_its_volume_but_for_the_height_of_its_facets)
{
    Region const region("ball", Ball{{0.1, 0.2, 0.3}, 0.5});
    for (double const resolution : {0.1, 0.05}) {
        auto const mesh = triangulate(region, resolution);
        EXPECT_EQ(open_edges(mesh), 0);
        EXPECT_LT(farthest_corner(region, mesh), 1e-3 * resolution);
        // Facets with corners on the sphere lie up to h^2 / 8 R below it, about h^2 / 12 R in the mean.
        double const lost = 1 - enclosed(mesh) / (4.0 / 3 * pi * 0.125);
        EXPECT_GT(lost, 0);
        EXPECT_LT(lost, 3 * resolution * resolution / (4 * 0.5 * 0.5));
    }
}

TEST(Triangulate, rims_of_a_cylinder_and_a_nozzle_through_its_wall_are_kept)
{
    Vec3 const axis = Vec3{1, 0, 2} / std::sqrt(5.0);
    Region const region = Region("column", cylinder({}, up, 1, 0.4)) -
                          Region("nozzle", cylinder(Vec3{0.1, 0.05, 0.4} - 0.6 * axis, axis, 0.7, 0.08));
    double const resolution = 0.03;
    auto const mesh = triangulate(region, resolution);
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_LT(farthest_corner(region, mesh), 1e-3 * resolution);
    BodySearch const search({.name = "mesh", .shapes = {mesh}});
    double worst = 0;
    for (int k = 0; k < 500; ++k) {
        double const angle = 2 * pi * k / 500;
        Vec3 const out{std::cos(angle), std::sin(angle), 0};
        worst = std::max(worst, distance_to(search, 0.4 * out + up, 0.02));
        Vec3 const side = cross(axis, Vec3{0, 1, 0});
        Vec3 const tip = Vec3{0.1, 0.05, 0.4} + 0.1 * axis;
        worst = std::max(worst, distance_to(search, tip + 0.08 * (out.x * side + out.y * Vec3{0, 1, 0}), 0.02));
    }
    // The rim is drawn by chords; the smaller circle has the larger sagitta: h^2 / 8 r, with chords up to 1.5 h.
    EXPECT_LT(worst, 2.25 * resolution * resolution / (8 * 0.08));
}

TEST(Triangulate, seams_of_joined_solids_are_no_wall)
{
    Region const region =
        Region("cone", cone_frustum({}, up, 0.4, 0.1, 0.2)) | Region("column", cylinder({0, 0, 0.4}, up, 0.6, 0.2));
    auto const mesh = triangulate(region, 0.02);
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_LT(farthest_corner(region, mesh), 1e-3 * 0.02);
    EXPECT_NEAR(enclosed(mesh) / (pi / 3 * 0.4 * 0.07 + pi * 0.04 * 0.6), 1, 5e-3);
    for (auto const& triangle : mesh.triangles)
        for (auto const& corner : triangle)
            EXPECT_TRUE(std::abs(corner.z - 0.4) > 1e-3 || std::hypot(corner.x, corner.y) > 0.19);
}

TEST(Triangulate, two_pieces_of_wall_in_one_cube_stay_two)
{
    // Two balls that nearly touch, and a wall not much thicker than the resolution.
    Region const region = (Region("box", Box{{-1, -1, -1}, {1, 1, 1}}) - Region("a", Ball{{-0.41, 0, 0}, 0.4}) -
                           Region("b", Ball{{0.41, 0.013, 0.02}, 0.4})) -
                          Region("plate", Box{{-2, -2, 0.6}, {2, 0.5, 0.67}});
    auto const mesh = triangulate(region, 0.06);
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_LT(farthest_corner(region, mesh), 1e-3 * 0.06);
    double const exact = 8 - 2 * 4.0 / 3 * pi * 0.064 - 0.07 * 2 * 1.5;
    EXPECT_NEAR(enclosed(mesh) / exact, 1, 1e-3);
}

TEST(Triangulate, a_mesh_solid_is_drawn_again)
{
    auto const solid = closed(rough_ball([](Vec3 const& n) { return 0.5 + 0.1 * n.x * n.y; }, 30));
    Region const region("rough", solid);
    auto const mesh = triangulate(region, 0.05);
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_LT(farthest_corner(region, mesh), 1e-3 * 0.05);
    EXPECT_NEAR(enclosed(mesh) / solid->volume(), 1, 5e-3);
}

TEST(Triangulate, what_cannot_be_drawn_is_told)
{
    auto const said = [](Region const& region, double resolution) -> std::string {
        try {
            triangulate(region, resolution);
        } catch (granum::base::CaseError const& error) {
            return error.what();
        }
        return "(nothing)";
    };
    Region const thin =
        Region("box", Box{{-1, -1, -1}, {1, 1, 1}}) - Region("tube", tube({0, 0, -0.5}, up, 1, 0.49, 0.5));
    EXPECT_NE(said(thin, 0.05).find("tube is thinner than the 0.05 m"), std::string::npos) << said(thin, 0.05);
    EXPECT_NE(said(thin, 0.05).find("finer resolution"), std::string::npos);
    EXPECT_NE(said(Region("half", HalfSpace{}), 0.1).find("without bounds"), std::string::npos);
    EXPECT_NE(said(thin, 0).find("above 0"), std::string::npos);
    EXPECT_NE(said(thin, 1e-9).find("too fine"), std::string::npos);
}
