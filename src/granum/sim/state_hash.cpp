#include "granum/sim/state_hash.hpp"

#include "granum/io/hash.hpp"
#include "granum/particle/rows.hpp"

#include <array>
#include <cstring>

namespace granum::sim
{
std::string state_hash(particle::Store const& granules, par::Communicator const& comm)
{
    std::array<std::uint64_t, 3> mine{granules.owned, 0, 0};
    std::vector<std::byte> row_bytes;
    for (std::size_t row = 0; row < granules.owned; ++row) {
        row_bytes.clear();
        particle::pack_row(granules, row, particle::Columns::all, row_bytes);
        auto const hash = io::wide_hash_of(row_bytes);
        mine[1] += hash[0], mine[2] += hash[1];
    }
    auto all = comm.gather(std::as_bytes(std::span(mine)));
    comm.broadcast(all);
    std::array<std::uint64_t, 3> sum{};
    for (std::size_t at = 0; at + sizeof mine <= all.size(); at += sizeof mine) {
        std::memcpy(mine.data(), all.data() + at, sizeof mine);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += mine[k];
    }
    auto const hash = io::wide_hash_of(std::as_bytes(std::span(sum)));
    return io::hash_text(hash[1]) + io::hash_text(hash[0]);
}
}
