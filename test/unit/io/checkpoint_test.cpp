// A checkpoint is whole or not there: flipped, cut, unfinished and unwritable ones are noticed, and the one before it
// is taken.
#include "granum/io/checkpoint.hpp"

#include "granum/base/error.hpp"
#include "granum/io/text_file.hpp"
#include "scene/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>

using namespace granum;
namespace fs = std::filesystem;

namespace
{
int calls_left = 1 << 30;  // until one fails

bool fails()
{
    if (calls_left-- > 0) return false;
    errno = ENOSPC;
    return true;
}

io::SystemCalls const counted{
    [](char const* path, int flags, mode_t mode) {
        return fails() ? -1 : io::SystemCalls::real().open(path, flags, mode);
    },
    [](int file, void const* bytes, std::size_t size) { return fails() ? ssize_t{-1} : ::write(file, bytes, size); },
    [](int file) { return fails() ? -1 : ::fsync(file); },
    [](int file) { return ::close(file); },
    [](char const* from, char const* to) { return fails() ? -1 : ::rename(from, to); },
    [](char const* path, mode_t mode) { return fails() ? -1 : io::SystemCalls::real().make_folder(path, mode); },
};

class Checkpoints : public ::testing::Test
{
  protected:
    scene::TemporaryFolder there;
    par::Communicator alone{MPI_COMM_SELF};
    std::string const path = there / "checkpoint";
    io::CheckpointFolder folder{path, alone};
    std::vector<std::string> passed_over;

    static io::Sections state(double value)
    {
        return {io::section_of("granules", std::vector<double>(100, value)),
                io::section_of("contacts", std::vector<double>{}),
                io::section_of("clock", std::vector<double>{value, 2})};
    }
    int write(double value) { return folder.write({"0.1", 77, value, 5, 1}, state(value)); }
    double newest_value()
    {
        passed_over.clear();
        auto const found = folder.newest(passed_over);
        return found ? io::values_of<double>(io::find_section(found->read(0), "clock")).at(0) : -1;
    }
    std::string file(int number) const { return fmt::format("{}/{:06d}/rank_00000", path, number); }
    std::string manifest(int number) const { return fmt::format("{}/{:06d}/manifest", path, number); }

    static void put(std::string const& file, std::string const& text)
    {
        std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
    }
};
}

TEST_F(Checkpoints, come_back_as_they_were)
{
    EXPECT_EQ(newest_value(), -1) << "none yet";
    write(0.1);
    auto const found = folder.newest(passed_over);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->label.program, "0.1");
    EXPECT_EQ(found->label.case_hash, 77u);
    EXPECT_EQ(found->label.time, 0.1);
    EXPECT_EQ(found->label.step, 5);
    EXPECT_EQ(found->label.ranks, 1);
    auto const sections = found->read(0);
    auto const wanted = state(0.1);
    ASSERT_EQ(sections.size(), wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        EXPECT_EQ(sections[k].name, wanted[k].name);
        EXPECT_EQ(sections[k].bytes, wanted[k].bytes);
    }
    EXPECT_THROW(io::find_section(sections, "gas"), base::IoError);
    EXPECT_THROW((io::values_of<std::array<char, 7>>(sections[0])), base::IoError) << "800 bytes are no sevens";
}

TEST_F(Checkpoints, of_many_the_last_two_and_every_tenth_are_kept)
{
    for (int n = 0; n <= 23; ++n) EXPECT_EQ(write(n), n);
    std::vector<std::string> kept;
    for (auto const& entry : fs::directory_iterator(path)) kept.push_back(entry.path().filename().string());
    std::sort(kept.begin(), kept.end());
    EXPECT_EQ(kept, (std::vector<std::string>{"000000", "000010", "000020", "000022", "000023"}));
    EXPECT_EQ(newest_value(), 23);
}

TEST_F(Checkpoints, flipped_anywhere_are_named_and_the_one_before_is_taken)
{
    write(1), write(2);
    for (auto const& damaged : {file(1), manifest(1)}) {
        auto const good = io::read_text(damaged);
        for (std::size_t at = 0; at<good.size(); at += good.size()> 300 ? 3 : 1) {
            auto bad = good;
            bad[at] = static_cast<char>(bad[at] ^ 0x10);
            put(damaged, bad);
            ASSERT_EQ(newest_value(), 1) << damaged << " with byte " << at << " flipped";
            ASSERT_EQ(passed_over.size(), 1u);
            EXPECT_NE(passed_over[0].find("000001"), std::string::npos) << passed_over[0];
        }
        put(damaged, good);
    }
    auto bad = io::read_text(file(1));
    bad.back() = static_cast<char>(bad.back() ^ 1);
    put(file(1), bad);
    EXPECT_EQ(newest_value(), 1);
    EXPECT_NE(passed_over[0].find("section clock is damaged"), std::string::npos) << passed_over[0];
}

