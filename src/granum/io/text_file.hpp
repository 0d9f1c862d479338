// Whole text files: read at once, and replaced at once so that a reader never sees half of one.
#pragma once

#include <string>
#include <string_view>

namespace granum::io
{
//! The bytes of `path`. Throws base::IoError if it cannot be read.
std::string read_text(std::string const& path);

//! Puts `content` into `path` by way of a neighbouring file and a rename: `path` holds the old or the new text, never a
//! part. Throws base::IoError if the folder cannot be written or the disk is full.
void replace_text(std::string const& path, std::string_view content);

//! Gives `temporary` its final name `path`, in place of whatever was there. Throws base::IoError.
void rename_into_place(std::string const& temporary, std::string const& path);
}
