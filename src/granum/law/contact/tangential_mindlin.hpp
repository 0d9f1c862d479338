// Tangential force of a contact: Mindlin's spring with a dashpot, limited by Coulomb friction.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/dashpot.hpp"

namespace granum::law::contact
{
//! Share of a step's force that brings the tangential velocity from the middle of the last step to its end: half a step
//! of 7/2 over m*, what a force at the surface of spheres does to the velocity of their contact point.
inline constexpr double half_step_of_surface = 1.75;

//! F = -k_t slip - c_t v_t with the tangential displacement `slip` over the whole contact, c_t = 2 g_t sqrt(k_t m*).
//!
//! The limit mu F_n holds for the force in total, spring and dashpot; the spring is then reset to carry just that
//! force. Limiting the spring alone misses the rigid-body answer of sliding impacts by more than ten per cent.
struct Mindlin
{
    static constexpr base::Card card{
        .name = "mindlin",
        .title = "Mindlin spring on the total displacement, Coulomb limit on the total force",
        .source = "Mindlin and Deresiewicz, J. Appl. Mech. 20 (1953) 327 (recalled, unverified)",
        .valid =
            "small slip; the spring loses energy when the overlap falls, as known for "
            "the total form"};
    static constexpr int history = 3;

    //! Moves `slip` (x, y, z; m, first partner against second) on by `velocity` (m/s, in the plane of the contact, in
    //! the middle of the last step) and answers with the force on the first partner. `stored` (J) becomes what the
    //! spring holds; `stiffness_before` (N/m) is that of the step before on entry and that of this step after. Both
    //! serve the energy ledger only: no force depends on them.
    template <class Real>
    TangentialForce<Real> operator()(Pair<Real> const& pair, Approach<Real> const& at, NormalForce<Real> const& normal,
                                     Triple<Real> const& n, Triple<Real> const& velocity, Real* slip, Real& stored,
                                     Real& stiffness_before) const
    {
        Real const stiffness = normal.tangential_stiffness;
        Real const later = Real(half_step_of_surface) * at.step * at.inverse_mass;
        Real const viscous = lagged(Real(2) * pair.tangential_damping * normal.tangential_impedance, later);
        Triple<Real> const before = turned_into_plane(Triple<Real>{slip[0], slip[1], slip[2]}, n);
        Triple<Real> const after = mul_add(at.step, velocity, before);
        // The negative of spring and dashpot, and of what friction lets through.
        Triple<Real> const spring = stiffness * after;
        Triple<Real> const trial = mul_add(viscous, velocity, spring);
        Real const limit = pair.sliding_friction * max(normal.force, Real(0));
        Real const size2 = norm2(trial);
        auto const sticks = size2 <= limit * limit;
        Triple<Real> const against = shortening(limit, size2) * trial;
        Real const softness = normal.tangential_compliance;
        slip[0] = select(sticks, after.x, softness * against.x);
        slip[1] = select(sticks, after.y, softness * against.y);
        slip[2] = select(sticks, after.z, softness * against.z);

        Real const before_too = stiffness_before * dot(before, velocity);
        Real const viscous_work = viscous * neg_mul_add(later, dot(velocity, against), norm2(velocity));
        Real const sticking = at.step * mul_add(Real(0.5), before_too + dot(spring, velocity), viscous_work);
        Real const sliding = Real(0.5) * at.step * (before_too + dot(against, velocity));
        stored = Real(0.5) * stiffness * norm2(Triple<Real>{slip[0], slip[1], slip[2]});
        stiffness_before = stiffness;
        return {-against, select(sticks, sticking, sliding)};
    }
};
}
