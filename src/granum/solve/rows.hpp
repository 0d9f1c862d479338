// Between a row of cells and its cells of either colour, each contiguous. To be inlined into functions that are made
// for several instruction sets.
#pragma once

namespace granum::solve
{
//! one := 0th, 2nd, 4th ... of the row, other := 1st, 3rd ..., times `scale`.
template <class From, class To>
[[gnu::always_inline]] inline void deal_row(int count, From scale, From const* __restrict row, To* __restrict one,
                                            To* __restrict other)
{
    int const pairs = count / 2;
#pragma GCC ivdep
    for (int m = 0; m < pairs; ++m) {
        one[m] = static_cast<To>(scale * row[2 * m]);
        other[m] = static_cast<To>(scale * row[2 * m + 1]);
    }
    if (count % 2 != 0) one[pairs] = static_cast<To>(scale * row[2 * pairs]);
}

template <class From, class To>
[[gnu::always_inline]] inline void join_row(int count, From const* __restrict one, From const* __restrict other,
                                            To* __restrict row)
{
    int const pairs = count / 2;
#pragma GCC ivdep
    for (int m = 0; m < pairs; ++m) {
        row[2 * m] = static_cast<To>(one[m]);
        row[2 * m + 1] = static_cast<To>(other[m]);
    }
    if (count % 2 != 0) row[2 * pairs] = static_cast<To>(one[pairs]);
}
}
