// The page a user opens: all its sections, nothing from outside, and sensible words where data are missing.
#include "granum/report/report.hpp"

#include "granum/base/error.hpp"
#include "granum/io/text_file.hpp"
#include "granum/report/html.hpp"
#include "scene/run_folder.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace granum::report
{
namespace
{
constexpr std::array sections{"verdict", "notice", "key-figures", "pictures",    "porosity", "product", "checks",
                              "curves",  "events", "spray",       "performance", "warnings", "case"};

std::string page_of(std::string const& folder)
{
    return io::read_text(write(folder));
}

bool holds(std::string const& page, std::string const& text)
{
    return page.find(text) != std::string::npos;
}

std::size_t count(std::string const& page, std::string const& text)
{
    std::size_t found = 0;
    for (auto at = page.find(text); at != std::string::npos; at = page.find(text, at + 1)) ++found;
    return found;
}

scene::RunFolderScene const small{.granules = 300, .events = 200, .rows = 40};
}

TEST(Report, has_every_section_once)
{
    scene::TemporaryFolder folder;
    scene::write_run_folder(folder.path(), small);
    EXPECT_EQ(write(folder.path()), folder / "report.html");
    auto const page = page_of(folder.path());
    for (auto const* id : sections) EXPECT_EQ(count(page, std::string("id=\"") + id + "\""), 1u) << id;
    EXPECT_FALSE(holds(page, "No data yet")) << "a full run leaves no figure empty";
    for (auto const* picture : {"bed.png", "temperature.png", "moisture.png", "gas_speed.png"})
        EXPECT_GT(std::filesystem::file_size(folder / (std::string("pictures/") + picture)), 1000u) << picture;
    // Kept to look at when asked for.
    if (char const* keep = std::getenv("GRANUM_KEEP_REPORT")) scene::write_run_folder(keep), write(keep);
}

TEST(Report, shows_the_numbers_of_the_summary_in_engineers_units)
{
    scene::TemporaryFolder folder;
    scene::write_run_folder(folder.path(), small);
    auto const page = page_of(folder.path());
    EXPECT_TRUE(holds(page, "0.361 (10 to 90 % interval 0.334 to 0.389)"));
    EXPECT_TRUE(holds(page, "65.5\u00a0°C"));    // outlet, 338.6 K
    EXPECT_TRUE(holds(page, "13.9\u00a0g/kg"));  // 0.01386
    EXPECT_TRUE(holds(page, "0.6006\u00a0mm"));
    EXPECT_TRUE(holds(page, "6 min 52 s"));
}

TEST(Report, says_which_ledger_is_not_closed)
{
    scene::TemporaryFolder folder;
    scene::write_run_folder(folder.path(), small);
    auto const page = page_of(folder.path());  // energy 4.8e-6, above its bar of 1e-6
    EXPECT_TRUE(holds(page, "1 of 3 ledgers not closed"));
    EXPECT_EQ(count(page, "<span class=\"light watch\">"), 1u);
    EXPECT_EQ(count(page, "<span class=\"light good\">"), 6u);
}

TEST(Report, forbids_the_use_of_a_run_that_loses_water)
{
    scene::TemporaryFolder folder;
    auto summary = scene::run_summary(small);
    summary["ledger"]["water"]["relative_error"] = -1e-3;
    io::replace_text(folder / "summary.json", summary.dump());
    auto const page = page_of(folder.path());
    EXPECT_TRUE(holds(page, "2 of 3 ledgers not closed: do not use these results"));
    EXPECT_EQ(count(page, "<span class=\"light bad\">"), 1u);
}

TEST(Report, warns_of_an_unvalidated_map_until_the_summary_says_otherwise)
{
    scene::TemporaryFolder folder;
    scene::write_run_folder(folder.path(), small);
    EXPECT_TRUE(holds(page_of(folder.path()), "This map is not validated on a measured product."));
    auto summary = scene::run_summary(small);
    summary["product"]["validated"] = true;
    io::replace_text(folder / "summary.json", summary.dump());
    EXPECT_FALSE(holds(page_of(folder.path()), "not validated"));
}

TEST(Report, shows_hostile_text_as_text)
{
    scene::TemporaryFolder folder;
    auto hostile = small;
    hostile.title = "<script>alert('x')</script>";
    scene::write_run_folder(folder.path(), hostile);
    auto const page = page_of(folder.path());
    EXPECT_FALSE(holds(page, "<script"));
    EXPECT_TRUE(holds(page, "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;"));
}

TEST(Report, loads_nothing_from_outside)
{
    scene::TemporaryFolder folder;
    scene::write_run_folder(folder.path(), small);
    auto const page = page_of(folder.path());
    for (auto const* outside : {"http://", "https://", "src=", "@import", "<link"})
        EXPECT_FALSE(holds(page, outside)) << outside;
    EXPECT_TRUE(holds(page, "default-src 'none'"));
    EXPECT_EQ(count(page, "href="), count(page, "href=\"data:image/png;base64,"));
}

TEST(Report, is_made_from_an_empty_folder_too)
{
    scene::TemporaryFolder folder;
    auto const page = page_of(folder.path());
    for (auto const* id : sections) EXPECT_EQ(count(page, std::string("id=\"") + id + "\""), 1u) << id;
    EXPECT_TRUE(holds(page, "No events yet"));
    EXPECT_TRUE(holds(page, "not available"));
    EXPECT_TRUE(holds(page, "Not in this report: summary.json"));
    EXPECT_FALSE(holds(page, ">nan"));
}

TEST(Report, is_made_when_any_one_file_is_missing_or_broken)
{
    for (auto const* file : {"summary.json", "timeseries.csv", "events.h5", "snapshots.h5", "case.toml", "granum.log"})
        for (bool const broken : {false, true}) {
            scene::TemporaryFolder folder;
            scene::write_run_folder(folder.path(), small);
            if (file != std::string("snapshots.h5"))
                std::filesystem::remove(folder / "snapshots.h5");  // drawing takes time
            if (broken)
                io::replace_text(folder / file, "{\"spray\": [1, \"two");
            else
                std::filesystem::remove(folder / file);
            auto const page = page_of(folder.path());
            EXPECT_TRUE(page.ends_with("</html>\n")) << file;
        }
}

TEST(Report, of_a_run_stopped_at_once_says_that_there_are_no_events)
{
    scene::TemporaryFolder folder;
    scene::write_run_folder(folder.path(), {.granules = 50, .events = 0, .rows = 1});
    auto summary = scene::run_summary(small);
    summary["product"].erase("porosity");
    summary["ended"] = "stopped";
    summary["result"]["eta_global"] = nullptr;
    io::replace_text(folder / "summary.json", summary.dump());
    auto const page = page_of(folder.path());
    EXPECT_TRUE(holds(page, "No events yet"));
    EXPECT_TRUE(holds(page, "No product property yet"));
    EXPECT_TRUE(holds(page, "The run did not reach its end (stopped)"));
}

TEST(Report, of_a_missing_folder_is_an_error_that_names_it)
{
    try {
        write("/nowhere/run");
        FAIL() << "a report of nothing was made";
    } catch (base::IoError const& error) {
        EXPECT_NE(std::string(error.what()).find("/nowhere/run"), std::string::npos);
    }
}

TEST(Numbers, are_written_as_engineers_write_them)
{
    EXPECT_EQ(number(0.717493, 4), "0.7175");
    EXPECT_EQ(number(65.61, 3), "65.6");
    EXPECT_EQ(number(1.3e-12), "1.3e-12");
    EXPECT_EQ(number(12345), "12\u202f345");
    EXPECT_EQ(whole(1234567), "1\u202f234\u202f567");
    EXPECT_EQ(number(-3.5, 2), "-3.5");
    EXPECT_EQ(number(0), "0");
    EXPECT_EQ(number(std::nan("")), "not available");
    EXPECT_EQ(quantity(std::nullopt, "m"), "not available");
    EXPECT_EQ(duration(3725), "1 h 2 min");
}
}
