// What keeps a mesh from being a solid is found, counted and named with its place.
#include "granum/geometry/closed_check.hpp"

#include "scene/closed_meshes.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

using namespace granum::geometry;
using namespace granum::scene;

namespace
{
using Kind = MeshFault::Kind;

std::vector<Kind> kinds(ClosedCheck const& check)
{
    std::vector<Kind> out;
    for (auto const& fault : check.faults) out.push_back(fault.kind);
    return out;
}

//! The one fault of a mesh.
MeshFault the_fault(Triangles const& triangles)
{
    auto const check = inspect_closed(triangles);
    std::string all;
    for (auto const& fault : check.faults) all += fault.what + "\n";
    EXPECT_EQ(check.faults.size(), 1u) << all;
    return check.faults.empty() ? MeshFault{} : check.faults.front();
}

void expect_said(MeshFault const& fault, std::vector<std::string> const& parts)
{
    for (auto const& part : parts)
        EXPECT_NE(fault.what.find(part), std::string::npos) << "said: " << fault.what << "\nnot: " << part;
    EXPECT_FALSE(fault.hint.empty());
}

Triangles const unit_box = box_surface({0, 0, 0}, {1, 1, 1});
}

TEST(ClosedCheck, good_meshes_have_no_fault)
{
    for (auto const& good :
         {unit_box, box_surface({0, 0, 0}, {1, 1, 1e-4}, 7), ball_surface({1, 2, 3}, 0.1, 20),
          turned_surface({{0, 0}, {0, 0.003}, {1, 0}}, 24), together(unit_box, moved(unit_box, {1.5, 0, 0})),
          together(ball_surface({}, 1, 10), turned_round(ball_surface({}, 0.95, 10))),
          together(unit_box, moved(unit_box, {1, 1, 1}))}) {
        auto const check = inspect_closed(good);
        EXPECT_TRUE(check.faults.empty()) << check.faults.front().what;
        EXPECT_FALSE(check.was_inside_out);
    }
}

TEST(ClosedCheck, corners_that_differ_by_single_precision_are_one)
{
    std::mt19937 random(2);
    auto shaken = ball_surface({0.3, 0.2, 0.1}, 0.1, 20);
    for (auto& triangle : shaken)
        for (auto& corner : triangle)
            for (std::size_t d = 0; d < 3; ++d) corner[d] *= 1 + 1e-7 * (static_cast<double>(random() % 3) - 1);
    EXPECT_TRUE(inspect_closed(shaken).faults.empty());
}

TEST(ClosedCheck, holes_are_counted_and_the_largest_is_found)
{
    // Sides of 4 x 4 quadrangles; of z = 1, the last, one between x = 0.25 .. 0.5 and y = 0.5 .. 0.75 is left out, of
    // z = 0, the last but one, a single facet.
    auto open = box_surface({0, 0, 0}, {1, 1, 1}, 4);
    auto const at = open.begin() + 5 * 32 + 2 * (2 * 4 + 1);
    open.erase(at, at + 2);
    open.erase(open.begin() + 4 * 32);
    auto const fault = the_fault(open);
    EXPECT_EQ(fault.kind, Kind::hole);
    EXPECT_EQ(fault.count, 2u);
    expect_said(fault, {"2 holes with 7 open edges; the largest is 1 m round about (0.375, 0.625, 1) m, at facets 1"});
}

TEST(ClosedCheck, an_edge_with_more_than_two_facets_is_named_with_its_facets)
{
    auto const fault = the_fault(together(unit_box, moved(unit_box, {1, 1, 0})));
    EXPECT_EQ(fault.kind, Kind::crowded_edge);
    EXPECT_EQ(fault.count, 1u);
    expect_said(fault, {"1 edge with more than two facets", "from (1, 1, 0) m to (1, 1, 1) m"});
}

TEST(ClosedCheck, facets_turned_against_their_neighbours_are_counted)
{
    auto triangles = ball_surface({0, 0, 0}, 1, 10);
    for (std::size_t const k : {16u, 90u, 91u}) std::swap(triangles[k][0], triangles[k][1]);
    auto const fault = the_fault(triangles);
    EXPECT_EQ(fault.kind, Kind::turned_facet);
    EXPECT_EQ(fault.count, 3u);
    expect_said(fault, {"3 facets turned against their neighbours", "the first is facet 17 about ("});
}

TEST(ClosedCheck, a_mesh_that_is_inside_out_as_a_whole_is_turned)
{
    for (auto const& good : {unit_box, together(ball_surface({}, 1, 10), turned_round(ball_surface({}, 0.9, 10)))}) {
        auto const check = inspect_closed(turned_round(good));
        EXPECT_TRUE(check.faults.empty());
        EXPECT_TRUE(check.was_inside_out);
        EXPECT_NEAR(ClosedMesh(check.corners).volume(), closed(good)->volume(), 1e-12);
        EXPECT_GT(ClosedMesh(check.corners).volume(), 0);
    }
}

