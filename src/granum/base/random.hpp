// Counter-based random numbers (Philox 4x32-10; Salmon et al., SC'11): a draw is a function of
// (seed, purpose, id, step), so it depends neither on order, nor on ranks, nor on a restart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace granum::base
{
//! Ten rounds of Philox 4x32 over `counter` with `key`.
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key)
{
    for (int round = 0; round < 10; ++round) {
        std::uint64_t const p0 = std::uint64_t{0xD2511F53u} * counter[0];
        std::uint64_t const p1 = std::uint64_t{0xCD9E8D57u} * counter[2];
        counter = {static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
                   static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
        key[0] += 0x9E3779B9u;
        key[1] += 0xBB67AE85u;
    }
    return counter;
}

//! What a stream is for: streams of different purposes never share a draw.
enum class Purpose : std::uint32_t
{
    packing = 1,
    sizes,
    droplet,
    capture,
    impact,
    deposit,
    test,
    agitation,
    dispersion,
    surface,
    bootstrap
};

//! A stream of numbers for one (seed, purpose, id, step).
class Random
{
  public:
    Random(std::uint32_t seed, Purpose purpose, std::uint64_t id, std::uint32_t step)
        : counter_{0, static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(id >> 32), step},
          key_{seed, static_cast<std::uint32_t>(purpose)}
    {
    }

    //! Uniform in the open interval (0, 1), 53 bits.
    double uniform()
    {
        if (left_ == 0) {
            block_ = philox(counter_, key_);
            ++counter_[0];
            left_ = 2;
        }
        --left_;
        std::uint64_t const bits = (std::uint64_t{block_[2 * left_]} << 32) | block_[2 * left_ + 1];
        return (static_cast<double>(bits >> 11) + 0.5) * 0x1.0p-53;
    }

    //! Standard normal by Box and Muller; two draws each, none kept.
    double normal()
    {
        double const radius = std::sqrt(-2 * std::log(uniform()));
        return radius * std::cos(2 * 3.14159265358979323846 * uniform());
    }

    //! Poisson's distribution: products of uniform numbers, in pieces that exp(-mean) does not make too small.
    long poisson(double mean)
    {
        long number = 0;
        for (; mean > 0; mean -= most) {
            double const least = std::exp(-std::min(mean, most));
            for (double product = uniform(); product > least; product *= uniform()) ++number;
        }
        return number;
    }

  private:
    static constexpr double most = 32;
    std::array<std::uint32_t, 4> counter_, block_{};
    std::array<std::uint32_t, 2> key_;
    int left_ = 0;
};
}
