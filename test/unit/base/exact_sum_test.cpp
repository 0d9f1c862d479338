// Exact sums: nothing is rounded away, in whatever order and on however many ranks the numbers are added.
#include "granum/base/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using granum::base::ExactSum;

namespace
{
ExactSum sum_of(std::vector<double> const& numbers)
{
    ExactSum sum;
    for (double const x : numbers) sum.add(x);
    return sum;
}
}

TEST(ExactSum, keeps_what_doubles_would_lose)
{
    EXPECT_EQ(sum_of({1e15, 1e-15, -1e15}).value(), 1e-15);
    EXPECT_EQ(sum_of({0.1, 0.2, -0.1, -0.2}).value(), 0);
    EXPECT_EQ(sum_of({-0x1p62, 3.0}).value(), -0x1p62 + 3.0);
    EXPECT_EQ(sum_of({}).value(), 0);
    EXPECT_EQ(sum_of({-1.7e-9}).value(), -1.7e-9);
}

TEST(ExactSum, does_not_depend_on_order_or_on_who_adds)
{
    std::mt19937_64 random(5);
    std::vector<double> numbers;
    for (int k = 0; k < 5000; ++k)
        numbers.push_back(std::ldexp(static_cast<double>(random()) - 0x1p63, static_cast<int>(random() % 80) - 100));
    auto const whole = sum_of(numbers);
    std::shuffle(numbers.begin(), numbers.end(), random);
    EXPECT_EQ(sum_of(numbers).limbs, whole.limbs);
    auto const half = numbers.begin() + 2000;
    auto const one = sum_of({numbers.begin(), half}), other = sum_of({half, numbers.end()});
    for (std::size_t k = 0; k < ExactSum::size; ++k) EXPECT_EQ(one.limbs[k] + other.limbs[k], whole.limbs[k]);
}

TEST(ExactSum, has_the_same_bits_whoever_adds_which_part)
{
    // Multiples of a power of two, so that plain sums of a few of them are exact and can stand in for their parts.
    std::mt19937_64 random(6);
    for (int round = 0; round < 500; ++round) {
        ExactSum each, grouped, other;
        double group = 0;
        for (int n = 0; n < 40; ++n) {
            double const x = std::ldexp(static_cast<double>(random() >> 24) - 0.45 * 0x1p40, -60);
            double const whole = std::ldexp(std::floor(std::ldexp(x, 60)), -60);
            each.add(whole);
            group += whole;
            if (n % 7 == 6) (n % 2 == 0 ? grouped : other).add(group), group = 0;
        }
        grouped.add(group);
        grouped.add(other);
        EXPECT_EQ(each.value(), grouped.value());
        grouped.subtract(each);
        EXPECT_EQ(grouped.value(), 0);
    }
}
