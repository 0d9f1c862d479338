#include "granum/io/hash.hpp"

#include "granum/base/error.hpp"

#include <xxhash.h>

namespace granum::io
{
struct Hash::Inside
{
    XXH3_state_t* state = XXH3_createState();
    Inside() { XXH3_64bits_reset(state); }
    ~Inside() { XXH3_freeState(state); }
    Inside(Inside const&) = delete;
    Inside& operator=(Inside const&) = delete;
};

Hash::Hash() : inside_(std::make_unique<Inside>()) {}
Hash::~Hash() = default;
Hash::Hash(Hash&&) noexcept = default;
Hash& Hash::operator=(Hash&&) noexcept = default;

void Hash::add(std::span<std::byte const> bytes)
{
    if (!bytes.empty()) XXH3_64bits_update(inside_->state, bytes.data(), bytes.size());
}

std::uint64_t Hash::digest() const
{
    return XXH3_64bits_digest(inside_->state);
}

std::uint64_t hash_of(std::span<std::byte const> bytes)
{
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t hash_of(std::string const& text)
{
    return hash_of(std::as_bytes(std::span(text)));
}

std::array<std::uint64_t, 2> wide_hash_of(std::span<std::byte const> bytes)
{
    auto const hash = XXH3_128bits(bytes.data(), bytes.size());
    return {hash.low64, hash.high64};
}

std::string hash_text(std::uint64_t hash)
{
    return fmt::format("{:016x}", hash);
}
}
