// STL files: both forms give the same mesh, and no bad file gets past with less than a message that names it.
#include "granum/geometry/stl.hpp"

#include "granum/base/error.hpp"
#include "granum/geometry/body.hpp"
#include "scene/meshes.hpp"
#include "scene/stl_bytes.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <limits>

using namespace granum::geometry;
using namespace granum::scene;

namespace
{
std::string facet(std::string const& corner = "vertex 0 1 0")
{
    return "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  " + corner + "\n endloop\nendfacet\n";
}

std::string file(TemporaryFolder const& folder, std::string const& bytes)
{
    std::string const path = folder / "part.stl";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string complaint(std::string const& path, StlOptions const& options = {})
{
    try {
        read_stl(path, options);
    } catch (granum::base::IoError const& error) {
        return error.what();
    }
    return "(no complaint)";
}

Triangle const unit{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
}

TEST(Stl, both_forms_give_the_same_triangles)
{
    TemporaryFolder const folder;
    auto const box = box_mesh({0, 0, 0}, {1, 2, 4});
    std::string text = "solid box with a name\n";
    for (auto const& [a, b, c] : box.triangles)
        text += fmt::format(
            "facet normal 0 0 0 outer loop vertex {} {} {}\r\nVERTEX {} {} {:e} vertex +{} {} {} "
            "endloop endfacet\n",
            a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z);
    text += "endsolid box with a name\n";
    auto const from_text = read_stl(file(folder, text)).mesh;
    auto const from_bytes = read_stl(file(folder, binary_stl(box.triangles))).mesh;
    ASSERT_EQ(from_text.triangles.size(), 12u);
    EXPECT_EQ(from_text.triangles, box.triangles);
    EXPECT_EQ(from_bytes.triangles, box.triangles);
}

TEST(Stl, a_binary_file_may_begin_like_a_text)
{
    TemporaryFolder const folder;
    EXPECT_EQ(read_stl(file(folder, binary_stl({unit}, "solid from a drawing program"))).mesh.triangles.size(), 1u);
}

TEST(Stl, several_solids_in_a_file_are_one_mesh)
{
    TemporaryFolder const folder;
    std::string const text = "solid a\n" + facet() + "endsolid a\nsolid b\n" + facet("vertex 0 0 1") + "endsolid b\n";
    EXPECT_EQ(read_stl(file(folder, text)).mesh.triangles.size(), 2u);
}

TEST(Stl, is_scaled_before_it_is_shifted)
{
    TemporaryFolder const folder;
    auto const mesh = read_stl(file(folder, binary_stl({unit})), {.scale = 1e-3, .shift = {0.5, 0, 0.25}}).mesh;
    EXPECT_EQ(mesh.triangles[0][1], (Vec3{0.501, 0, 0.25}));
}

TEST(Stl, triangles_without_area_are_dropped_and_counted)
{
    TemporaryFolder const folder;
    Triangle const point{Vec3{1, 1, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 0}},
        line{Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{2, 2, 0}}, sliver{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 1e-8, 0}};
    auto const read = read_stl(file(folder, binary_stl({point, unit, line, sliver})));
    EXPECT_EQ(read.mesh.triangles.size(), 1u);
    EXPECT_EQ(read.degenerate, 3u);
}

TEST(Stl, no_bad_file_passes_and_each_is_told_why)
{
    TemporaryFolder const folder;
    float const nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::infinity();
    auto const with = [](double value) { return Triangle{Vec3{0, 0, 0}, Vec3{1, value, 0}, Vec3{0, 1, 0}}; };
    std::string const good = binary_stl({unit, unit});
    std::string lying = good;
    lying.replace(80, 4, little_endian(3));
    std::string boasting = good;
    boasting.replace(80, 4, little_endian(0xffffffffu));
    std::string const solid = "solid s\n", end = "endsolid s\n";
    struct
    {
        std::string bytes, told;
    } const bad[]{
        {"", "is empty"},
        {"x", "does not begin with \"solid\" and has only 1 bytes"},
        {std::string(83, '\0'), "has only 83 bytes"},
        {std::string(84, '\0'), "has no triangles"},
        {std::string(200, '\xff'), "4294967295 triangles"},
        {good.substr(0, good.size() - 1), "would need 184 bytes where there are 183; it may be cut off"},
        {good + "x", "would need 184 bytes where there are 185"},
        {lying, "would need 234 bytes where there are 184"},
        {boasting, "would need 214748364834 bytes"},
        {binary_stl({unit, with(nan)}), "a corner of triangle 2 is not a finite number"},
        {binary_stl({with(huge)}), "a corner of triangle 1 is not a finite number"},
        {binary_stl({with(-huge)}), "a corner of triangle 1 is not a finite number"},
        {binary_stl({with(3e38)}), "more than 1e+06 m away; is the unit right?"},
        {binary_stl({Triangle{}}), "none of its 1 triangles has an area"},
        {"solid", "the file ends without \"endsolid\""},
        {solid + end, "has no triangles"},
        {solid + facet(), ":9: the file ends without \"endsolid\""},
        {solid + facet() + end + "rubbish", ":10: \"rubbish\" stands where \"solid\" belongs"},
        {solid + "face normal 0 0 1\n", ":2: \"face\" stands where \"facet\" or \"endsolid\" belongs"},
        {solid + "facet norma 0 0 1\n", "\"norma\" stands where \"normal\" belongs (triangle 1)"},
        {solid + "facet normal 0 0\nouter loop", ":3: \"outer\" is not a number (triangle 1)"},
        {solid + "facet normal 0 0 1 outer\n", ":3: the file ends within triangle 1, where \"loop\" belongs"},
        {solid + facet("vertex 0 1"), "\"endloop\" is not a number (triangle 1)"},
        {solid + facet("vertex 0 1 2 3") + end, "\"3\" stands where \"endloop\" belongs"},
        {solid + facet("vertex 0 1,5 2") + end, ":6: \"1,5\" is not a number"},
        {solid + facet("vertex 0 0x1 2") + end, "\"0x1\" is not a number"},
        {solid + facet("vertex 0 1e 2") + end, "\"1e\" is not a number"},
        {solid + facet("vertex 0 -+1 2") + end, "\"-+1\" is not a number"},
        {solid + facet("vertex nan 1 2") + end, ":6: a corner of triangle 1 is not a finite number"},
        {solid + facet("vertex 0 inf 2") + end, "a corner of triangle 1 is not a finite number"},
        {solid + facet("vertex 0 1e999 2") + end, "a corner of triangle 1 is not a finite number"},
        {solid + facet("vertex 0 1e9 2") + end, "is the unit right?"},
        {solid + facet("vertex 2 0 0") + end, "none of its 1 triangles has an area"},
        {solid + facet("vertex 0 1 2\nvertex 0 0 1"), "\"vertex\" stands where \"endloop\" belongs"},
        {solid + facet("vertex 0 \x1b[31m 2"), "\"?[31m\" is not a number"},
        {solid + std::string(100000, 'a'), fmt::format("\"{:a>40}...\" stands where", "")},
        {solid + std::string(1000, '\0') + end, "stands where \"facet\" or \"endsolid\" belongs"},
        {std::string(1000, ' '), "does not begin with \"solid\""},
        {"<html><body>404</body></html>", "does not begin with \"solid\""},
    };
    for (auto const& [bytes, told] : bad) {
        std::string const path = file(folder, bytes);
        std::string const said = complaint(path);
        EXPECT_NE(said.find(told), std::string::npos) << "said: " << said << "\nnot: " << told;
        EXPECT_EQ(said.rfind(path, 0), 0u) << "the file is not named: " << said;
    }
}

TEST(Stl, every_cut_and_every_turned_bit_of_the_head_ends_in_a_mesh_or_a_message)
{
    TemporaryFolder const folder;
    std::string const text = "solid s\n" + facet() + "endsolid", bytes = binary_stl({unit, unit});
    for (auto const& whole : {text, bytes})
        for (std::size_t length = 0; length < whole.size(); ++length)
            EXPECT_NE(complaint(file(folder, whole.substr(0, length))).find("part.stl"), std::string::npos)
                << length << " of " << whole.size() << " bytes";
    for (std::size_t bit = 0; bit < 32; ++bit) {
        std::string turned = bytes;
        turned[80 + bit / 8] = static_cast<char>(turned[80 + bit / 8] ^ (1 << (bit % 8)));
        EXPECT_NE(complaint(file(folder, turned)).find("may be cut off"), std::string::npos) << "bit " << bit;
    }
}

TEST(Stl, what_is_no_file_or_too_large_is_refused)
{
    TemporaryFolder const folder;
    EXPECT_NE(complaint(folder / "none.stl").find("none.stl: no such file"), std::string::npos);
    EXPECT_NE(complaint(folder.path()).find("is not a file"), std::string::npos);
    auto const path = file(folder, binary_stl({unit, unit}));
    EXPECT_NE(complaint(path, {.most_triangles = 1}).find("2 triangles; at most 1 are taken"), std::string::npos);
    EXPECT_NE(complaint(path, {.most_triangles = 0}).find("184 bytes are more than 0 triangles can need"),
              std::string::npos);
    EXPECT_NE(complaint(path, {.scale = 0}).find("a scale of 0"), std::string::npos);
    EXPECT_NE(complaint(path, {.scale = -1}).find("a scale of -1"), std::string::npos);
}
