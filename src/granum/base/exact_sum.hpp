// A sum of numbers without rounding, so that it depends neither on their order nor on how ranks share them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace granum::base
{
//! Sum of up to 2^31 numbers below 2^63 in size, exact to the last 2^-128 of each, of one rank or of several.
struct ExactSum
{
    static constexpr std::size_t size = 6;
    std::array<std::int64_t, size> limbs{};  //!< in multiples of `worth`

    void add(double x)
    {
        for (std::size_t k = size; k-- > 0;) {
            double const part = std::trunc(x * (1 / worth[k]));
            limbs[k] += static_cast<std::int64_t>(part);
            x -= part * worth[k];
        }
    }

    void add(ExactSum const& other)
    {
        for (std::size_t k = 0; k < size; ++k) limbs[k] += other.limbs[k];
    }

    void subtract(ExactSum const& other)
    {
        for (std::size_t k = 0; k < size; ++k) limbs[k] -= other.limbs[k];
    }

    //! The same bits for the same sum, however it was split into the numbers that were added.
    double value() const
    {
        auto digits = carried(1);
        bool const negative = digits.back() < 0;
        if (negative) digits = carried(-1);  // of one sign, so that nothing cancels
        double sum = 0;
        for (std::size_t k = 0; k < size; ++k) sum += static_cast<double>(digits[k]) * worth[k];
        return negative ? -sum : sum;
    }

  private:
    // The limbs times a sign, all but the last from 0 to below 2^32.
    std::array<std::int64_t, size> carried(std::int64_t sign) const
    {
        std::array<std::int64_t, size> out{};
        std::int64_t carry = 0;
        for (std::size_t k = 0; k < size; ++k) {
            std::int64_t const here = sign * limbs[k] + carry;
            carry = k + 1 < size ? here >> 32 : 0;
            out[k] = here - (carry << 32);
        }
        return out;
    }

    static constexpr std::array<double, size> worth{0x1p-128, 0x1p-96, 0x1p-64, 0x1p-32, 1.0, 0x1p32};
};
}
