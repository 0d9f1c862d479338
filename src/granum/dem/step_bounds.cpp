// Bounds on the granule step from the granules' elasticity.
#include "granum/dem/engine.hpp"
#include "granum/math/constants.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace granum::dem
{
std::vector<StepBound> step_bounds(Settings const& settings, double radius, double density, double speed)
{
    std::vector<StepBound> out;
    auto const& laws = settings.laws;
    auto const& material = laws.materials.at(0);
    double const mass = 4.0 / 3.0 * math::pi * radius * radius * radius * density;
    double const shear = material.youngs_modulus / (2 * (1 + material.poisson_ratio));
    double const wave = math::pi * radius * std::sqrt(density / shear) / (0.1631 * material.poisson_ratio + 0.8766);
    out.push_back(
        {0.2 * wave, fmt::format("0.2 of the Rayleigh time {:.3g} s of a granule of {:.3g} m", wave, 2 * radius)});
    for (std::uint32_t partner = 0; partner < laws.materials.size(); ++partner) {
        bool const granule = partner == 0;
        auto const pair = laws.effective(0, partner);
        double const radius_star = granule ? radius / 2 : radius, mass_star = granule ? mass / 2 : mass;
        double const overlap =
            std::pow(15 * mass_star * speed * speed / (16 * pair.youngs_modulus * std::sqrt(radius_star)), 0.4);
        double const duration = 2.943275 * overlap / speed;
        auto const with = granule ? std::string("another granule") : std::string("the wall");
        out.push_back({duration / 20,
                       fmt::format("1/20 of the contact time {:.3g} s with {} at {:.3g} m/s", duration, with, speed)});
        if (pair.rolling_friction > 0 && std::holds_alternative<law::contact::Epsd>(laws.rolling)) {
            double const stiffness =
                8 * pair.shear_modulus * std::sqrt(radius_star * overlap) * radius_star * radius_star;
            double const inertia = 0.4 * mass * radius * radius * (granule ? 0.5 : 1);
            out.push_back({0.2 * std::sqrt(inertia / stiffness),
                           fmt::format("0.2 of the time sqrt(I / k_r) of the rolling spring with {}", with)});
        }
    }
    return out;
}
}
