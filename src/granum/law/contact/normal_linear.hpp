// Normal force of a linear spring and dashpot.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/dashpot.hpp"

namespace granum::law::contact
{
//! F = k_n overlap - c speed, c = 2 g sqrt(k_n m*); k_t is a share of k_n. Stiffnesses are those of the pair of
//! materials.
struct Linear
{
    static constexpr base::Card card{
        .name = "linear",
        .title = "Linear spring and dashpot",
        .source = "Cundall and Strack, Geotechnique 29 (1979) 47 (recalled, unverified)",
        .valid =
            "stiffness chosen for a small overlap, not a property of the material; restitution from 0.001 to 1, "
            "whatever the speed"};
    Attraction attraction = Attraction::cut;

    //! The g that gives `restitution` (clamped to [1e-3, 1]), dimensionless.
    double damping(double restitution) const { return damping_ratio(restitution, attraction); }

    template <class Real>
    NormalForce<Real> operator()(Pair<Real> const& pair, Approach<Real> const& at) const
    {
        Real const elastic = pair.stiffness * at.overlap;
        Slope<Real> const slope{pair.stiffness, reciprocal(max(pair.stiffness, Real(tiny))),
                                sqrt(pair.stiffness * at.mass)};
        Real const force = spring_and_dashpot(at, elastic, Real(2) * pair.damping * slope.impedance, 1, attraction);
        return normal_force(pair, force, elastic, Real(0.5) * elastic * at.overlap, slope);
    }
};
}
