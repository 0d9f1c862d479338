// Lift on a granule that spins, at Reynolds numbers of a bed or a jet.
#pragma once

#include "granum/law/force/spin_lift_rubinow_keller.hpp"

#include <cmath>

namespace granum::law::force
{
//! Rubinow and Keller's lift times
//!   1 - [0.675 + 0.15 (1 + tanh(0.28 (W* - 2)))] tanh(0.18 sqrt(Re)),   W* = |W| d / |u - v|.
struct LothDorgan
{
    static constexpr base::Card card{
        .name = "loth-dorgan",
        .title = "Rubinow and Keller, with the factor of Loth and Dorgan",
        .source =
            "Loth, Dorgan, Environ. Fluid Mech. 9 (2009) 187 (formula compared with two public codes; paper "
            "recalled)",
        .valid = "one sphere, Reynolds number of the slip up to 2000, W* up to 20"};

    math::Vec3 operator()(Motion const& motion) const
    {
        double const speed = math::norm(motion.slip);
        if (speed == 0) return {};
        double const spin = math::norm(motion.spin_lag()) * motion.diameter / speed;
        double const lost = 0.675 + 0.15 * (1 + std::tanh(0.28 * (spin - 2)));
        return (1 - lost * std::tanh(0.18 * std::sqrt(motion.reynolds()))) * RubinowKeller{}(motion);
    }
};
}
