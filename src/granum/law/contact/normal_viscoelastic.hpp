// Normal force of viscoelastic spheres, whose restitution falls with the speed of the impact.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/dashpot.hpp"
#include "granum/law/contact/hertz.hpp"

#include <cmath>

namespace granum::law::contact
{
//! F = 4/3 E* a overlap - A S speed, S = dF/d(overlap) = 2 E* a, a = sqrt(R* overlap), with a time A of the materials.
//!
//! 1 - e grows with the speed to the power of 1/5: fast impacts lose more.
struct HertzViscoelastic
{
    static constexpr base::Card card{
        .name = "hertz-viscoelastic",
        .title = "Hertz spring with viscoelastic dissipation: restitution falls with speed",
        .source =
            "Kuwabara and Kono, Jpn. J. Appl. Phys. 26 (1987) 1230; Brilliantov, Spahn, Hertzsch and Poeschel, "
            "Phys. Rev. E 53 (1996) 5382 (recalled, unverified)",
        .valid = "no plastic deformation; restitution above about 0.3 at the fastest impact"};
    Attraction attraction = Attraction::cut;

    //! The g_t of the tangential dashpot: that of `hertz-tsuji` for the same restitution, dimensionless.
    double damping(double restitution) const { return std::sqrt(5.0 / 6.0) * damping_ratio(restitution, attraction); }

    //! The A (s) with which a head-on impact at `speed` (m/s) gives `restitution` (clamped to [1e-2, 1]) to partners of
    //! E* `modulus` (Pa), R* `radius` (m) and m* `mass` (kg).
    double dissipation_time(double restitution, double modulus, double radius, double mass, double speed) const;

    template <class Real>
    NormalForce<Real> operator()(Pair<Real> const& pair, Approach<Real> const& at) const
    {
        auto const slope = hertz_slope(pair, at, at.overlap);
        Real const elastic = Real(2.0 / 3.0) * slope.stiffness * at.overlap;
        Real damped = slope.stiffness;
        if (any(just_touched(at))) damped = hertz_slope(pair, at, damped_overlap(at)).stiffness;
        Real const force = spring_and_dashpot(at, elastic, pair.dissipation_time * damped, 1.5, attraction);
        return normal_force(pair, force, elastic, Real(0.4) * elastic * at.overlap, slope);
    }
};
}
