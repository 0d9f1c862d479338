#include "granum/dem/contact_store.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum::dem;

TEST(SavedContacts, are_found_by_identity_and_replaced_by_a_newer_entry)
{
    SavedContacts saved;
    for (Id first = 0; first < 300; ++first)
        for (Id second = first + 1; second < first + 4; ++second)
            saved.add({first, second, {.overlap = 1.0 * static_cast<double>(first * 1000 + second)}});
    saved.add({5, SavedContacts::wall_bit | 6, {.overlap = -1}});
    saved.add({5, 6, {.overlap = 42}});
    ASSERT_EQ(saved.entries().size(), 901u);
    EXPECT_EQ(saved.find(5, 6)->overlap, 42);
    EXPECT_EQ(saved.find(5, SavedContacts::wall_bit | 6)->overlap, -1);
    EXPECT_EQ(saved.find(299, 302)->overlap, 299302);
    EXPECT_EQ(saved.find(6, 5), nullptr);
    EXPECT_EQ(saved.find(299, 303), nullptr);
}

TEST(SavedContacts, take_what_touches_and_forget_the_rest)
{
    granum::particle::Store granules;
    granules.resize(3);
    granules.id.values = {10, 20, 30};
    ContactStore contacts;
    contacts.pairs = {{0, 1}, {1, 2}};
    contacts.touching = {0, 1};
    contacts.history.resize(2);
    contacts.history[1].normal_force = 7;
    contacts.wall_rows = {{0, 3}};
    contacts.wall_touching = {1};
    contacts.wall_history.resize(1);
    SavedContacts saved;
    saved.add({1, 2, {}});
    saved.collect(contacts, granules);
    EXPECT_EQ(saved.entries().size(), 2u);
    EXPECT_EQ(saved.find(1, 2), nullptr);
    EXPECT_EQ(saved.find(10, 20), nullptr);
    ASSERT_NE(saved.find(20, 30), nullptr);
    EXPECT_EQ(saved.find(20, 30)->normal_force, 7);
    EXPECT_NE(saved.find(10, SavedContacts::wall_bit | 3), nullptr);
}
}
