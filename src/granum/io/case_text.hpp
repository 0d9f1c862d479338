// How a case reads and writes text: parsing with errors that name the line, values and names for messages.
#pragma once

#include "granum/io/case_file.hpp"

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace granum::io
{
//! A value as it is written in a case, shortened to fit a message.
std::string as_written(toml::node const& node);

//! "nozzle[1].position" -> "nozzle[].position": the key that the documentation knows.
std::string general(std::string const& key);

//! What stands before the last dot of a key.
std::string parent(std::string const& key);

std::string joined(std::vector<std::string> const& names);

//! The bytes of a case. Throws base::CaseError with the names in that folder where there is no such file.
std::string read_case_text(std::string const& path);

//! Throws base::CaseError with the line where the text is not TOML.
toml::table parse(std::string const& text, std::string const& path);

//! "allowed: above 0", "allowed: 0 to 1", in the unit people use.
std::string allowed(Range const& range, Dimension dimension);
}
