#include "granum/io/data_folder.hpp"

#include "granum/base/error.hpp"

#include <cstdlib>
#include <filesystem>

namespace granum::io
{
std::string data_folder()
{
    namespace fs = std::filesystem;
    std::error_code none;
    if (char const* chosen = std::getenv("GRANUM_DATA"); chosen && *chosen) {
        if (!fs::is_directory(chosen, none))
            throw base::IoError(fmt::format("GRANUM_DATA = {} is not a folder", chosen));
        return chosen;
    }
    auto const program = fs::read_symlink("/proc/self/exe", none);
    auto const installed = program.parent_path().parent_path() / "share" / "granum";
    if (!none && fs::is_directory(installed / "units", none)) return installed.string();
    if (fs::is_directory(GRANUM_SOURCE_DATA, none)) return GRANUM_SOURCE_DATA;
    throw base::IoError(
        fmt::format("no data folder: neither {} nor {} exists; set GRANUM_DATA to the folder that has "
                    "units/granum-units.xml",
                    installed.string(), GRANUM_SOURCE_DATA));
}
}