TEST(ClosedCheck, a_surface_with_one_side_is_told)
{
    // The projective plane with the fewest facets: six points, each pair of them an edge of two facets.
    std::array<std::array<std::size_t, 3>, 10> const facets{
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}, {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}}};
    std::array<Vec3, 6> const points{Vec3{0, 0, 1},     {1, 0, 0.1},       {0.3, 1, 0.2},
                                     {-0.8, 0.6, -0.1}, {-0.8, -0.6, 0.3}, {0.3, -1, -0.3}};
    Triangles triangles;
    for (auto const& [a, b, c] : facets) triangles.push_back({points[a], points[b], points[c]});
    auto const found = kinds(inspect_closed(triangles));
    EXPECT_EQ(found.at(0), Kind::one_sided);
}

TEST(ClosedCheck, a_facet_without_area_is_named)
{
    // A point on an edge of the box: the facet on the one side is split there, that on the other is not, and a facet
    // without area lies between.
    auto triangles = unit_box;
    auto const [a, b, c] = triangles[4];
    Vec3 const on = 0.5 * (a + b);
    triangles[4] = {a, on, c};
    triangles.push_back({on, b, c});
    triangles.push_back({a, b, on});
    auto const fault = the_fault(triangles);
    EXPECT_EQ(fault.kind, Kind::no_area);
    EXPECT_EQ(fault.count, 1u);
    expect_said(fault, {"1 facet without area", "facet 14 about ("});
    // A facet whose corners are one point leaves no hole.
    auto with_point = unit_box;
    with_point.push_back({c, c, c});
    EXPECT_EQ(the_fault(with_point).kind, Kind::no_area);
}

TEST(ClosedCheck, a_sheet_that_is_drawn_twice_has_zero_thickness)
{
    auto const sheet = jittered_sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4, 4).triangles;
    auto const fault = the_fault(together(sheet, turned_round(sheet)));
    EXPECT_EQ(fault.kind, Kind::doubled);
    EXPECT_EQ(fault.count, 32u);
    expect_said(fault, {"zero thickness", "first 1 and facet 33 about ("});
}

TEST(ClosedCheck, two_sheets_on_each_other_have_zero_thickness)
{
    Vec3 const a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};
    auto const check = inspect_closed(Triangles{{a, b, c}, {a, c, d}, {b, a, d}, {c, b, d}});
    EXPECT_EQ(kinds(check), (std::vector{Kind::no_volume, Kind::lying_on_another}));
    EXPECT_EQ(check.faults[1].count, 4u);
}

TEST(ClosedCheck, a_fin_without_thickness_on_a_good_body_is_found)
{
    auto const [a, b, c] = unit_box[4];
    Vec3 const tip = a + b + c;
    auto const fault = the_fault(together(unit_box, {{a, b, tip}, {b, a, tip}}));
    EXPECT_EQ(fault.kind, Kind::doubled);
    expect_said(fault, {"zero thickness: 1 pair of facets", "first 13 and facet 14 about ("});
}

TEST(ClosedCheck, bodies_that_overlap_are_told_with_a_facet_of_each)
{
    auto const fault = the_fault(together(unit_box, moved(box_surface({0, 0, 0}, {1, 1, 1}), {0.3, 0.4, 0.5})));
    EXPECT_EQ(fault.kind, Kind::crossing);
    expect_said(fault, {"two of its bodies overlap", "go through each other; the first are facets "});
    std::size_t one = 0, other = 0;
    std::sscanf(fault.what.c_str() + fault.what.find("facets ", fault.what.find("the first")), "facets %zu and %zu",
                &one, &other);
    EXPECT_LE(one, 12u);
    EXPECT_GT(other, 12u);
    EXPECT_LE(other, 24u);
}

TEST(ClosedCheck, a_body_that_crosses_itself_is_told)
{
    // A spike of the ball is pulled through to the other side.
    auto const spiked = rough_ball([](Vec3 const& n) { return n.z > 0.999 ? -1.5 : 1.0; }, 16);
    EXPECT_EQ(the_fault(spiked).kind, Kind::crossing);
}

TEST(ClosedCheck, equal_bodies_shifted_along_their_faces_overlap)
{
    auto const found = kinds(inspect_closed(together(unit_box, moved(unit_box, {0.5, 0, 0}))));
    EXPECT_EQ(found, std::vector{Kind::lying_on_another});
}

TEST(ClosedCheck, bodies_that_touch_with_a_face_are_told)
{
    auto const fault = the_fault(together(unit_box, moved(unit_box, {0.25, 0.25, 1})));
    EXPECT_EQ(fault.kind, Kind::lying_on_another);
    expect_said(fault, {"two of its bodies touch", ", 1) m"});
}

TEST(ClosedCheck, a_body_in_a_body_must_be_a_cavity)
{
    auto const fault = the_fault(together(ball_surface({}, 1, 10), ball_surface({}, 0.5, 10)));
    EXPECT_EQ(fault.kind, Kind::body_in_body);
    expect_said(fault, {"a body of 360 facets with facet 361", "inside the body of facet 1 "});
    // An island in a cavity is a body again.
    auto const island =
        together(together(ball_surface({}, 1, 10), turned_round(ball_surface({}, 0.7, 10))), ball_surface({}, 0.5, 10));
    EXPECT_TRUE(inspect_closed(island).faults.empty());
}

TEST(ClosedCheck, one_body_of_two_that_is_inside_out_is_told)
{
    auto const fault = the_fault(together(unit_box, moved(turned_round(unit_box), {2, 0, 0})));
    EXPECT_EQ(fault.kind, Kind::turned_body);
    expect_said(fault, {"12 facets with facet 13", "inside out while others are not"});
}
