// Base64 (RFC 4648), the text form of binary data inside XML and HTML.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granum::io
{
std::string base64(std::span<std::byte const> bytes);

//! Bytes of one padded base64 text; blanks and line ends are skipped. Throws base::IoError on any other character.
std::vector<std::byte> from_base64(std::string_view text);
}
