// The page of a map: how its models do on runs they were not given, what a layer element's property depends on, where
// the lab has been.
#pragma once

#include "granum/map/fit.hpp"

#include <string>

namespace granum::report
{
//! Writes the page of a map that was compared (map::Wanted). Throws base::IoError.
void write_map_page(map::Map const& map, std::string const& title, std::string const& path);
}
