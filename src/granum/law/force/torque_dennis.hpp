// Torque of the gas that brings a granule to the spin of the gas.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/force/motion.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::force
{
//! pi mu d^3 W C, W = curl u / 2 - spin, C = max(1, 0.6386 (1 + 0.1005 sqrt(Re_W))), Re_W = rho d^2 |W| / mu, in N m.
//! In the usual coefficient 64 pi / Re_W below Re_W = 32, 12.9 / sqrt(Re_W) + 128.4 / Re_W above; the two meet there.
struct Dennis
{
    static constexpr base::Card card{
        .name = "dennis",
        .title = "Creeping flow, and Dennis, Singh and Ingham above it",
        .source =
            "Dennis, Singh, Ingham, J. Fluid Mech. 101 (1980) 257 (formula compared with a public code; paper "
            "and range recalled)",
        .valid = "one sphere, Reynolds number of the spin up to 4000"};

    math::Vec3 operator()(Motion const& motion) const
    {
        math::Vec3 const lag = motion.spin_lag();
        double const d = motion.diameter, re = motion.turning_reynolds(math::norm(lag));
        double const factor = std::max(1.0, 0.6386 * (1 + 0.1005 * std::sqrt(re)));
        return math::pi * motion.viscosity * d * d * d * factor * lag;
    }
};
}
