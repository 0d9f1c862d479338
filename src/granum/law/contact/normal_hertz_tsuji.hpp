// Normal force of elastic spheres with viscous damping: Hertz's spring and Tsuji's dashpot.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/dashpot.hpp"
#include "granum/law/contact/hertz.hpp"

#include <cmath>

namespace granum::law::contact
{
//! F = 4/3 E* a overlap - c speed, c = 2 g sqrt(S m*), S = 2 E* a, a = sqrt(R* overlap); k_t = 8 G* a.
struct HertzTsuji
{
    static constexpr base::Card card{
        .name = "hertz-tsuji",
        .title = "Hertz spring with Tsuji damping",
        .source = "Tsuji, Tanaka and Ishida, Powder Technol. 71 (1992) 239 (recalled, unverified)",
        .valid = "elastic spheres, overlap small against the radius; restitution from 0.001 to 1, whatever the speed"};
    Attraction attraction = Attraction::cut;

    //! The g that gives `restitution` (clamped to [1e-3, 1]), dimensionless.
    double damping(double restitution) const { return std::sqrt(5.0 / 6.0) * damping_ratio(restitution, attraction); }

    template <class Real>
    NormalForce<Real> operator()(Pair<Real> const& pair, Approach<Real> const& at) const
    {
        auto const slope = hertz_slope(pair, at, at.overlap);
        Real const elastic = Real(2.0 / 3.0) * slope.stiffness * at.overlap;
        Real damped = slope.impedance;
        if (any(just_touched(at))) damped = hertz_slope(pair, at, damped_overlap(at)).impedance;
        Real const force = spring_and_dashpot(at, elastic, Real(2) * pair.damping * damped, 1.25, attraction);
        return normal_force(pair, force, elastic, Real(0.4) * elastic * at.overlap, slope);
    }
};
}
