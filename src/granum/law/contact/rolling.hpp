// Rolling resistance of a contact: a torque that grows with the relative rotation up to a limit, or none.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/pair.hpp"

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
        Triple<Real> const rolling = mul_add(-dot(relative_spin, n), n, relative_spin);
        Triple<Real> const before = turned_into_plane(Triple<Real>{spring[0], spring[1], spring[2]}, n);
        Triple<Real> const trial = mul_add(-stiffness * at.step, rolling, before);
        Triple<Real> const torque = shortening(limit, norm2(trial)) * trial;
        spring[0] = torque.x, spring[1] = torque.y, spring[2] = torque.z;
        return {torque, Real(0.5) * norm2(torque) * reciprocal(max(stiffness, Real(tiny))),
                Real(-0.5) * at.step * dot(before + torque, rolling)};
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
