#include "granum/io/sections.hpp"

#include "granum/base/error.hpp"
#include "granum/io/hash.hpp"

#include <algorithm>
#include <bit>
#include <fstream>

namespace granum::io
{
static_assert(std::endian::native == std::endian::little, "the format is that of the machine");

namespace
{
constexpr std::string_view magic = "GRNMSECT";
constexpr std::uint32_t format = 1;
constexpr std::uint32_t most_sections = 4096;
constexpr std::uint16_t longest_name = 256;

template <class T>
void put(std::vector<std::byte>& out, T const& value)
{
    auto const* first = reinterpret_cast<std::byte const*>(&value);
    out.insert(out.end(), first, first + sizeof value);
}

//! Reads from the front of a file whose length is known; never beyond it.
class Reader
{
  public:
    explicit Reader(std::string const& path) : path_(path), in_(path, std::ios::binary | std::ios::ate)
    {
        if (!in_) throw base::IoError(fmt::format("{}: cannot be opened", path));
        left_ = static_cast<std::uint64_t>(in_.tellg());
        in_.seekg(0);
    }
    std::uint64_t left() const { return left_; }
    std::vector<std::byte> const& head() const { return head_; }

    void read(std::byte* to, std::uint64_t size)
    {
        if (size > left_) throw base::IoError(fmt::format("{}: ends too early", path_));
        in_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(size));
        if (!in_) throw base::IoError(fmt::format("{}: cannot be read to its end", path_));
        left_ -= size;
    }
    std::vector<std::byte> take(std::uint64_t size)
    {
        if (size > left_) throw base::IoError(fmt::format("{}: ends too early", path_));
        std::vector<std::byte> out(size);
        read(out.data(), size);
        head_.insert(head_.end(), out.begin(), out.end());
        return out;
    }
    template <class T>
    T number()
    {
        auto const bytes = take(sizeof(T));
        T value;
        std::memcpy(&value, bytes.data(), sizeof value);
        return value;
    }

  private:
    std::string const& path_;
    std::ifstream in_;
    std::uint64_t left_ = 0;
    std::vector<std::byte> head_;  // what `take` and `number` have read
};
}

Seal write_sections(SystemCalls const& calls, std::string const& path, Sections const& sections)
{
    base::require(sections.size() <= most_sections, "{}: {} sections are more than the format holds", path,
                  sections.size());
    std::vector<std::byte> head;
    for (char const c : magic) head.push_back(static_cast<std::byte>(c));
    put(head, format);
    put(head, static_cast<std::uint32_t>(sections.size()));
    std::uint64_t size = 0;
    for (auto const& section : sections) {
        base::require(section.name.size() <= longest_name, "{}: the name of section {} is too long", path,
                      section.name);
        put(head, static_cast<std::uint16_t>(section.name.size()));
        for (char const c : section.name) head.push_back(static_cast<std::byte>(c));
        put(head, static_cast<std::uint64_t>(section.bytes.size()));
        put(head, hash_of(section.bytes));
        size += section.bytes.size();
    }
    std::vector<std::span<std::byte const>> parts{head};
    for (auto const& section : sections) parts.emplace_back(section.bytes);
    write_durably(calls, path, parts);
    return {head.size() + size, hash_of(head)};
}

Sections read_sections(std::string const& path, Seal const& seal)
{
    Reader in(path);
    if (in.left() != seal.size)
        throw base::IoError(fmt::format("{}: has {} bytes, {} were written", path, in.left(), seal.size));
    auto const begin = in.take(magic.size());
    if (std::memcmp(begin.data(), magic.data(), magic.size()) != 0)
        throw base::IoError(fmt::format("{}: is no file of sections", path));
    if (auto const is = in.number<std::uint32_t>(); is != format)
        throw base::IoError(fmt::format("{}: has format {}; this version reads format {}", path, is, format));
    auto const count = in.number<std::uint32_t>();
    if (count > most_sections) throw base::IoError(fmt::format("{}: claims {} sections", path, count));
    Sections out(count);
    std::vector<std::uint64_t> length(count), hash(count);
    for (std::uint32_t k = 0; k < count; ++k) {
        auto const name_length = in.number<std::uint16_t>();
        if (name_length > longest_name) throw base::IoError(fmt::format("{}: a name is too long", path));
        auto const name = in.take(name_length);
        out[k].name.assign(reinterpret_cast<char const*>(name.data()), name.size());
        length[k] = in.number<std::uint64_t>();
        hash[k] = in.number<std::uint64_t>();
    }
    if (hash_of(in.head()) != seal.hash) throw base::IoError(fmt::format("{}: its table of contents is damaged", path));
    for (std::uint32_t k = 0; k < count; ++k) {
        if (length[k] > in.left()) throw base::IoError(fmt::format("{}: section {} ends too early", path, out[k].name));
        out[k].bytes.resize(length[k]);
        in.read(out[k].bytes.data(), length[k]);
        if (hash_of(out[k].bytes) != hash[k])
            throw base::IoError(fmt::format("{}: section {} is damaged (checksum)", path, out[k].name));
    }
    if (in.left() != 0) throw base::IoError(fmt::format("{}: goes on after its last section", path));
    return out;
}

Section const& find_section(Sections const& sections, std::string const& name)
{
    auto const found =
        std::find_if(sections.begin(), sections.end(), [&](auto const& section) { return section.name == name; });
    if (found == sections.end()) throw base::IoError(fmt::format("a checkpoint without the section {}", name));
    return *found;
}

void refuse_length(Section const& section, std::size_t unit)
{
    throw base::IoError(fmt::format("section {} of a checkpoint has {} bytes, which is no multiple of {}", section.name,
                                    section.bytes.size(), unit));
}
}
