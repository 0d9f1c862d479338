// The report of a run: one HTML page that opens without a network and prints well.
#pragma once

#include <string>

namespace granum::report
{
//! Makes `run_folder`/report.html and `run_folder`/pictures/*.png from what the run left, and returns the page's path.
//! Missing or broken files are listed on the page. Throws base::IoError if the folder is missing or cannot be written.
std::string write(std::string const& run_folder);
}
