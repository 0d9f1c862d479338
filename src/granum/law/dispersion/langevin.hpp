// Turbulence as a velocity that forgets itself steadily (Langevin), with the drift that keeps mixed what is mixed.
//
// It is written for the fluctuation over its standard deviation, w = u' / sigma. The drift of u' for well-mixed
// Gaussian turbulence, grad(sigma^2)/2 + u' (u' . grad(sigma^2)) / (2 sigma^2), is then grad(sigma) alone: the rest is
// the change of sigma along the way. It holds for steady turbulence whose mean flow has no divergence.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/dispersion/turbulence.hpp"

namespace granum::law::dispersion
{
//! dw = -w dt / T + grad(sigma) dt + sqrt(2 / T) dW with T = C k / epsilon, exact over a step in which the turbulence
//! stays the same. Long after its birth a droplet that follows the gas is spread by 2 sigma^2 T t.
struct Langevin
{
    static constexpr base::Card card{
        .name = "langevin",
        .title = "Langevin, with drift",
        .source = "Thomson, J. Fluid Mech. 180 (1987) 529 (recalled; the drift derived anew)",
        .valid = "droplets that follow the gas; no allowance for those that fall through eddies"};

    double time_ratio = 0.3;  //!< C, 0.2 to 0.32 (recalled)

    //! T, s.
    double integral_time(Turbulence const& gas) const { return time_ratio * gas.turnover(); }

    //! u' of the gas that the droplet sees at the end of `step` s, m/s, with three independent standard normal numbers.
    math::Vec3 operator()(Eddy& eddy, Turbulence const& gas, double step, math::Vec3 const& normals) const
    {
        double const time = integral_time(gas);
        if (time > 0 && std::isfinite(time)) {
            double const forgotten = -std::expm1(-step / time), kept = 1 - forgotten;
            eddy.fluctuation = kept * eddy.fluctuation + std::sqrt(forgotten * (1 + kept)) * normals +
                               time * forgotten * gas.deviation_gradient();
        }
        return gas.deviation() * eddy.fluctuation;
    }
};
}
