// The frame of every page: one file that opens without a network and prints well.
#pragma once

#include <string>

namespace granum::report
{
//! A page with the style of all reports. `title` is text, `body` is HTML.
std::string whole_page(std::string const& title, std::string const& body);
}
