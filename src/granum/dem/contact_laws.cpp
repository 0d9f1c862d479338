#include "granum/dem/contact_laws.hpp"

#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

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

bool Laws::is_wall(std::uint32_t material) const
{
    return materials.at(material).wall || materials.at(material).rigid;
}

law::contact::Pair<double> Laws::effective(std::uint32_t a, std::uint32_t b) const
{
    double compliance = 0, shear_compliance = 0;
    for (std::uint32_t const m : {a, b}) {
        auto const& material = materials.at(m);
        if (material.rigid) continue;
        double const poisson = material.poisson_ratio;
        compliance += (1 - poisson * poisson) / material.youngs_modulus;
        shear_compliance += 2 * (2 - poisson) * (1 + poisson) / material.youngs_modulus;
    }
    auto const& properties = pair(a, b);
    double const damping = std::visit([&](auto const& law) { return law.damping(properties.restitution); }, normal);
    law::contact::Pair<double> out{
        .youngs_modulus = compliance > 0 ? 1 / compliance : 0,  // rigid ones never touch
        .tangential = law::contact::Ratio(shear_compliance > 0 ? 4 * compliance / shear_compliance : 0),
        .damping = damping,
        .tangential_damping = damping,
        .sliding_friction = properties.sliding_friction,
        .rolling_friction = properties.rolling_friction,
        .rolling_damping = properties.rolling_damping,
        .stiffness = properties.stiffness};
    if (std::holds_alternative<law::contact::Linear>(normal))
        out.tangential = law::contact::Ratio(properties.tangential_ratio);
    if (auto const* law = std::get_if<law::contact::HertzViscoelastic>(&normal); law && compliance > 0) {
        double const share = is_wall(a) || is_wall(b) ? 1 : 0.5;
        double const mass = 4.0 / 3.0 * math::pi * std::pow(reference.radius, 3) * reference.density;
        out.dissipation_time = law->dissipation_time(properties.restitution, out.youngs_modulus,
                                                     share * reference.radius, share * mass, reference.speed);
    }
    return out;
}
}
