#include "granum/law/contact/damping_ratio.hpp"

#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::contact
{
namespace
{
// Duration, times sqrt(k/m), of a contact whose pull is cut.
double cut_phase(double zeta)
{
    if (zeta < 1) {
        double const phi = std::acos(zeta);
        return 2 * phi / std::sin(phi);
    }
    if (zeta == 1) return 2;
    double const u = std::acosh(zeta);
    return 2 * u / std::sinh(u);
}
}

double damping_ratio(double restitution, Attraction attraction)
{
    double const e = std::clamp(restitution, 1e-3, 1.0);
    double const wanted = -std::log(e);
    if (attraction == Attraction::keep) return wanted / std::sqrt(wanted * wanted + math::pi * math::pi);
    if (e == 1) return 0;
    double low = 0, high = 100;
    for (int k = 0; k < 100; ++k) {
        double const middle = 0.5 * (low + high);
        (middle * cut_phase(middle) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double contact_phase(double damping_ratio, Attraction attraction)
{
    if (attraction == Attraction::keep) return math::pi / std::sqrt(1 - damping_ratio * damping_ratio);
    return cut_phase(damping_ratio);
}
}
