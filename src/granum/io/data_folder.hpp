// Where the files that come with the program are: units, materials, templates.
#pragma once

#include <string>

namespace granum::io
{
//! Folder with `units/` and `materials/`: $GRANUM_DATA, else ../share/granum beside the program, else the source
//! tree's. Throws base::IoError where none of them exists.
std::string data_folder();
}
