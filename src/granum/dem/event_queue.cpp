#include "granum/dem/event_queue.hpp"

#include <algorithm>

namespace granum::dem
{
void EventQueue::fill(std::span<double const> times)
{
    heap_.resize(times.size());
    place_.resize(times.size());
    for (std::size_t k = 0; k < times.size(); ++k) put(k, {times[k], static_cast<std::uint32_t>(k)});
    for (std::size_t k = heap_.size() / 4 + 1; k-- > 0;)
        if (k < heap_.size()) sink(k, heap_[k]);
}

void EventQueue::move(std::uint32_t who, double time)
{
    std::size_t const at = place_[who];
    if (time < heap_[at].time)
        rise(at, {time, who});
    else
        sink(at, {time, who});
}

void EventQueue::rise(std::size_t at, Entry entry)
{
    while (at > 0) {
        std::size_t const parent = (at - 1) / 4;
        if (!(entry.time < heap_[parent].time)) break;
        put(at, heap_[parent]);
        at = parent;
    }
    put(at, entry);
}

void EventQueue::sink(std::size_t at, Entry entry)
{
    for (;;) {
        std::size_t const first = 4 * at + 1, last = std::min(first + 4, heap_.size());
        if (first >= last) break;
        std::size_t least = first;
        for (std::size_t k = first + 1; k < last; ++k)
            if (heap_[k].time < heap_[least].time) least = k;
        if (!(heap_[least].time < entry.time)) break;
        put(at, heap_[least]);
        at = least;
    }
    put(at, entry);
}
}
