#include "granum/base/bandwidth.hpp"

#include "granum/base/vectorised.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace granum::base
{
namespace
{
constexpr std::size_t elements = std::size_t{8} << 20;

GRANUM_VECTORISED void triad(std::size_t size, double factor, double const* __restrict b, double const* __restrict c,
                             double* __restrict a)
{
#pragma GCC ivdep
    for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + factor * c[i];
}
}

Triad::Triad() : a_(elements, 0.0), b_(elements, 1.5), c_(elements, 2.5) {}

double Triad::rate()
{
    double best = 0;
    for (int k = 0; k < 3; ++k) {
        auto const start = std::chrono::steady_clock::now();
        triad(elements, 3.0 + k, b_.data(), c_.data(), a_.data());
        std::chrono::duration<double> const taken = std::chrono::steady_clock::now() - start;
        best = std::max(best, 24.0 * elements / taken.count());
        b_[0] = a_[elements / 2];  // the result is used, so the loop is not dropped
    }
    return best;
}
}
