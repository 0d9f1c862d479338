#include "granum/io/text_file.hpp"

#include "granum/base/error.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace granum::io
{
std::string read_text(std::string const& path)
{
    std::ifstream in(path, std::ios::binary);
    if (!in) throw base::IoError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
    std::ostringstream out;
    out << in.rdbuf();
    if (in.bad()) throw base::IoError(fmt::format("{}: cannot be read to its end", path));
    return std::move(out).str();
}

void rename_into_place(std::string const& temporary, std::string const& path)
{
    std::error_code failure;
    std::filesystem::rename(temporary, path, failure);
    if (failure) throw base::IoError(fmt::format("{}: cannot be replaced: {}", path, failure.message()));
}

void replace_text(std::string const& path, std::string_view content)
{
    std::string const temporary = path + ".part";
    {
        std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
        if (!out) throw base::IoError(fmt::format("{}: cannot be written: {}", temporary, std::strerror(errno)));
        out.write(content.data(), static_cast<std::streamsize>(content.size()));
        out.flush();
        if (!out) throw base::IoError(fmt::format("{}: cannot be written to its end; is the disk full?", temporary));
    }
    rename_into_place(temporary, path);
}
}
