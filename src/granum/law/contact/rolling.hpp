// Rolling resistance of a contact: a torque that grows with the relative rotation up to a limit, or none.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/dashpot.hpp"

namespace granum::law::contact
{
//! M <- M - k_r omega dt in the plane of the contact, |M| <= mu_r R* F_n, k_r = k_t R*^2; no viscous part.
struct Epsd
{
    static constexpr base::Card card{
        .name = "epsd",
        .title = "Elastic-plastic spring without dashpot",
        .source = "Ai, Chen, Rotter and Ooi, Powder Technol. 206 (2011) 269 (recalled, unverified)",
        .valid = "time step below 0.2 sqrt(I / k_r); a granule at rest rocks a little"};
    static constexpr int history = 3;

    //! Moves the torque in `spring` (x, y, z; N m, on the first partner) on by the relative spin (rad/s, first against
    //! second) times the step, and answers with it.
    template <class Real>
    RollingTorque<Real> operator()(Pair<Real> const& pair, Approach<Real> const& at, NormalForce<Real> const& normal,
                                   Triple<Real> const& n, Triple<Real> const& relative_spin, Real* spring) const
    {
        Real const limit = pair.rolling_friction * at.radius * max(normal.force, Real(0));
        Real const stiffness = normal.tangential_stiffness * at.radius * at.radius;
        Triple<Real> const rolling = neg_mul_add(dot(relative_spin, n), n, relative_spin);
        Triple<Real> const before = turned_into_plane(Triple<Real>{spring[0], spring[1], spring[2]}, n);
        Triple<Real> const trial = neg_mul_add(stiffness * at.step, rolling, before);
        Real const size2 = norm2(trial);
        Triple<Real> const torque = shortening(size2 <= limit * limit, limit, size2) * trial;
        spring[0] = torque.x, spring[1] = torque.y, spring[2] = torque.z;
        return {torque, Real(0.5) * norm2(torque) * reciprocal(max(stiffness, Real(tiny))),
                Real(-0.5) * at.step * dot(before + torque, rolling)};
    }
};

//! Epsd with a dashpot M_d = -C_r omega, C_r = 2 eta_r sqrt(I_r k_r), as long as the spring is below its limit.
//!
//! The torque may exceed the limit by the dashpot's share. A granule at rest stops rocking. I_r is the inertia of both
//! partners about the contact point, I_i I_j / (I_i + I_j) with 1.4 m R^2 each.
struct EpsdDashpot
{
    static constexpr base::Card card{
        .name = "epsd-dashpot",
        .title = "Elastic-plastic spring with dashpot",
        .source = "Ai, Chen, Rotter and Ooi, Powder Technol. 206 (2011) 269 (recalled, unverified); the spring of epsd",
        .valid = "time step below 0.2 sqrt(I / k_r)"};
    static constexpr int history = 3;

    //! As Epsd; what is kept is the torque of the spring alone.
    template <class Real>
    RollingTorque<Real> operator()(Pair<Real> const& pair, Approach<Real> const& at, NormalForce<Real> const& normal,
                                   Triple<Real> const& n, Triple<Real> const& relative_spin, Real* spring) const
    {
        auto const elastic = Epsd{}(pair, at, normal, n, relative_spin, spring);
        Real const limit = pair.rolling_friction * at.radius * max(normal.force, Real(0));
        Real const stiffness = normal.tangential_stiffness * at.radius * at.radius;
        // At the limit rounding leaves the length just off it: a spring within 1e-9 of it counts as there.
        auto const below = norm2(elastic.torque) < Real(1 - 2e-9) * limit * limit;
        Real const coefficient = lagged(Real(2) * pair.rolling_damping * sqrt(at.inertia * stiffness),
                                        Real(0.5) * at.step * reciprocal(at.inertia));
        Triple<Real> const rolling = neg_mul_add(dot(relative_spin, n), n, relative_spin);
        Triple<Real> const torque = mul_add(select(below, -coefficient, Real(0)), rolling, elastic.torque);
        // The spin at the end of the step, half a step of this torque later.
        Real const later = Real(0.5) * at.step * reciprocal(at.inertia);
        Real const viscous =
            select(below, at.step * coefficient * mul_add(later, dot(rolling, torque), norm2(rolling)), Real(0));
        return {torque, elastic.energy, elastic.work + viscous};
    }
};

//! No resistance to rolling.
struct NoRolling
{
    static constexpr base::Card card{.name = "none", .title = "No rolling resistance", .source = "", .valid = "always"};
    static constexpr int history = 0;

    template <class Real>
    RollingTorque<Real> operator()(Pair<Real> const&, Approach<Real> const&, NormalForce<Real> const&,
                                   Triple<Real> const&, Triple<Real> const&, Real*) const
    {
        return {{Real(0), Real(0), Real(0)}, Real(0), Real(0)};
    }
};
}
