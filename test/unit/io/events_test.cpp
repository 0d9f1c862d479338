// Events and snapshots: rows survive appending, killing and reading back.
#include "granum/io/events_file.hpp"

#include "granum/base/error.hpp"
#include "granum/io/snapshot_file.hpp"
#include "granum/io/text_file.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

namespace granum::io
{
namespace
{
std::vector<EventColumn> const columns{{"weight", "1", "Real droplets that the event stands for."},
                                       {"age", "s", "Time of flight."},
                                       {"drying_time", "s", "From impact to dry."}};

//! `count` rows whose numbers name their row and column.
std::vector<double> rows(std::size_t first, std::size_t count)
{
    std::vector<double> out;
    for (std::size_t row = first; row < first + count; ++row)
        for (std::size_t c = 0; c < columns.size(); ++c)
            out.push_back(static_cast<double>(row) + 0.25 * static_cast<double>(c));
    return out;
}

void expect_rows(EventTable const& table, std::size_t count)
{
    ASSERT_EQ(table.columns.size(), columns.size());
    ASSERT_EQ(table.rows(), count);
    for (std::size_t c = 0; c < columns.size(); ++c)
        for (std::size_t row = 0; row < count; ++row)
            ASSERT_EQ(table.values[c][row], static_cast<double>(row) + 0.25 * static_cast<double>(c));
}
}

TEST(EventsFile, rows_of_several_calls_come_back_in_order)
{
    scene::TemporaryFolder folder;
    {
        EventsWriter writer(folder / "events.h5", columns);
        std::size_t written = 0;
        for (std::size_t const count : {1u, 0u, 4095u, 1u, 10000u, 3u}) {
            writer.append(rows(written, count));
            written += count;
            EXPECT_EQ(writer.rows(), written);
            if (count == 1) writer.flush();
        }
    }
    auto const table = read_events(folder / "events.h5");
    expect_rows(table, 14100);
    EXPECT_EQ(table.columns[0].name, "weight");  // as declared, not by the alphabet
    EXPECT_EQ(table.columns[2].unit, "s");
    EXPECT_EQ(table.columns[1].doc, "Time of flight.");
    ASSERT_NE(table.find("age"), nullptr);
    EXPECT_EQ(table.find("colour"), nullptr);
}

TEST(EventsFile, no_events_are_a_readable_file)
{
    scene::TemporaryFolder folder;
    {
        EventsWriter writer(folder / "events.h5", columns);
    }
    expect_rows(read_events(folder / "events.h5"), 0);
}

TEST(EventsFile, a_reader_may_look_while_the_run_goes_on)
{
    scene::TemporaryFolder folder;
    EventsWriter writer(folder / "events.h5", columns);
    writer.append(rows(0, 7));
    writer.flush();
    std::filesystem::copy_file(folder / "events.h5", folder / "copy.h5");
    expect_rows(read_events(folder / "copy.h5"), 7);
}

TEST(EventsFile, a_killed_writer_leaves_what_it_flushed)
{
    scene::TemporaryFolder folder;
    pid_t const child = fork();
    if (child == 0) {
        EventsWriter writer(folder / "events.h5", columns);
        writer.append(rows(0, 5000));
        writer.flush();
        writer.append(rows(5000, 200));
        writer.flush();
        writer.append(rows(5200, 5));
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    expect_rows(read_events(folder / "events.h5"), 5200);
}

TEST(EventsFile, what_is_not_an_event_file_is_named)
{
    scene::TemporaryFolder folder;
    replace_text(folder / "events.h5", "granum");
    for (auto const& path : {folder / "events.h5", folder / "missing.h5"}) {
        try {
            read_events(path);
            FAIL() << path << " was read";
        } catch (base::IoError const& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(path)) << error.what();
        }
    }
    EXPECT_THROW(EventsWriter(folder / "no/events.h5", columns), base::IoError);
}

TEST(EventsFile, a_broken_row_is_refused)
{
    scene::TemporaryFolder folder;
    EventsWriter writer(folder / "events.h5", columns);
    EXPECT_THROW(writer.append(std::vector<double>{1, 2}), base::NumericsError);
}

TEST(SnapshotFile, a_state_comes_back_whole)
{
    scene::TemporaryFolder folder;
    Snapshot in;
    in.time = 1.25;
    in.mid_plane = 0.05;
    in.outline = {{0, 0}, {0.1, 0}, {0.1, 0.4}};
    in.nozzles = {{0, 0, 0.3}};
    in.granules.position = {{1, 2, 3}, {4, 5, 6}};
    in.granules.radius = {1e-3, 2e-3};
    in.granules.moisture = {0.01, 0.02};
    in.gas.nx = 2, in.gas.nz = 1;
    in.gas.dx = 0.1;
    in.gas.speed = {3, 4};
    write_snapshot(folder / "s.h5", in);
    write_snapshot(folder / "s.h5", in);  // in place of the first
    auto const out = read_snapshot(folder / "s.h5");
    EXPECT_EQ(out.time, in.time);
    EXPECT_EQ(out.mid_plane, in.mid_plane);
    EXPECT_EQ(out.outline, in.outline);
    EXPECT_EQ(out.nozzles, in.nozzles);
    EXPECT_EQ(out.granules.position, in.granules.position);
    EXPECT_EQ(out.granules.radius, in.granules.radius);
    EXPECT_EQ(out.granules.moisture, in.granules.moisture);
    EXPECT_TRUE(out.granules.porosity.empty());
    EXPECT_TRUE(out.droplets.position.empty());
    EXPECT_EQ(out.gas.nx, 2);
    EXPECT_EQ(out.gas.dx, 0.1);
    EXPECT_EQ(out.gas.speed, in.gas.speed);
    EXPECT_FALSE(std::filesystem::exists(folder / "s.h5.part"));
}

TEST(SnapshotFile, the_outline_of_a_cone_is_its_cut)
{
    geometry::Chamber chamber;
    chamber.shape = geometry::Chamber::Shape::revolution;
    chamber.profile = {{0, 0.09}, {0.45, 0.125}};
    std::vector<std::array<double, 2>> const expected{{0.09, 0}, {0.125, 0.45}, {-0.125, 0.45}, {-0.09, 0}};
    EXPECT_EQ(mid_plane_outline(chamber), expected);
    EXPECT_EQ(mid_plane(chamber), 0);
}
}
