#include "granum/dem/contact_store.hpp"

#include <algorithm>
#include <bit>

namespace granum::dem
{
std::vector<Contact> ContactStore::active(particle::Store const& granules) const
{
    std::vector<Contact> out;
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (touching[k]) out.push_back({granules.id[pairs[k].low], granules.id[pairs[k].high], false, history[k]});
    for (std::size_t k = 0; k < wall_rows.size(); ++k)
        if (wall_touching[k]) out.push_back({granules.id[wall_rows[k].row], wall_rows[k].wall, true, wall_history[k]});
    return out;
}

void SavedContacts::collect(ContactStore const& contacts, particle::Store const& granules)
{
    entries_.clear();
    std::fill(index_.begin(), index_.end(), 0u);
    grow(static_cast<std::size_t>(std::count(contacts.touching.begin(), contacts.touching.end(), 1) +
                                  std::count(contacts.wall_touching.begin(), contacts.wall_touching.end(), 1)));
    for (auto const& contact : contacts.active(granules))
        add({contact.low, contact.wall ? wall_bit | contact.high : contact.high, contact.history});
}

std::size_t SavedContacts::place(Id first, Id second) const
{
    std::size_t const mask = index_.size() - 1;
    std::uint64_t hash = (first * 0x9E3779B97F4A7C15u) ^ (second * 0xC2B2AE3D27D4EB4Fu);
    hash ^= hash >> 29;
    std::size_t at = static_cast<std::size_t>(hash) & mask;
    while (index_[at] != 0) {
        auto const& entry = entries_[index_[at] - 1];
        if (entry.first == first && entry.second == second) break;
        at = (at + 1) & mask;
    }
    return at;
}

void SavedContacts::grow(std::size_t entries)
{
    std::size_t const wanted = std::bit_ceil(std::max<std::size_t>(64, 3 * entries));
    if (wanted <= index_.size()) return;
    index_.assign(wanted, 0);
    for (std::size_t k = 0; k < entries_.size(); ++k)
        index_[place(entries_[k].first, entries_[k].second)] = static_cast<std::uint32_t>(k + 1);
}

void SavedContacts::add(Entry const& entry)
{
    grow(entries_.size() + 1);
    std::size_t const at = place(entry.first, entry.second);
    if (index_[at] != 0) {
        entries_[index_[at] - 1] = entry;
        return;
    }
    entries_.push_back(entry);
    index_[at] = static_cast<std::uint32_t>(entries_.size());
}

History const* SavedContacts::find(Id first, Id second) const
{
    if (entries_.empty()) return nullptr;
    std::size_t const at = index_[place(first, second)];
    return at == 0 ? nullptr : &entries_[at - 1].history;
}
}
