#include "granum/law/contact/normal_viscoelastic.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::contact
{
namespace
{
// Speed after x'' = -x^(3/2) - (3/2) a sqrt(x) x' from x = 0 with speed 1, until the force or the overlap vanishes.
double speed_after(double a, Attraction attraction)
{
    struct State
    {
        double x, v;
    };
    auto const rate = [a](State const& s) {
        double const root = std::sqrt(std::max(s.x, 0.0));
        return State{s.v, -root * (s.x + 1.5 * a * s.v)};
    };
    auto const moved = [](State const& s, State const& by, double h) { return State{s.x + h * by.x, s.v + h * by.v}; };
    auto const left = [&](State const& s) { return attraction == Attraction::cut ? s.x + 1.5 * a * s.v : s.x; };
    constexpr double h = 1e-2;  // the elastic contact lasts 3.218
    State now{0, 1};
    for (int k = 0; k < 4000; ++k) {
        auto const k1 = rate(now), k2 = rate(moved(now, k1, 0.5 * h)), k3 = rate(moved(now, k2, 0.5 * h)),
                   k4 = rate(moved(now, k3, h));
        State const next{now.x + h / 6 * (k1.x + 2 * k2.x + 2 * k3.x + k4.x),
                         now.v + h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v)};
        if (next.v < 0 && left(next) <= 0) {
            double const share = left(now) / (left(now) - left(next));
            return -(now.v + share * (next.v - now.v));
        }
        now = next;
    }
    return 0;
}
}

double HertzViscoelastic::dissipation_time(double restitution, double modulus, double radius, double mass,
                                           double speed) const
{
    double const wanted = std::clamp(restitution, 1e-2, 1.0);
    if (wanted == 1) return 0;
    double low = 0, high = 20;
    for (int k = 0; k < 50; ++k) {
        double const middle = 0.5 * (low + high);
        (speed_after(middle, attraction) > wanted ? low : high) = middle;
    }
    double const stiffness = 4.0 / 3.0 * modulus * std::sqrt(radius);
    return 0.5 * (low + high) * std::pow(mass / stiffness, 0.4) * std::pow(speed, -0.2);
}
}
