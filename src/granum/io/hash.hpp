// Checksums: the 64-bit and 128-bit XXH3 of any bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace granum::io
{
//! Bytes in, 64 bits out; the digest may be asked for at any moment and adding may go on.
class Hash
{
  public:
    Hash();
    ~Hash();
    Hash(Hash&&) noexcept;
    Hash& operator=(Hash&&) noexcept;

    void add(std::span<std::byte const> bytes);
    std::uint64_t digest() const;

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

std::uint64_t hash_of(std::span<std::byte const> bytes);
std::uint64_t hash_of(std::string const& text);
std::array<std::uint64_t, 2> wide_hash_of(std::span<std::byte const> bytes);

//! Sixteen lower-case hexadecimal digits.
std::string hash_text(std::uint64_t hash);
}
