// Lift on a granule that spins in the gas: it is pushed to the side on which its surface moves with the gas that
// passes.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/force/motion.hpp"
#include "granum/math/constants.hpp"

namespace granum::law::force
{
//! (pi/8) rho d^3 W x (u - v), W = curl u / 2 - spin, in N.
struct RubinowKeller
{
    static constexpr base::Card card{
        .name = "rubinow-keller",
        .title = "Rubinow and Keller",
        .source =
            "Rubinow, Keller, J. Fluid Mech. 11 (1961) 447 (formula compared with a public code; paper and "
            "range recalled)",
        .valid = "one sphere, Reynolds numbers of slip and spin far below 1; far too large above"};

    math::Vec3 operator()(Motion const& motion) const
    {
        double const d = motion.diameter;
        return math::pi / 8 * motion.density * d * d * d * math::cross(motion.spin_lag(), motion.slip);
    }
};
}
