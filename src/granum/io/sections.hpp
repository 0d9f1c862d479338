// A file of named sections of bytes, each with length and checksum: our own format, safe to read whatever it holds.
//
// Layout, little endian: 8 bytes "GRNMSECT", format number and number of sections (32 bits each), then per section
// the length of its name (16 bits), the name, length and XXH3 checksum of its bytes (64 bits each); then the bytes of
// all sections in this order. The checksum of all before the bytes is the file's seal, kept in a manifest elsewhere.
#pragma once

#include "granum/io/durable.hpp"

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace granum::io
{
struct Section
{
    std::string name;
    std::vector<std::byte> bytes;
};

using Sections = std::vector<Section>;

//! What a manifest remembers of a file.
struct Seal
{
    std::uint64_t size = 0;  //!< of the whole file
    std::uint64_t hash = 0;  //!< of its head, which holds the checksums of all sections
};

//! Writes and syncs. Throws base::IoError.
Seal write_sections(SystemCalls const& calls, std::string const& path, Sections const& sections);

//! Reads and verifies. Throws base::IoError naming file and section where anything is not as it was written, or where
//! the file is not the one that was sealed.
Sections read_sections(std::string const& path, Seal const& seal);

[[noreturn]] void refuse_length(Section const& section, std::size_t unit);

//! @{ Plain values and arrays of them as a section, and back. Reading throws base::IoError where the length does not
//! fit.
template <class T>
Section section_of(std::string name, std::vector<T> const& values)
{
    static_assert(std::is_trivially_copyable_v<T>);
    Section out{std::move(name), std::vector<std::byte>(values.size() * sizeof(T))};
    if (!values.empty()) std::memcpy(out.bytes.data(), values.data(), out.bytes.size());
    return out;
}
template <class T>
std::vector<T> values_of(Section const& section)
{
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> out(section.bytes.size() / sizeof(T));
    if (out.size() * sizeof(T) != section.bytes.size()) refuse_length(section, sizeof(T));
    if (!out.empty()) std::memcpy(static_cast<void*>(out.data()), section.bytes.data(), section.bytes.size());
    return out;
}
//! @}

//! The section called `name`. Throws base::IoError where there is none.
Section const& find_section(Sections const& sections, std::string const& name);
}
