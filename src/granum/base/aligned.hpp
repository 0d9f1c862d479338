// Arrays that start on a cache line and may lie on huge pages, for loops over many megabytes.
#pragma once

#include <sys/mman.h>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace granum::base
{
template <class T>
struct AlignedAllocator
{
    using value_type = T;
    static constexpr std::size_t line = 64, huge = std::size_t{1} << 21;

    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(AlignedAllocator<U> const&)
    {
    }
    T* allocate(std::size_t count)
    {
        std::size_t const bytes = count * sizeof(T), unit = bytes < huge ? line : huge;
        void* const memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
        if (memory == nullptr) throw std::bad_alloc();
        if (unit == huge) madvise(memory, bytes, MADV_HUGEPAGE);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) { std::free(memory); }
    bool operator==(AlignedAllocator const&) const = default;
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;
}
