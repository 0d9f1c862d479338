#include "granum/particle/rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>

namespace
{
using namespace granum::particle;

TEST(Store, for_each_column_lists_every_column_once)
{
    Store granules;
    granules.keep({.added_mass = true, .turning = true, .eddies = true, .collisions = true});
    std::set<std::string_view> names;
    std::size_t columns = 0, bytes = 0;
    for_each_column(granules, [&](auto const& column) {
        names.insert(column.traits.name);
        ++columns;
        bytes += sizeof(column);
    });
    EXPECT_EQ(names.size(), columns);
    // A column that is a member but not listed would leave room unaccounted for.
    EXPECT_EQ(bytes + sizeof(std::size_t) + alignof(Store), sizeof(Store));
}

TEST(Store, without_a_group_spends_no_memory_on_it_and_knows_what_a_row_stands_for)
{
    Store granules;
    granules.keep({.parcel = false, .gas = false, .process = false});
    granules.resize(5);
    granules.radius[3] = 2e-3;
    std::size_t present = 0;
    for_every_column(granules, [&](auto const& column) {
        bool const core = column.traits.group == Group::core;
        EXPECT_EQ(column.values.size(), core ? 5u : 0u) << column.traits.name;
        EXPECT_EQ(column.values.capacity() > 0, core) << column.traits.name;
        present += core;
    });
    EXPECT_EQ(present, 9u);
    EXPECT_EQ(granules.real_count(3), 1);
    EXPECT_EQ(granules.real_diameter(3), 4e-3);
    granules.keep({.parcel = true, .gas = true, .process = false});
    EXPECT_EQ(granules.drag_rate.values, std::vector<double>(5));
    EXPECT_TRUE(granules.temperature.values.empty());
    EXPECT_TRUE(granules.added_mass.values.empty() && granules.spin_rate.values.empty());
    granules.keep({.added_mass = true, .turning = true, .eddies = true, .collisions = true});
    EXPECT_EQ(granules.added_mass.values, std::vector<double>(5));
    EXPECT_EQ(granules.spin_impulse.values.size(), 5u);
}

#ifdef GRANUM_CHECKS
TEST(Store, refuses_to_read_a_column_it_does_not_have)
{
    Store granules;
    granules.keep({.process = false});
    granules.resize(2);
    EXPECT_THROW(granules.temperature[0] = 300, granum::base::NumericsError);
    EXPECT_NO_THROW(granules.drag_rate[1] = 3);
}
#endif

Store numbered(std::size_t rows)
{
    Store granules;
    granules.keep({.added_mass = true, .turning = true, .eddies = true, .collisions = true});
    granules.resize(rows);
    granules.owned = rows;
    double next = 1;
    for (std::size_t row = 0; row < rows; ++row)
        for_each_column(granules, [&](auto& column) {
            using T = std::decay_t<decltype(column[row])>;
            if constexpr (std::is_same_v<T, Vec3>)
                column[row] = {next, next + 0.25, next + 0.5};
            else
                column[row] = static_cast<T>(next);
            ++next;
        });
    return granules;
}

bool same_row(Store const& a, std::size_t row_a, Store const& b, std::size_t row_b, Columns which)
{
    std::vector<std::byte> bytes_a, bytes_b;
    pack_row(a, row_a, which, bytes_a);
    pack_row(b, row_b, which, bytes_b);
    return bytes_a == bytes_b;
}

TEST(Rows, packed_and_unpacked_are_the_same)
{
    Store const from = numbered(3);
    Store to;
    to.keep(from.groups);
    to.resize(3);
    std::vector<std::byte> bytes;
    for (std::size_t row : {2u, 0u}) pack_row(from, row, Columns::all, bytes);
    EXPECT_EQ(bytes.size(), 2 * packed_size(from, Columns::all));
    auto rest = unpack_row(to, 1, Columns::all, bytes);
    rest = unpack_row(to, 2, Columns::all, rest);
    EXPECT_TRUE(rest.empty());
    EXPECT_TRUE(same_row(from, 2, to, 1, Columns::all));
    EXPECT_TRUE(same_row(from, 0, to, 2, Columns::all));
    EXPECT_FALSE(same_row(from, 0, to, 1, Columns::all));
}

TEST(Rows, of_ghosts_leave_columns_without_halo_alone)
{
    Store const from = numbered(1);
    Store to;
    to.resize(1);
    to.enthalpy[0] = -5;
    std::vector<std::byte> bytes;
    pack_row(from, 0, Columns::halo, bytes);
    unpack_row(to, 0, Columns::halo, bytes);
    EXPECT_EQ(to.position[0], from.position[0]);
    EXPECT_EQ(to.enthalpy[0], -5);
    EXPECT_LT(packed_size(from, Columns::halo), packed_size(from, Columns::all));
    Store bare = from;
    bare.keep({.parcel = false, .gas = false, .process = false});
    EXPECT_LT(packed_size(bare, Columns::halo), packed_size(from, Columns::halo));
}

TEST(Rows, reordered_move_as_a_whole_and_drop_what_is_not_named)
{
    Store const before = numbered(4);
    Store after = before;
    std::array<std::uint32_t, 3> const order{3, 0, 2};
    reorder(after, order);
    ASSERT_EQ(after.rows(), 3u);
    EXPECT_EQ(after.owned, 3u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(same_row(after, k, before, order[k], Columns::all));
}
}
