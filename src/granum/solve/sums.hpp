// Sums in eight parts, so that the order of additions is the same on any machine.
#pragma once

#include <cstddef>

namespace granum::solve
{
//! Sum of term(m) from `first` to below `end`; to be inlined into a loop that is vectorised.
template <class Term>
[[gnu::always_inline]] inline double sum_of(std::size_t first, std::size_t end, Term const term)
{
    double part[8]{};
    std::size_t m = first;
    for (; m + 8 <= end; m += 8) {
#pragma GCC ivdep
        for (std::size_t k = 0; k < 8; ++k) part[k] += term(m + k);
    }
    for (int k = 0; m < end; ++m, ++k) part[k] += term(m);
    return ((part[0] + part[4]) + (part[1] + part[5])) + ((part[2] + part[6]) + (part[3] + part[7]));
}
}
