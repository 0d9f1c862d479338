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

    //! Moves `torque` (N m, on the first partner) on by the relative spin (rad/s, first against second) times dt.
    RollingTorque operator()(Pair const& pair, Approach const& at, NormalForce const& normal,
                             double tangential_stiffness, Vec3 const& n, Vec3 const& relative_spin, double dt,
                             Vec3& torque) const
    {
        double const limit = pair.rolling_friction * at.radius * normal.force;
        double const stiffness = tangential_stiffness * at.radius * at.radius;
        Vec3 const rolling = relative_spin - dot(relative_spin, n) * n;
        Vec3 const before = turned_into_plane(torque, n);
        torque = before - (stiffness * dt) * rolling;
        double const size2 = norm2(torque);
        if (size2 > limit * limit) torque *= limit / std::sqrt(size2);
        return {0.5 * norm2(torque) / stiffness, -0.5 * dt * dot(before + torque, rolling)};
    }
};

//! No resistance to rolling.
struct NoRolling
{
    static constexpr base::Card card{.name = "none", .title = "No rolling resistance", .source = "", .valid = "always"};

    RollingTorque operator()(Pair const&, Approach const&, NormalForce const&, double, Vec3 const&, Vec3 const&, double,
                             Vec3&) const
    {
        return {};
    }
};
}
