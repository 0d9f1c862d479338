// Equal states have equal hashes; a state that differs in one bit has another one.
#include "granum/sim/state_hash.hpp"
#include "granum/io/hash.hpp"
#include "granum/particle/rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;

namespace
{
particle::Store some_granules(std::size_t number)
{
    particle::Store granules;
    granules.resize(number);
    granules.owned = number;
    double next = 0.1;
    for (std::size_t row = 0; row < number; ++row) granules.id[row] = 7 * row;
    particle::for_each_column(granules, [&](auto& column) {
        if constexpr (std::is_same_v<std::decay_t<decltype(column[0])>, double>)
            for (auto& value : column.values) value = next = std::fmod(3.7 * next, 1.0) + 0.01;
    });
    return granules;
}
par::Communicator const& alone()
{
    static par::Communicator const comm{MPI_COMM_SELF};
    return comm;
}
}

TEST(StateHash, does_not_see_the_order_of_rows)
{
    auto granules = some_granules(5);
    auto const before = sim::state_hash(granules, alone());
    particle::reorder(granules, std::vector<std::uint32_t>{3, 0, 4, 2, 1});
    EXPECT_EQ(sim::state_hash(granules, alone()), before);
    EXPECT_EQ(before.size(), 32u);
}

TEST(StateHash, sees_the_last_bit_of_every_column)
{
    auto granules = some_granules(5);
    auto const before = sim::state_hash(granules, alone());
    particle::for_each_column(granules, [&](auto& column) {
        auto* byte = reinterpret_cast<unsigned char*>(&column[2]);
        *byte ^= 1u;
        EXPECT_NE(sim::state_hash(granules, alone()), before) << column.traits.name;
        *byte ^= 1u;
    });
    EXPECT_EQ(sim::state_hash(granules, alone()), before);
}

TEST(StateHash, sees_two_granules_exchange_a_value_and_one_leave)
{
    auto granules = some_granules(5);
    auto const before = sim::state_hash(granules, alone());
    std::swap(granules.radius[1], granules.radius[2]);
    EXPECT_NE(sim::state_hash(granules, alone()), before);
    std::swap(granules.radius[1], granules.radius[2]);
    granules.owned = 4;
    EXPECT_NE(sim::state_hash(granules, alone()), before);
}

TEST(Hash, is_the_published_one_however_the_bytes_arrive)
{
    // Test vector of XXH3_64bits for no input (xxHash specification).
    EXPECT_EQ(io::hash_of(std::span<std::byte const>{}), 0x2D06800538D394C2ull);
    std::string const text = "granules";
    auto const bytes = std::as_bytes(std::span(text));
    io::Hash hash;
    for (auto const& byte : bytes) hash.add({&byte, 1});
    EXPECT_EQ(hash.digest(), io::hash_of(text));
}
