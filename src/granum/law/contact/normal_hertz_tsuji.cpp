#include "granum/law/contact/normal_hertz_tsuji.hpp"

#include "granum/math/constants.hpp"

#include <array>
#include <cstddef>

namespace granum::law::contact
{
namespace
{
// Restitution and the damping that gives it when the pull at the end of the contact is cut, found by integrating the
// motion of a head-on impact.
constexpr std::array<double, 12> restitutions{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.97, 1.0};
constexpr std::array<double, 12> dampings{1.13487, 0.66753, 0.45392, 0.32362, 0.23303, 0.16510,
                                          0.11157, 0.06788, 0.03128, 0.01506, 0.00891, 0.0};
constexpr std::size_t size = restitutions.size();

// What is interpolated is h = g e / (1 - e): it is nearly straight, and known at e = 1, where both variants agree.
struct Table
{
    std::array<double, size> h{}, slope{};

    Table()
    {
        for (std::size_t i = 0; i + 1 < size; ++i) h[i] = dampings[i] * restitutions[i] / (1 - restitutions[i]);
        h[size - 1] = std::sqrt(5.0 / 6.0) / math::pi;
        // Monotone slopes: weighted harmonic mean of the neighbouring secants (Fritsch and Butland 1984).
        auto const secant = [this](std::size_t i) {
            return (h[i + 1] - h[i]) / (restitutions[i + 1] - restitutions[i]);
        };
        slope[0] = std::max(0.0, 1.5 * secant(0) - 0.5 * secant(1));
        slope[size - 1] = secant(size - 2);
        for (std::size_t i = 1; i + 1 < size; ++i) {
            double const before = restitutions[i] - restitutions[i - 1], after = restitutions[i + 1] - restitutions[i];
            double const w0 = 2 * after + before, w1 = after + 2 * before;
            slope[i] = secant(i - 1) * secant(i) > 0 ? (w0 + w1) / (w0 / secant(i - 1) + w1 / secant(i)) : 0;
        }
    }

    double operator()(double e) const
    {
        if (e < restitutions[0]) return h[0] * std::pow(e / restitutions[0], slope[0] * restitutions[0] / h[0]);
        std::size_t i = 0;
        while (i + 2 < size && e > restitutions[i + 1]) ++i;
        double const width = restitutions[i + 1] - restitutions[i], t = (e - restitutions[i]) / width;
        return (1 + 2 * t) * (1 - t) * (1 - t) * h[i] + t * (1 - t) * (1 - t) * width * slope[i] +
               t * t * (3 - 2 * t) * h[i + 1] + t * t * (t - 1) * width * slope[i + 1];
    }
};
}

double HertzTsuji::damping(double restitution) const
{
    double const e = std::clamp(restitution, 1e-3, 1.0);
    if (e == 1) return 0;
    if (attraction == Attraction::keep) {
        double const log = std::log(e);
        return -std::sqrt(5.0 / 6.0) * log / std::sqrt(log * log + math::pi * math::pi);
    }
    static Table const table;
    return table(e) * (1 - e) / e;
}
}
