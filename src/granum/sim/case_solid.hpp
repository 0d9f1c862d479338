// Reads one table that states a solid: of [[apparatus.solid]] or [[internal]].
#pragma once

#include "granum/geometry/solid.hpp"
#include "granum/io/case_file.hpp"

#include <optional>
#include <string>

namespace granum::sim
{
//! The path of a file that `key` names beside the case or in a folder there; nothing, and a mistake, where it leads out
//! of the folder of the case: a case that is passed on with its folder must find its files, and no others.
std::optional<std::string> read_path(io::CaseFile& file, std::string const& key, std::string const& doc);

//! The solid at the keys that begin with `key` ("internal[0]."); nothing, and mistakes, where it is none. `apparatus`
//! is the size that it must fit, m; 0: not known.
std::optional<geometry::Solid> read_solid(io::CaseFile& file, std::string const& key, double apparatus);
}
