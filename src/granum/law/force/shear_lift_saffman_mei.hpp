// Lift in a gas that shears: a granule that lags behind the gas is pushed to where the gas is faster.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/force/motion.hpp"

#include <cmath>

namespace granum::law::force
{
//! 1.615 d^2 sqrt(rho mu / |w|) (u - v) x w f, w = curl u, in N, with Mei's f:
//!   f = exp(-Re/10) + 0.3314 sqrt(a) (1 - exp(-Re/10)) up to Re = 40, 0.0524 sqrt(a Re) above, a = |w| d / (2 |u -
//!   v|).
//! Nothing where the gas does not shear or does not slip. At Re = 40 f steps by exp(-4) (1 - 0.3314 sqrt(a)) at most.
struct SaffmanMei
{
    static constexpr base::Card card{
        .name = "saffman-mei",
        .title = "Saffman, with the factor of Mei",
        .source =
            "Saffman, J. Fluid Mech. 22 (1965) 385; Mei, Int. J. Multiphase Flow 18 (1992) 145 (formula compared with "
            "two public codes; papers and range recalled)",
        .valid = "one sphere far from walls, Reynolds number of the slip up to 100, 0.005 < a < 0.4"};

    math::Vec3 operator()(Motion const& motion) const
    {
        double const shear = math::norm(motion.vorticity), speed = math::norm(motion.slip);
        if (shear == 0 || speed == 0) return {};
        double const d = motion.diameter, re = motion.reynolds();
        double const a = 0.5 * shear * d / speed;
        double const f =
            re <= 40 ? std::exp(-0.1 * re) - 0.3314 * std::sqrt(a) * std::expm1(-0.1 * re) : 0.0524 * std::sqrt(a * re);
        double const scale = 1.615 * d * d * std::sqrt(motion.density * motion.viscosity / shear) * f;
        return scale * math::cross(motion.slip, motion.vorticity);
    }
};
}
