// Bandwidth of memory as one core sees it: a[i] = b[i] + s c[i] over arrays far larger than any cache, counted at the
// 24 bytes an element that the program asks for. The roofline of bench/peers is made with it. Source: McCalpin, STREAM
// (the triad). Prints the median and the extremes of the repetitions in GB/s.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

int main()
{
    constexpr std::size_t elements = std::size_t{32} << 20;
    constexpr int repetitions = 15;
    std::vector<double> a(elements, 0.0), b(elements, 1.5), c(elements, 2.5);
    std::vector<double> rates;
    for (int k = 0; k < repetitions; ++k) {
        double const s = 3.0 + k;
        auto const start = std::chrono::steady_clock::now();
        for (std::size_t i = 0; i < elements; ++i) a[i] = b[i] + s * c[i];
        std::chrono::duration<double> const taken = std::chrono::steady_clock::now() - start;
        rates.push_back(24e-9 * static_cast<double>(elements) / taken.count());
        b[static_cast<std::size_t>(k)] = a[elements / 2];  // the result is used, so the loop is not dropped
    }
    std::sort(rates.begin(), rates.end());
    std::printf("triad=%.3f lowest=%.3f highest=%.3f\n", rates[repetitions / 2], rates.front(), rates.back());
}
