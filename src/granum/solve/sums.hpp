// Sums in eight parts, so that the order of additions is the same on any machine. To be inlined into
// functions that are made for several instruction sets.
#pragma once

#include <cstddef>
#include <cstring>

namespace granum::solve
{
using Eight [[gnu::vector_size(64)]] = double;

[[gnu::always_inline]] inline void load(double const* from, Eight& to)
{
    std::memcpy(&to, from, sizeof to);
}
[[gnu::always_inline]] inline void load(float const* from, Eight& to)
{
    using EightFloats [[gnu::vector_size(32)]] = float;
    EightFloats floats;
    std::memcpy(&floats, from, sizeof floats);
    to = __builtin_convertvector(floats, Eight);
}

[[gnu::always_inline]] inline double total(Eight const& part)
{
    return ((part[0] + part[4]) + (part[1] + part[5])) + ((part[2] + part[6]) + (part[3] + part[7]));
}

template <class Number>
[[gnu::always_inline]] inline double sum(std::size_t first, std::size_t end, Number const* a)
{
    Eight part{}, x;
    std::size_t m = first;
    for (; m + 8 <= end; m += 8) {
        load(a + m, x);
        part += x;
    }
    for (int k = 0; m < end; ++m, ++k) part[k] += static_cast<double>(a[m]);
    return total(part);
}

template <class Number>
[[gnu::always_inline]] inline double dot(std::size_t first, std::size_t end, Number const* a, Number const* b)
{
    Eight part{}, x, y;
    std::size_t m = first;
    for (; m + 8 <= end; m += 8) {
        load(a + m, x);
        load(b + m, y);
        part += x * y;
    }
    for (int k = 0; m < end; ++m, ++k) part[k] += static_cast<double>(a[m]) * static_cast<double>(b[m]);
    return total(part);
}
}
