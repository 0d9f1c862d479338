// A campaign's points are the cases that its file says, each runs until its statistics are good enough, and what is
// wrong is told.
#include "granum/study/study.hpp"

#include "granum/base/error.hpp"
#include "granum/io/folder_lock.hpp"
#include "granum/sim/case_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace
{
using namespace granum;
using namespace granum::study;
namespace fs = std::filesystem;

struct Folder
{
    fs::path path = fs::temp_directory_path() / fmt::format("granum_study_test_{}", ::getpid());
    Folder()
    {
        fs::create_directories(path);
        fs::copy_file(GRANUM_SOURCE_DIR "/examples/01-lab-layering/case.toml", path / "lab.toml",
                      fs::copy_options::overwrite_existing);
    }
    ~Folder() { fs::remove_all(path); }

    std::string write(std::string const& text) const
    {
        std::ofstream(path / "study.toml") << text;
        return (path / "study.toml").string();
    }
    std::string mistakes(std::string const& text) const
    {
        try {
            read_study(write(text));
        } catch (base::CaseError const& error) {
            return error.what();
        }
        return "";
    }
};

TEST(Study, makes_each_point_of_the_case_and_what_it_sets)
{
    Folder const folder;
    auto const study = read_study(folder.write(R"(format = 1
title = "two points"
case = "lab.toml"
set.spray.temperature = "15 degC"
[window]
least = "3 s"
error = 0.02
[[point]]
name = "A1"
set.gas.temperature = "60 degC"
set.spray.rate = "0.6 kg/h"
[[point]]
name = "A2"
window.least = "2 s"
[point.set.granules]
parcels = 5000
)"));
    EXPECT_EQ(study.title, "two points");
    EXPECT_EQ(study.goal.least, 3);
    ASSERT_EQ(study.points.size(), 2u);
    EXPECT_EQ(study.points[0].goal.least, 3);
    EXPECT_EQ(study.points[1].goal.least, 2) << "its own";
    EXPECT_EQ(study.points[1].goal.error, 0.02) << "the study's";
    auto const read = [&](std::size_t k) {
        auto const file = folder.path / fmt::format("point-{}.toml", k);
        std::ofstream(file) << case_of(study, study.points[k]);
        return sim::read_case(file.string()).data;
    };
    auto const lab = sim::read_case((folder.path / "lab.toml").string()).data;
    auto const first = read(0), second = read(1);
    EXPECT_NEAR(first.gas.inlet.temperature, 333.15, 1e-9);
    EXPECT_NEAR(first.spray.rate, 0.6 / 3600, 1e-12);
    EXPECT_EQ(first.granules.parcels, lab.granules.parcels);
    EXPECT_EQ(first.gas.inlet.humidity, lab.gas.inlet.humidity);
    EXPECT_EQ(second.granules.parcels, 5000);
    EXPECT_NEAR(first.spray.temperature, 288.15, 1e-9) << "of all points";
    EXPECT_NEAR(second.spray.temperature, 288.15, 1e-9);
    EXPECT_EQ(second.spray.rate, lab.spray.rate);
}

TEST(Study, says_what_is_wrong_with_its_file)
{
    Folder const folder;
    auto const has = [](std::string const& text, char const* part) { return text.find(part) != std::string::npos; };
    std::string const head = "format = 1\ncase = \"lab.toml\"\n";
    EXPECT_EQ(folder.mistakes(head + "[[point]]\nname = \"A\"\n"), "");
    EXPECT_PRED2(has, folder.mistakes(head), "has points");
    EXPECT_PRED2(has, folder.mistakes("format = 1\n[[point]]\nname = \"A\"\n"), "no case of its own");
    EXPECT_PRED2(has, folder.mistakes(head + "[[point]]\nname = \"A/B\"\n"), "name of a folder");
    EXPECT_PRED2(has, folder.mistakes(head + "[[point]]\nname = \"A\"\n[[point]]\nname = \"A\"\n"), "there already");
    EXPECT_PRED2(has, folder.mistakes(head + "[window]\nleast = \"9 s\"\nmost = \"5 s\"\n[[point]]\nname = \"A\"\n"),
                 "below window.least");
    EXPECT_PRED2(has, folder.mistakes(head + "[[point]]\nname = \"A\"\nwindow.least = \"40 s\"\n"),
                 "below point[0].window.least");
    EXPECT_PRED2(has, folder.mistakes(head + "[[point]]\nname = \"A\"\nwindow.last = \"40 s\"\n"), "last");
    EXPECT_PRED2(has, folder.mistakes("reference = \"B\"\n" + head + "[[point]]\nname = \"A\"\n"),
                 "none of the points");
    EXPECT_PRED2(has, folder.mistakes(head + "[windows]\n[[point]]\nname = \"A\"\n"), "window");
    // A wrong value of a point is found before anything runs.
    auto const study = read_study(folder.write(head + "[[point]]\nname = \"A\"\nset.gas.temperature = \"60 bar\"\n"));
    int runs = 0;
    auto const runner = [&](std::string const&, std::string const&, double) { return ++runs; };
    EXPECT_THROW(run(study, (folder.path / "out").string(), runner, [](std::string const&) {}), base::CaseError);
    EXPECT_EQ(runs, 0);
}

TEST(Study, leaves_points_that_another_process_is_at_to_it)
{
    Folder const folder;
    auto const study =
        read_study(folder.write("format = 1\ncase = \"lab.toml\"\n[[point]]\nname = \"A\"\n[[point]]\nname = "
                                "\"B\"\n[[point]]\nname = \"C\"\n"));
    auto const out = folder.path / "out";
    fs::create_directories(out / "cases/claims/A");
    std::optional<io::FolderLock> const other(std::in_place, (out / "cases/claims/A").string(), 0.0);
    std::vector<std::string> runs;
    auto const stops = [&](std::string const&, std::string const& place, double) {
        runs.push_back(fs::path(place).filename().string());
        return 130;
    };
    auto const campaign = run(study, out.string(), stops, [](std::string const&) {});
    EXPECT_EQ(runs, std::vector<std::string>{"B"});
    EXPECT_TRUE(campaign.stopped);
    EXPECT_TRUE(campaign.outcomes.empty());
}

TEST(Study, takes_a_run_that_was_stopped_early_to_its_first_goal)
{
    Folder const folder;
    auto const study = read_study(
        folder.write("format = 1\ncase = \"lab.toml\"\n[window]\nleast = \"5 s\"\n[[point]]\nname = \"A\"\n"));
    // Before any deposit has dried: there is nothing to look at.
    auto const place = folder.path / "out/A";
    fs::create_directories(place);
    std::ofstream(place / "summary.json") << R"({"schema": 1, "run": {"simulated_s": 0.2}})";
    std::ofstream(place / "events.h5") << "";
    std::vector<double> goals;
    auto const stops = [&](std::string const&, std::string const&, double until) {
        goals.push_back(until);
        return 130;
    };
    EXPECT_TRUE(run(study, (folder.path / "out").string(), stops, [](std::string const&) {}).stopped);
    EXPECT_EQ(goals, std::vector<double>{6.5});
}

TEST(Study, lets_a_run_go_on_until_its_window_is_long_and_its_error_small)
{
    Goal const goal{.least = 5, .most = 20, .error = 0.01};
    EXPECT_FALSE(next_end(goal, {.from = 1, .to = 6.5, .settled = true, .error = 0.009}));
    EXPECT_NEAR(*next_end(goal, {.from = 1, .to = 4, .settled = true, .error = 0.005}), 6, 1e-12);
    // Twice the error: four times the length, and a tenth.
    EXPECT_NEAR(*next_end(goal, {.from = 1, .to = 5, .settled = true, .error = 0.02}), 1 + 1.1 * 16, 1e-12);
    EXPECT_NEAR(*next_end(goal, {.from = 1, .to = 6, .settled = true, .error = 0.2}), 21, 1e-12) << "window.most";
    EXPECT_FALSE(next_end(goal, {.from = 1, .to = 21.5, .settled = true, .error = 0.2}))
        << "it is as long as it may be";
    EXPECT_NEAR(*next_end(goal, {.from = 3, .to = 6, .settled = false, .error = 0.2}), 11, 1e-12);
    EXPECT_FALSE(next_end(goal, {.from = 25, .to = 50, .settled = false, .error = 0.2}));
}
}
