#include "granum/base/bandwidth.hpp"

#include "granum/base/vectorised.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace granum::base
{
namespace
{
GRANUM_VECTORISED void triad(std::size_t size, double factor, double const* __restrict b, double const* __restrict c,
                             double* __restrict a)
{
#pragma GCC ivdep
    for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + factor * c[i];
}
}

double triad_rate()
{
    constexpr std::size_t elements = std::size_t{8} << 20;
    std::vector<double> a(elements, 0.0), b(elements, 1.5), c(elements, 2.5);
    double best = 0;
    for (int k = 0; k < 3; ++k) {
        auto const start = std::chrono::steady_clock::now();
        triad(elements, 3.0 + k, b.data(), c.data(), a.data());
        std::chrono::duration<double> const taken = std::chrono::steady_clock::now() - start;
        best = std::max(best, 24.0 * elements / taken.count());
        b[0] = a[elements / 2];  // the result is used, so the loop is not dropped
    }
    return best;
}
}
