// A folder of its own for a test, gone when the test ends.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace granum::scene
{
class TemporaryFolder
{
  public:
    TemporaryFolder()
    {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("granum-test-" + std::to_string(getpid()) + "-" + std::to_string(count++));
        std::filesystem::remove_all(path_);  // of a test that was killed, whose number has come round again
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;

    std::string path() const { return path_; }
    std::string operator/(std::string const& file) const { return path_ / file; }

  private:
    std::filesystem::path path_;
};
}
