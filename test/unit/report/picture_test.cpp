// Pictures and charts: what is near hides what is far, colours mean their numbers, ticks are round.
#include "granum/report/picture.hpp"

#include "granum/report/chart.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <numeric>

namespace granum::report
{
namespace
{
//! One ball in the middle of a square of 1 m, `depth` behind the cut.
io::Snapshot ball(double depth, double radius = 0.3)
{
    io::Snapshot out;
    out.granules.position = {{0.5, depth, 0.5}};
    out.granules.radius = {radius};
    return out;
}

constexpr Window square{0, 0, 1, 1};
constexpr ColourMap red_or_blue{
    {0xff0000, 0xff0000, 0xff0000, 0xff0000, 0xff0000, 0, 0x0000ff, 0x0000ff, 0x0000ff, 0x0000ff, 0x0000ff}};
constexpr std::array<std::uint8_t, 3> white{255, 255, 255};
}

TEST(Picture, a_ball_is_where_it_should_be_and_white_elsewhere)
{
    Picture picture(square, 100);
    picture.draw_granules(ball(0.1), std::vector{0.0}, {0, 1}, red_or_blue);
    EXPECT_EQ(picture.width(), 100);
    EXPECT_GT(picture.pixel(50, 50)[0], 2 * picture.pixel(50, 50)[2]);
    EXPECT_EQ(picture.pixel(5, 5), white);
    EXPECT_NE(picture.pixel(50, 22), white);  // the rim is at row 20
    EXPECT_EQ(picture.pixel(50, 17), white);
    EXPECT_EQ(picture.pixel(28, 28), white);  // outside the circle, inside its square
}

TEST(Picture, the_nearer_ball_hides_the_farther_in_any_order)
{
    for (bool const near_first : {true, false}) {
        io::Snapshot two = ball(0.4, 0.2);
        two.granules.position.push_back({0.5, 0.8, 0.5});
        two.granules.radius.push_back(0.2);
        if (!near_first) std::swap(two.granules.position[0], two.granules.position[1]);
        Picture picture(square, 60);
        picture.draw_granules(two, near_first ? std::vector{0.0, 1.0} : std::vector{1.0, 0.0}, {0, 1}, red_or_blue);
        EXPECT_GT(picture.pixel(30, 30)[0], picture.pixel(30, 30)[2]);  // red is near
    }
}

TEST(Picture, what_lies_before_the_cut_is_not_drawn)
{
    Picture picture(square, 40);
    picture.draw_granules(ball(-0.1), std::vector{0.0}, {0, 1}, red_or_blue);
    EXPECT_EQ(picture.pixel(20, 20), white);
}

TEST(Picture, gas_is_interpolated_and_stays_inside_the_outline)
{
    io::Snapshot snapshot;
    snapshot.outline = {{0.2, 0}, {0.8, 0}, {0.8, 1}, {0.2, 1}};
    snapshot.gas.nx = snapshot.gas.nz = 4;
    snapshot.gas.dx = snapshot.gas.dz = 0.25;
    snapshot.gas.speed.assign(16, 7.0);
    Picture picture(square, 80);
    picture.draw_gas(snapshot, snapshot.gas.speed, {0, 7}, red_or_blue);
    EXPECT_EQ(picture.pixel(40, 40), (std::array<std::uint8_t, 3>{0, 0, 255}));
    EXPECT_EQ(picture.pixel(10, 40), white);
}

TEST(Picture, is_a_png_of_its_size)
{
    Picture const picture({0, 0, 2, 1}, 50);
    auto const bytes = picture.png();
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
    EXPECT_EQ(image.width, 100u);
    EXPECT_EQ(image.height, 50u);
    image.format = PNG_FORMAT_RGB;
    std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
    ASSERT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
    EXPECT_EQ(std::accumulate(pixels.begin(), pixels.end(), 0l), 255l * 3 * 100 * 50);
}

TEST(ColourMaps, change_their_lightness_in_one_direction)
{
    for (auto const& map : {plasma, viridis, wetness}) {
        auto lightness = [&](double share) {
            auto const c = map(share);
            return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;  // Rec. 709
        };
        double const direction = lightness(1) - lightness(0);
        for (int step = 0; step < 100; ++step)
            EXPECT_GE((lightness((step + 1) / 100.0) - lightness(step / 100.0)) * direction, -1e-4) << step;
        EXPECT_GT(std::abs(direction), 0.4);
    }
}

TEST(Chart, ticks_are_round_and_inside)
{
    EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(ticks(-1, 1, 4), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
    EXPECT_EQ(ticks(3, 3, 4), std::vector<double>{3});
    EXPECT_EQ(ticks(0.34, std::nextafter(0.34, 1), 4), std::vector<double>{0.34}) << "a range of rounding";
    auto const fine = ticks(65.612, 65.648, 5);
    EXPECT_GE(fine.size(), 3u);
    EXPECT_GE(fine.front(), 65.612);
}

TEST(Chart, the_bars_of_a_histogram_add_up_to_all)
{
    std::vector<double> values, weights;
    for (int i = 1; i <= 1000; ++i) values.push_back(i), weights.push_back(i % 3 + 1.0);
    HistogramChart chart;
    chart.values = values;
    chart.weights = weights;
    auto const drawing = svg(chart);
    // Paper height of 1 % from the tick labels is not needed: the heights of uniform bars are nearly equal.
    std::vector<double> heights;
    for (auto at = drawing.find("height=\"", drawing.find("<rect")); at != std::string::npos;
         at = drawing.find("height=\"", at + 1))
        heights.push_back(std::stod(drawing.substr(at + 8)));
    ASSERT_EQ(heights.size(), 24u);
    EXPECT_NEAR(heights[5], heights[15], 0.06 * heights[5]);
}

TEST(Chart, without_data_there_is_no_drawing)
{
    EXPECT_EQ(svg(CurveChart{}), "");
    HistogramChart const empty;
    EXPECT_EQ(svg(empty), "");
    EXPECT_EQ(split_bar({{"nothing", 0}}), "");
}
}
