// From a lab's file and its run folders to a map, onto the disk and back; what is wrong with such a file is told with
// its line.
#include "granum/map/lab.hpp"
#include "granum/map/trend.hpp"

#include "granum/base/error.hpp"
#include "granum/io/events_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace
{
using namespace granum;
using namespace granum::map;
namespace fs = std::filesystem;

struct Folder
{
    fs::path path = fs::temp_directory_path() / fs::path("granum_lab_test_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

//! A run folder whose deposits dry in about `time` s: slowly at first, steady after a tenth of the run.
void run(fs::path const& folder, double time, double potential)
{
    fs::create_directories(folder);
    std::ofstream(folder / "summary.json") << R"({"title": "a run", "result": {"eta_global": )" << potential << "}}";
    std::vector<io::EventColumn> columns;
    for (auto const* name : {"granule", "t_dry_end", "solids", "initial"}) columns.push_back({name, "1", ""});
    for (auto const& name : event_variables()) columns.push_back({name, "1", ""});
    io::EventsWriter out((folder / "events.h5").string(), columns);
    for (int k = 0; k < 4000; ++k) {
        double const end = 1e-3 * k, start_up = 2 * std::exp(-end / 0.1);
        std::vector<double> row{static_cast<double>(k % 7), end, 1e-9, k % 10 == 0 ? 1.0 : 0.0};
        for (auto const& name : event_variables()) {
            double value = 0.5;
            if (name == "drying_time") value = time * std::pow(10, 0.2 * std::sin(1.0 * k) + start_up);
            if (name == "moisture_at_impact") value = 2 + 0.1 * std::cos(2.0 * k);
            row.push_back(value);
        }
        out.append(row);
    }
    out.flush();
}

std::string lab_text(std::string const& more = "")
{
    std::string out = "format = 1\ntitle = \"a lab\"\n[property]\nname = \"porosity\"\nlow = 0\nhigh = 1\n" + more;
    for (auto const& [name, value] : {std::pair{"A1", 0.3}, {"A2", 0.35}, {"A3", 0.4}, {"A4", 0.45}})
        out += fmt::format("[[run]]\nfolder = \"{}\"\nvalue = {}\nerror = 0.01\n", name, value);
    return out;
}

TEST(RunDeposits, are_those_of_the_spray_from_when_they_are_steady)
{
    Folder const folder;
    run(folder.path / "A1", 0.3, 0.7);
    auto const read = read_deposits((folder.path / "A1").string());
    EXPECT_EQ(read.potential, 0.7);
    EXPECT_EQ(read.title, "a run");
    EXPECT_TRUE(read.window.settled);
    EXPECT_GT(read.window.from, 0.2);
    EXPECT_LT(read.window.from, 1.5);
    EXPECT_NEAR(read.window.mean, std::log10(0.3), 0.01);
    EXPECT_LT(read.window.error, 0.01);
    EXPECT_NEAR(static_cast<double>(read.deposits.size()), 0.9 * (4 - read.window.from) * 1000, 3);
    EXPECT_THROW(read_deposits((folder.path / "none").string()), base::IoError);
}

TEST(Lab, is_fitted_written_and_read_again)
{
    Folder const folder;
    run(folder.path / "A1", 0.1, 0.9), run(folder.path / "A2", 0.2, 0.8), run(folder.path / "A3", 0.4, 0.7);
    run(folder.path / "A4", 0.8, 0.6), run(folder.path / "P", 0.3, 0.75);
    std::ofstream(folder.path / "lab.toml") << lab_text("order = \"rising\"\n");
    auto const lab = read_lab((folder.path / "lab.toml").string());
    auto const fitted = fit(lab);
    auto const file = (folder.path / "lab.map").string();
    write_map(fitted, lab.wanted, file);
    auto const again = read_map(file);

    auto const pilot = read_deposits((folder.path / "P").string());
    auto const at = features(fitted.known.axes, pilot.deposits);
    auto const before = predict(fitted, {{at, pilot.potential}}), after = predict(again, {{at, pilot.potential}});
    EXPECT_NEAR(before.mean, 0.3 + 0.05 * std::log2(3), 0.01);
    EXPECT_EQ(after.mean, before.mean);
    EXPECT_EQ(after.high, before.high);
    EXPECT_EQ(after.extrapolation, before.extrapolation);
    EXPECT_EQ(again.property, "porosity");
    EXPECT_EQ(again.known.along_first, Monotone::rising);

    auto const found = trend(fitted);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->slope, -0.5, 1e-9);
    EXPECT_EQ(found->agrees(), 1);
    EXPECT_NE(found->words().find("as published"), std::string::npos);
    auto other = fitted;
    other.property = "strength";
    EXPECT_EQ(trend(other)->agrees(), -1);
    EXPECT_NE(trend(other)->words().find("AGAINST"), std::string::npos);

    std::ofstream(file) << "{\"format\": 1}";
    EXPECT_THROW(read_map(file), base::IoError);
    std::ofstream(file) << "no map";
    EXPECT_THROW(read_map(file), base::IoError);
}

TEST(Lab, says_what_is_wrong_with_its_file)
{
    Folder const folder;
    for (auto const* name : {"A1", "A2", "A3", "A4"}) run(folder.path / name, 0.1, 0.5);
    auto const mistakes = [&](std::string const& text) -> std::string {
        std::ofstream(folder.path / "lab.toml") << text;
        try {
            read_lab((folder.path / "lab.toml").string());
        } catch (base::CaseError const& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(mistakes(lab_text()), "");
    auto const has = [](std::string const& text, char const* part) { return text.find(part) != std::string::npos; };
    EXPECT_PRED2(has, mistakes(lab_text("[map]\nvariables = [\"drying_tim\"]\n")), "drying_time");
    EXPECT_PRED2(has, mistakes(lab_text("[map]\nvariables = [\"weber\", \"weber\"]\n")), "two different ones");
    EXPECT_PRED2(has, mistakes(lab_text("[map]\nmodel = \"additiv\"\n")), "additive");
    EXPECT_PRED2(has, mistakes(lab_text("order = \"up\"\n")), "rising");
    EXPECT_PRED2(has, mistakes(lab_text() + "[[run]]\nfolder = \"B1\"\nvalue = 0.2\nerror = 0.01\n"),
                 "holds no events.h5");
    EXPECT_PRED2(has, mistakes(lab_text() + "[[run]]\nfolder = \"A1\"\nvalue = 2\nerror = 0.01\n"), "outside");
    EXPECT_PRED2(has, mistakes(lab_text() + "[[run]]\nfolder = \"A1\"\nvalue = 0.2\nerror = 0\n"), "run[4].error");
    EXPECT_PRED2(has, mistakes("format = 1\n[property]\nname = \"p\"\n"), "at least three runs");
}
}
