// Rows that can be cut back to what a checkpoint knew, and a folder that only one run writes to.
#include "granum/io/row_log.hpp"

#include "granum/base/error.hpp"
#include "granum/io/folder_lock.hpp"
#include "granum/io/text_file.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <vector>

using namespace granum;

namespace
{
using Rows = std::vector<std::vector<double>>;

Rows go_on(io::RowLog& log, io::RowLog::Mark const& mark)
{
    Rows rows;
    log.go_on(mark, [&](std::span<double const> row) { rows.emplace_back(row.begin(), row.end()); });
    return rows;
}
}

TEST(RowLog, goes_on_from_a_mark_as_if_nothing_had_come_after_it)
{
    scene::TemporaryFolder const folder;
    auto const path = folder / "rows";
    io::RowLog::Mark mark;
    {
        io::RowLog log(path, 2);
        log.begin();
        log.append(std::vector<double>{1, 2, 3, 4});
        mark = log.mark();
        log.append(std::vector<double>{5, 6});
    }
    EXPECT_EQ(mark.rows, 2u);
    {
        io::RowLog log(path, 2);
        EXPECT_EQ(go_on(log, mark), (Rows{{1, 2}, {3, 4}}));
        log.append(std::vector<double>{7, 8});
        mark = log.mark();
    }
    io::RowLog log(path, 2);
    EXPECT_EQ(go_on(log, mark), (Rows{{1, 2}, {3, 4}, {7, 8}})) << "5, 6 are taken back";
}

TEST(RowLog, notices_rows_that_are_missing_or_changed)
{
    scene::TemporaryFolder const folder;
    auto const path = folder / "rows";
    io::RowLog::Mark mark;
    {
        io::RowLog log(path, 2);
        log.begin();
        log.append(std::vector<double>{1, 2, 3, 4});
        mark = log.mark();
    }
    auto const good = io::read_text(path);
    for (auto const& bad : {good.substr(0, 31), std::string(), good.substr(0, 20) + "x" + good.substr(21)}) {
        std::ofstream(path, std::ios::binary | std::ios::trunc) << bad;
        io::RowLog log(path, 2);
        EXPECT_THROW(go_on(log, mark), base::IoError);
    }
    io::RowLog missing(folder / "none", 2);
    EXPECT_TRUE(go_on(missing, {}).empty()) << "nothing was written yet";
}

TEST(FolderLock, is_held_by_one_and_free_when_that_one_ends)
{
    scene::TemporaryFolder const folder;
    std::optional<io::FolderLock> first;
    first.emplace(folder.path(), 0);
    EXPECT_THROW(io::FolderLock(folder.path(), 0.1), base::IoError);
    first.reset();
    EXPECT_NO_THROW(io::FolderLock(folder.path(), 0));
}