TEST_F(Checkpoints, cut_anywhere_are_passed_over)
{
    write(1), write(2);
    for (auto const& damaged : {file(1), manifest(1)}) {
        auto const good = io::read_text(damaged);
        std::size_t const stride = std::max<std::size_t>(1, good.size() / 100);
        for (std::size_t size = 0; size < good.size(); size += stride) {
            put(damaged, good.substr(0, size));
            ASSERT_EQ(newest_value(), 1) << damaged << " cut to " << size << " bytes";
        }
        put(damaged, good + "more");
        EXPECT_EQ(newest_value(), 1) << damaged << " with more at its end";
        put(damaged, good);
    }
    EXPECT_EQ(newest_value(), 2);
    fs::remove(file(1));
    EXPECT_EQ(newest_value(), 1) << "a file is missing";
}

TEST_F(Checkpoints, claims_of_a_crafted_file_are_bounded)
{
    write(1), write(2);
    // A head that claims sections of 2^60 bytes, sealed as if it were ours.
    auto bad = io::read_text(file(1));
    bad.replace(8 + 4 + 4 + 2 + 8, 8, std::string("\0\0\0\0\0\0\0\x10", 8));
    put(file(1), bad);
    std::vector<std::byte> head(bad.size() - 816);
    std::memcpy(head.data(), bad.data(), head.size());
    EXPECT_THROW(io::read_sections(file(1), {bad.size(), 0}), base::IoError);
    EXPECT_EQ(newest_value(), 1);
}

TEST_F(Checkpoints, an_unfinished_one_is_no_checkpoint_and_is_swept_away)
{
    write(1);
    fs::create_directories(path + "/000001.tmp");
    fs::create_directories(path + "/000000.old");
    fs::create_directories(path + "/000007");  // renamed, but never completed: no manifest
    EXPECT_EQ(newest_value(), 1);
    folder.sweep();
    EXPECT_FALSE(fs::exists(path + "/000001.tmp"));
    EXPECT_FALSE(fs::exists(path + "/000000.old"));
    EXPECT_TRUE(fs::exists(path + "/000000"));
}

TEST_F(Checkpoints, whichever_call_fails_the_last_one_stays_and_the_message_names_file_and_space)
{
    write(1);
    io::CheckpointFolder const failing(path, alone, counted);
    int failures = 0;
    for (int allowed = 0; allowed < 100; ++allowed) {
        calls_left = allowed;
        try {
            failing.write({"0.1", 77, 3, 5, 1}, state(3));
            break;  // enough calls for a whole one
        } catch (base::IoError const& error) {
            ++failures;
            std::string const words = error.what();
            EXPECT_EQ(static_cast<int>(error.exit), 74);
            EXPECT_NE(words.find(path), std::string::npos) << words;
            EXPECT_NE(words.find("MB are free"), std::string::npos) << words;
            EXPECT_NE(words.find("No space left"), std::string::npos) << words;
            double const value = newest_value();
            EXPECT_TRUE(value == 1 || value == 3) << "after " << allowed << " calls: " << value;
            if (value == 3) fs::remove_all(path + "/000001");  // complete, only its rename was not synced
        }
    }
    EXPECT_GT(failures, 8) << "calls of a checkpoint: make, open, write and sync two files and two folders, rename";
    EXPECT_EQ(newest_value(), 3);
}

TEST_F(Checkpoints, a_file_too_large_for_its_limit_is_an_error_not_a_signal)
{
    write(1);
    struct rlimit before = {};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    auto const handler = std::signal(SIGXFSZ, SIG_IGN);
    struct rlimit small = before;
    small.rlim_cur = 500;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(write(2), base::IoError);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(newest_value(), 1);
    EXPECT_EQ(write(3), 1) << "goes on when there is room";
    EXPECT_EQ(newest_value(), 3);
}
