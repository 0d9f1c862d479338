// Files that are on the disk when we say so: every write, sync and rename is checked, and an error says what is left.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace granum::io
{
//! The calls through which all bytes of a checkpoint go. Tests put ones in that fail.
struct SystemCalls
{
    int (*open)(char const* path, int flags, mode_t mode);
    ssize_t (*write)(int file, void const* bytes, std::size_t size);
    int (*sync)(int file);
    int (*close)(int file);
    int (*rename)(char const* from, char const* to);
    int (*make_folder)(char const* path, mode_t mode);

    static SystemCalls const& real();
};

//! Writes `parts` one after the other into the new file `path` and syncs it. Throws base::IoError naming the file, the
//! cause and the free space of its disk.
void write_durably(SystemCalls const& calls, std::string const& path,
                   std::vector<std::span<std::byte const>> const& parts);

//! @{ The same for a folder's entries, for a rename, for a new folder.
void sync_folder(SystemCalls const& calls, std::string const& path);
void rename_durably(SystemCalls const& calls, std::string const& from, std::string const& to);
void make_folder(SystemCalls const& calls, std::string const& path);
//! @}
}
