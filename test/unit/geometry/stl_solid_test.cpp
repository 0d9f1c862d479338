// Solids from STL files: a good file becomes a solid, and no other gets past.
#include "granum/geometry/stl_solid.hpp"

#include "granum/base/error.hpp"
#include "scene/closed_meshes.hpp"
#include "scene/stl_bytes.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace granum::geometry;
using namespace granum::scene;

namespace
{
std::string file(TemporaryFolder const& folder, std::string const& bytes)
{
    std::string const path = folder / "part.stl";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

//! What is said of a file, which must end the program with status 2.
std::string complaint(std::string const& path, StlSolidOptions const& options = {})
{
    try {
        read_stl_solid(path, options);
    } catch (granum::base::CaseError const& error) {
        EXPECT_EQ(static_cast<int>(error.exit), 2);
        return error.what();
    }
    return "(no complaint)";
}

void expect_said(std::string const& said, std::vector<std::string> const& parts)
{
    for (auto const& part : parts)
        EXPECT_NE(said.find(part), std::string::npos) << "said: " << said << "\nnot: " << part;
}
}

TEST(StlSolid, a_good_file_is_a_solid_in_metres)
{
    TemporaryFolder const folder;
    auto const path = file(folder, binary_stl(ball_surface({200, 100, 50}, 30, 40)));
    auto const solid = read_stl_solid(path, {.stl = {.scale = 1e-3}, .expected_size = 0.5});
    EXPECT_TRUE(solid.notices.empty());
    EXPECT_NEAR(solid.mesh->distance({0.2, 0.1, 0.05}).distance, -0.03, 1e-4);
    EXPECT_NEAR(solid.mesh->distance({0.2, 0.1, 0.15}).distance, 0.07, 1e-7);
    // The polyhedron of 40 x 80 places is smaller than the ball by about (pi / 40)^2 / 2.
    EXPECT_NEAR(solid.mesh->volume() / (4.0 / 3 * granum::math::pi * 2.7e-5), 1, 4e-3);
}

TEST(StlSolid, one_that_is_inside_out_is_turned_with_a_notice)
{
    TemporaryFolder const folder;
    auto const path = file(folder, binary_stl(turned_round(box_surface({0, 0, 0}, {1, 2, 3}))));
    auto const solid = read_stl_solid(path);
    ASSERT_EQ(solid.notices.size(), 1u);
    expect_said(solid.notices[0], {path, "inside out", "turned"});
    EXPECT_NEAR(solid.mesh->volume(), 6, 1e-12);
}

TEST(StlSolid, every_fault_of_a_file_is_told_at_once_with_its_fix)
{
    TemporaryFolder const folder;
    auto triangles = together(box_surface({0, 0, 0}, {1, 1, 1}), box_surface({0.3, 0.4, 0.5}, {1.3, 1.4, 1.5}));
    triangles.pop_back();
    triangles.push_back({Vec3{5, 5, 5}, Vec3{5, 5, 5}, Vec3{5, 5, 5}});
    auto const path = file(folder, binary_stl(triangles));
    expect_said(complaint(path),
                {path + ": is not closed: 1 hole with 3 open edges", "fill holes", path + ": has 1 facet without area",
                 "facet 24", "degenerate", path + ": crosses itself, or two of its bodies overlap", "boolean union"});
}

TEST(StlSolid, a_wrong_unit_is_suspected)
{
    TemporaryFolder const folder;
    auto const millimetres = file(folder, binary_stl(box_surface({0, 0, 0}, {180, 180, 600})));
    expect_said(complaint(millimetres, {.expected_size = 0.7}),
                {"is 651.8 m large", "0.7 m", "millimetres read as metres?", "one unit of the file was taken as 1 m"});
    EXPECT_EQ(complaint(millimetres, {.stl = {.scale = 1e-3}, .expected_size = 0.7}), "(no complaint)");
    auto const metres = file(folder, binary_stl(box_surface({0, 0, 0}, {0.18, 0.18, 0.6})));
    expect_said(complaint(metres, {.stl = {.scale = 1e-3}, .expected_size = 0.7}), {"metres read as millimetres?"});
    // A nozzle is 50 times smaller than its chamber with all units right.
    EXPECT_EQ(complaint(metres, {.expected_size = 30}), "(no complaint)");
    EXPECT_EQ(complaint(metres), "(no complaint)");
}

TEST(StlSolid, too_many_facets_are_refused_by_the_head_of_the_file)
{
    TemporaryFolder const folder;
    // Ten million facets without the facets: a file that takes no room and ends in nothing but zeros.
    auto const path = file(folder, binary_stl({}).substr(0, 80) + little_endian(10'000'000));
    std::filesystem::resize_file(path, 84 + 50ull * 10'000'000);
    expect_said(complaint(path), {path, "10000000 triangles; at most 2000000 are taken"});
}

TEST(StlSolid, what_is_no_stl_file_is_told)
{
    TemporaryFolder const folder;
    expect_said(complaint(file(folder, "<html></html>")), {"part.stl: is no STL file"});
    expect_said(complaint(folder / "none.stl"), {"none.stl: no such file"});
    expect_said(complaint(file(folder, "")), {"part.stl: is empty"});
    auto const sheet = jittered_sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
    expect_said(complaint(file(folder, binary_stl(sheet.triangles))), {"is not closed: 1 hole with 8 open edges"});
}
