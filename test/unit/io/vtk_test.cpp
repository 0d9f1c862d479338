// What ParaView gets: the data arrays decode to the numbers that went in.
#include "granum/io/vtk.hpp"

#include "granum/base/error.hpp"
#include "granum/io/base64.hpp"
#include "granum/io/text_file.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace granum::io
{
namespace
{
//! Text of the data array `name`, without blanks around it.
std::string array_text(std::string const& file, std::string const& name)
{
    auto const head = file.find("Name=\"" + name + "\"");
    if (head == std::string::npos) return "";
    auto const begin = file.find(">\n", head) + 2;
    return file.substr(begin, file.find('\n', begin) - begin);
}

//! Decodes by the published layout: a header of its own in base64 (24 bytes and 8 per block), then the blocks.
template <class Number>
std::vector<Number> numbers_of(std::string const& text)
{
    auto const first = from_base64(std::string_view(text).substr(0, 32));
    std::uint64_t lead[3];
    std::memcpy(lead, first.data(), sizeof lead);
    std::size_t const header_bytes = 8 * (3 + lead[0]);
    std::size_t const header_letters = (header_bytes + 2) / 3 * 4;
    auto const header = from_base64(std::string_view(text).substr(0, header_letters));
    auto const packed = from_base64(std::string_view(text).substr(header_letters));
    std::vector<std::byte> bytes;
    std::size_t at = 0;
    for (std::uint64_t b = 0; b < lead[0]; ++b) {
        std::uint64_t size = 0;
        std::memcpy(&size, header.data() + 8 * (3 + b), sizeof size);
        uLongf whole = b + 1 == lead[0] && lead[2] > 0 ? lead[2] : lead[1];
        std::size_t const start = bytes.size();
        bytes.resize(start + whole);
        EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data() + start), &whole,
                             reinterpret_cast<Bytef const*>(packed.data() + at), size),
                  Z_OK);
        at += size;
    }
    EXPECT_EQ(at, packed.size());
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

std::string bytes_to_text(std::string_view text)
{
    return base64(std::as_bytes(std::span(text)));
}
}

TEST(Base64, gives_the_examples_of_rfc_4648)
{
    EXPECT_EQ(bytes_to_text(""), "");
    EXPECT_EQ(bytes_to_text("f"), "Zg==");
    EXPECT_EQ(bytes_to_text("fo"), "Zm8=");
    EXPECT_EQ(bytes_to_text("foobar"), "Zm9vYmFy");
    EXPECT_EQ(from_base64("Zm9v YmE=").size(), 5u);
    EXPECT_THROW(from_base64("Zm9v?mE="), base::IoError);
}

TEST(Vtk, points_come_back_as_they_went_in)
{
    scene::TemporaryFolder folder;
    std::vector<Vec3> positions;
    NamedArray temperature{.name = "temperature [K]"}, velocity{.name = "velocity", .components = 3},
        id{.name = "id", .precision = Precision::twice};
    for (int i = 0; i < 20000; ++i) {  // more than one block of compression
        positions.push_back({i * 0.001, std::sin(i), -1.0 / (i + 1)});
        temperature.values.push_back(300 + 0.01 * i);
        velocity.values.insert(velocity.values.end(), {1.0 * i, 2.0 * i, 3.0 * i});
        id.values.push_back(1e9 + i);
    }
    write_points(folder / "a.vtp", positions, {temperature, velocity, id});
    auto const file = read_text(folder / "a.vtp");
    EXPECT_EQ(file.find("appended"), std::string::npos);

    auto const x = numbers_of<float>(array_text(file, "points"));
    ASSERT_EQ(x.size(), 60000u);
    for (std::size_t i = 0; i < positions.size(); ++i) ASSERT_EQ(x[3 * i + 1], static_cast<float>(positions[i].y));
    auto const t = numbers_of<float>(array_text(file, "temperature [K]"));
    ASSERT_EQ(t.size(), 20000u);
    EXPECT_EQ(t[12345], static_cast<float>(temperature.values[12345]));
    EXPECT_EQ(numbers_of<double>(array_text(file, "id")), id.values);
    EXPECT_EQ(numbers_of<float>(array_text(file, "velocity")).size(), 60000u);
    auto const offsets = numbers_of<std::int64_t>(array_text(file, "offsets"));
    EXPECT_EQ(offsets.front(), 1);
    EXPECT_EQ(offsets.back(), 20000);
}

TEST(Vtk, no_points_are_a_file_too)
{
    scene::TemporaryFolder folder;
    write_points(folder / "none.vtp", {}, {{.name = "diameter"}});
    auto const file = read_text(folder / "none.vtp");
    EXPECT_NE(file.find("NumberOfPoints=\"0\""), std::string::npos);
    EXPECT_TRUE(numbers_of<float>(array_text(file, "diameter")).empty());
}

TEST(Vtk, an_array_of_the_wrong_length_is_refused)
{
    scene::TemporaryFolder folder;
    std::vector<Vec3> const one{{0, 0, 0}};
    EXPECT_THROW(write_points(folder / "a.vtp", one, {{.name = "t", .values = {1, 2}}}), base::NumericsError);
    EXPECT_THROW(write_points(folder / "missing/a.vtp", one, {}), base::IoError);
}

TEST(Vtk, cells_state_their_extent_and_keep_their_order)
{
    scene::TemporaryFolder folder;
    std::array<std::vector<double>, 3> const faces{{{-0.1, 0, 0.1}, {0, 0.2}, {0, 0.05, 0.1, 0.2}}};
    write_cells(folder / "gas.vtr", faces, {{.name = "p & q", .values = {0, 1, 2, 3, 4, 5}}});
    auto const file = read_text(folder / "gas.vtr");
    EXPECT_NE(file.find("WholeExtent=\"0 2 0 1 0 3\""), std::string::npos);
    EXPECT_EQ(numbers_of<double>(array_text(file, "z [m]")), (std::vector<double>{0, 0.05, 0.1, 0.2}));
    EXPECT_EQ(numbers_of<float>(array_text(file, "p &amp; q")), (std::vector<float>{0, 1, 2, 3, 4, 5}));
}

TEST(Vtk, the_wall_of_a_cylinder_has_the_area_of_the_cylinder)
{
    geometry::Chamber chamber;
    chamber.shape = geometry::Chamber::Shape::revolution;
    chamber.profile = {{0, 0.1}, {0.5, 0.1}};
    auto const surface = chamber_surface(chamber, 400);
    double area = 0;
    for (auto const& face : surface.faces) {
        Vec3 sum;
        for (std::size_t c = 1; c + 1 < face.size(); ++c) {
            auto corner = [&](std::size_t k) { return surface.corners[static_cast<std::size_t>(face[k])]; };
            sum += math::cross(corner(c) - corner(0), corner(c + 1) - corner(0));
        }
        area += 0.5 * math::norm(sum);
    }
    double const expected = std::numbers::pi * (2 * 0.1 * 0.5 + 0.1 * 0.1);  // side and plate, without a lid
    EXPECT_NEAR(area, expected, 1e-4 * expected);
}

TEST(Vtk, a_collection_is_whole_after_every_step)
{
    scene::TemporaryFolder folder;
    Collection collection(folder / "granules.pvd");
    for (int step = 0; step < 3; ++step) {
        collection.add(0.1 * step, fmt::format("vtk/granules_{:06}.vtp", step));
        auto const file = read_text(folder / "granules.pvd");
        EXPECT_NE(file.find(fmt::format("granules_{:06}.vtp", step)), std::string::npos);
        EXPECT_TRUE(file.ends_with("</Collection>\n</VTKFile>\n"));
    }
}
}
