#include "granum/io/folder_lock.hpp"

#include "granum/base/error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace granum::io
{
FolderLock::FolderLock(std::string const& folder, double patience)
{
    auto const path = folder + "/lock";
    file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) throw base::IoError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
    using Clock = std::chrono::steady_clock;
    auto const end = Clock::now() + std::chrono::duration<double>(patience);
    while (flock(file_, LOCK_EX | LOCK_NB) != 0) {
        if (Clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            continue;
        }
        close(file_);
        throw base::IoError(fmt::format("{}: another run is at work in this folder", folder));
    }
}

FolderLock::~FolderLock()
{
    close(file_);
}
}
