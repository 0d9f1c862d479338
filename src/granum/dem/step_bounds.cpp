#include "granum/dem/step_bounds.hpp"

#include "granum/math/constants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace granum::dem
{
namespace
{
double mass(Grains const& grains)
{
    return 4.0 / 3.0 * math::pi * std::pow(grains.radius, 3) * grains.density;
}
double inertia(Grains const& grains)
{
    return 0.4 * mass(grains) * grains.radius * grains.radius;
}

// What meets in a contact: the pair of materials and R*, m*, I_i I_j / (I_i + I_j).
struct Meeting
{
    law::contact::Pair<double> pair;
    double radius, mass, inertia;
    std::string partner;
};

StepBound of_rayleigh_wave(Material const& material, Grains const& grains)
{
    double const shear = material.youngs_modulus / (2 * (1 + material.poisson_ratio));
    double const wave =
        math::pi * grains.radius * std::sqrt(grains.density / shear) / (0.1631 * material.poisson_ratio + 0.8766);
    return {0.2 * wave,
            fmt::format("0.2 of the Rayleigh time {:.3g} s of a granule of {:.3g} m", wave, 2 * grains.radius)};
}

void of_meeting(Laws const& laws, Meeting const& at, double speed, std::vector<StepBound>& out)
{
    bool const linear = std::holds_alternative<law::contact::Linear>(laws.normal);
    double duration = 0, tangential = 0;
    if (linear) {
        duration = math::pi * std::sqrt(at.mass / at.pair.stiffness);
        tangential = at.pair.tangential.value * at.pair.stiffness;
        out.push_back({duration / 20, fmt::format("1/20 of the contact time {:.3g} s with {}", duration, at.partner)});
    } else {
        double const overlap =
            std::pow(15 * at.mass * speed * speed / (16 * at.pair.youngs_modulus * std::sqrt(at.radius)), 0.4);
        duration = 2.943275 * overlap / speed;
        tangential = 2 * at.pair.tangential.value * at.pair.youngs_modulus * std::sqrt(at.radius * overlap);
        out.push_back({duration / 20, fmt::format("1/20 of the contact time {:.3g} s with {} at {:.3g} m/s", duration,
                                                  at.partner, speed)});
    }
    bool const rolls = !std::holds_alternative<law::contact::NoRolling>(laws.rolling);
    if (rolls && at.pair.rolling_friction > 0 && tangential > 0)
        out.push_back({0.2 * std::sqrt(at.inertia / (tangential * at.radius * at.radius)),
                       fmt::format("0.2 of the time sqrt(I / k_r) of the rolling spring with {}", at.partner)});
}
}

std::vector<StepBound> step_bounds(Laws const& laws, std::span<Grains const> kinds, double speed)
{
    std::vector<StepBound> out;
    bool const linear = std::holds_alternative<law::contact::Linear>(laws.normal);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        auto const& grains = kinds[i];
        if (!linear) out.push_back(of_rayleigh_wave(laws.materials.at(grains.material), grains));
        for (std::size_t j = i; j < kinds.size(); ++j) {
            auto const& other = kinds[j];
            // Of two like granules R* is half the radius; of two unlike ones it is at most that of the smaller.
            double const radius = i == j ? grains.radius / 2 : std::min(grains.radius, other.radius);
            of_meeting(laws,
                       {laws.effective(grains.material, other.material), radius,
                        mass(grains) * mass(other) / (mass(grains) + mass(other)),
                        inertia(grains) * inertia(other) / (inertia(grains) + inertia(other)), "another granule"},
                       speed, out);
        }
        for (std::uint32_t wall = 0; wall < laws.materials.size(); ++wall)
            if (laws.is_wall(wall))
                of_meeting(
                    laws,
                    {laws.effective(grains.material, wall), grains.radius, mass(grains), inertia(grains), "the wall"},
                    speed, out);
    }
    return out;
}

std::vector<StepBound> step_bounds(Settings const& settings, double radius, double density, double speed)
{
    Grains const one{0, radius, density};
    return step_bounds(settings.laws, std::span(&one, 1), speed);
}
}
