// The next event of each granule, the earliest on top: a heap in which every granule has one entry that can move.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace granum::dem
{
class EventQueue
{
  public:
    //! One entry per granule, with the times given.
    void fill(std::span<double const> times);
    std::uint32_t first() const { return heap_[0].who; }
    double first_time() const { return heap_[0].time; }
    bool empty() const { return heap_.empty(); }
    //! Moves the entry of `who` to `time`. O(log n).
    void move(std::uint32_t who, double time);

  private:
    struct Entry
    {
        double time;
        std::uint32_t who;
    };
    // Four children to an entry: half the depth of a binary heap, and siblings share a cache line.
    void rise(std::size_t at, Entry entry);
    void sink(std::size_t at, Entry entry);
    void put(std::size_t at, Entry const& entry)
    {
        heap_[at] = entry, place_[entry.who] = static_cast<std::uint32_t>(at);
    }

    std::vector<Entry> heap_;
    std::vector<std::uint32_t> place_;
};
}
