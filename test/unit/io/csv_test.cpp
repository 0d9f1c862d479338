// Time series: what is written is read back, also after a killed run.
#include "granum/io/csv.hpp"

#include "granum/base/error.hpp"
#include "granum/io/text_file.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace granum::io
{
TEST(Csv, a_series_comes_back_to_the_last_bit)
{
    scene::TemporaryFolder folder;
    {
        SeriesWriter writer(folder / "t.csv", {{"time", "s"}, {"bed_temperature", "K"}});
        writer.append(std::array{0.1, 1.0 / 3.0});
        writer.append(std::array{1e-300, std::numeric_limits<double>::quiet_NaN()});
    }
    auto const text = read_text(folder / "t.csv");
    EXPECT_TRUE(text.starts_with("time,bed_temperature\ns,K\n0.1,0.3333333333333333\n")) << text;
    auto const series = read_series(folder / "t.csv");
    ASSERT_EQ(series.rows(), 2u);
    EXPECT_EQ(series.columns[1].unit, "K");
    EXPECT_EQ((*series.find("bed_temperature"))[0], 1.0 / 3.0);
    EXPECT_EQ((*series.find("time"))[1], 1e-300);
    EXPECT_TRUE(std::isnan((*series.find("bed_temperature"))[1]));
    EXPECT_EQ(series.find("humidity"), nullptr);
}

TEST(Csv, every_row_is_on_the_disk_before_the_next)
{
    scene::TemporaryFolder folder;
    SeriesWriter writer(folder / "t.csv", {{"time", "s"}});
    for (int row = 1; row <= 3; ++row) {
        writer.append(std::array{0.5 * row});
        EXPECT_EQ(read_series(folder / "t.csv").rows(), static_cast<std::size_t>(row));
    }
}

TEST(Csv, half_a_last_row_is_left_out)
{
    scene::TemporaryFolder folder;
    replace_text(folder / "t.csv", "time,x\ns,1\n1,2\n3,4\n5");
    EXPECT_EQ(read_series(folder / "t.csv").rows(), 2u);
}

TEST(Csv, a_wrong_field_is_named_with_its_line)
{
    scene::TemporaryFolder folder;
    replace_text(folder / "t.csv", "time,x\ns,1\n1,2\n3,four\n");
    try {
        read_series(folder / "t.csv");
        FAIL() << "the field was taken for a number";
    } catch (base::IoError const& error) {
        EXPECT_NE(std::string(error.what()).find("t.csv:4: \"four\" is not a number"), std::string::npos)
            << error.what();
    }
    EXPECT_THROW(read_series(folder / "missing.csv"), base::IoError);
}

TEST(Csv, a_row_of_the_wrong_width_is_refused)
{
    scene::TemporaryFolder folder;
    SeriesWriter writer(folder / "t.csv", {{"time", "s"}});
    EXPECT_THROW(writer.append(std::array{1.0, 2.0}), base::NumericsError);
}
}
