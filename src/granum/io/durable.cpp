#include "granum/io/durable.hpp"

#include "granum/base/error.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace granum::io
{
namespace
{
namespace fs = std::filesystem;

int real_open(char const* path, int flags, mode_t mode)
{
    return ::open(path, flags, mode);
}

[[noreturn]] void fail(std::string const& path, char const* what, int error)
{
    std::error_code unknown;
    auto const parent = fs::path(path).parent_path();
    auto const space = fs::space(parent.empty() ? fs::path(".") : parent, unknown);
    std::string const left = unknown ? "" : fmt::format("; {:.1f} MB are free there", 1e-6 * double(space.available));
    throw base::IoError(fmt::format("{}: {}: {}{}", path, what, std::strerror(error), left));
}

//! An open file, closed in any case; `close` reports what the system only tells at the end.
class File
{
  public:
    File(SystemCalls const& calls, std::string const& path, int flags)
        : calls_(calls), path_(path), file_(calls.open(path.c_str(), flags, 0644))
    {
        if (file_ < 0) fail(path_, "cannot be opened", errno);
    }
    ~File()
    {
        if (file_ >= 0) calls_.close(file_);
    }
    File(File const&) = delete;
    File& operator=(File const&) = delete;

    void write(std::span<std::byte const> bytes)
    {
        constexpr std::size_t most = std::size_t{1} << 30;  // one call takes less than 2 GiB
        while (!bytes.empty()) {
            auto const wrote = calls_.write(file_, bytes.data(), std::min(bytes.size(), most));
            if (wrote < 0 && errno == EINTR) continue;
            if (wrote < 0) fail(path_, "cannot be written", errno);
            bytes = bytes.subspan(static_cast<std::size_t>(wrote));
        }
    }
    void sync()
    {
        if (calls_.sync(file_) != 0) fail(path_, "cannot be brought to the disk", errno);
    }
    void close()
    {
        int const status = calls_.close(file_);
        file_ = -1;
        if (status != 0) fail(path_, "cannot be closed", errno);
    }

  private:
    SystemCalls const& calls_;
    std::string const& path_;
    int file_;
};
}

SystemCalls const& SystemCalls::real()
{
    static SystemCalls const calls{real_open, ::write, ::fsync, ::close, std::rename, ::mkdir};
    return calls;
}

void write_durably(SystemCalls const& calls, std::string const& path,
                   std::vector<std::span<std::byte const>> const& parts)
{
    File file(calls, path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
    for (auto const& part : parts) file.write(part);
    file.sync();
    file.close();
}

void sync_folder(SystemCalls const& calls, std::string const& path)
{
    File folder(calls, path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    folder.sync();
    folder.close();
}

void rename_durably(SystemCalls const& calls, std::string const& from, std::string const& to)
{
    if (calls.rename(from.c_str(), to.c_str()) != 0) fail(to, "cannot be renamed to", errno);
    auto const parent = fs::path(to).parent_path().string();
    sync_folder(calls, parent.empty() ? "." : parent);
}

void make_folder(SystemCalls const& calls, std::string const& path)
{
    if (calls.make_folder(path.c_str(), 0755) != 0) fail(path, "cannot be made", errno);
}
}
