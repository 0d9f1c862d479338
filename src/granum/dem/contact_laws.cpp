#include "granum/dem/contact_laws.hpp"

#include <algorithm>

namespace granum::dem
{
std::uint32_t Laws::add(Material const& material)
{
    materials.push_back(material);
    pairs_.emplace_back(materials.size());
    return static_cast<std::uint32_t>(materials.size() - 1);
}

void Laws::pair(std::uint32_t a, std::uint32_t b, PairProperties const& properties)
{
    pairs_.at(std::max(a, b)).at(std::min(a, b)) = properties;
}

PairProperties const& Laws::pair(std::uint32_t a, std::uint32_t b) const
{
    return pairs_.at(std::max(a, b)).at(std::min(a, b));
}

law::contact::Pair<double> Laws::effective(std::uint32_t a, std::uint32_t b) const
{
    double compliance = 0, shear_compliance = 0;
    for (std::uint32_t const m : {a, b}) {
        auto const& [youngs, poisson, rigid] = materials.at(m);
        if (rigid) continue;
        compliance += (1 - poisson * poisson) / youngs;
        shear_compliance += 2 * (2 - poisson) * (1 + poisson) / youngs;
    }
    auto const& properties = pair(a, b);
    double const damping = std::visit([&](auto const& law) { return law.damping(properties.restitution); }, normal);
    return {.youngs_modulus = compliance > 0 ? 1 / compliance : 0,  // two rigid materials never touch
            .shear_modulus = shear_compliance > 0 ? 1 / shear_compliance : 0,
            .damping = damping,
            .tangential_damping = damping,
            .sliding_friction = properties.sliding_friction,
            .rolling_friction = properties.rolling_friction};
}
}
