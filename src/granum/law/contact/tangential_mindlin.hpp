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
        Triple<Real> const none{Real(0), Real(0), Real(0)};
        Triple<Real> const spring = neg_mul_add(stiffness, after, none);
        Triple<Real> const trial = neg_mul_add(viscous, velocity, spring);
        Real const limit = pair.sliding_friction * max(normal.force, Real(0));
        Real const size2 = norm2(trial);
        auto const sticks = size2 <= limit * limit;
        Triple<Real> const force = shortening(sticks, limit, size2) * trial;
        Triple<Real> const carried = neg_mul_add(normal.tangential_compliance, force, none);
        slip[0] = select(sticks, after.x, carried.x);
        slip[1] = select(sticks, after.y, carried.y);
        slip[2] = select(sticks, after.z, carried.z);

        Real const against_before = -stiffness_before * dot(before, velocity);
        Real const viscous_work = viscous * mul_add(later, dot(velocity, force), norm2(velocity));
        Real const sticking = at.step * mul_add(Real(-0.5), against_before + dot(spring, velocity), viscous_work);
        Real const sliding = Real(-0.5) * at.step * (against_before + dot(force, velocity));
        stored = Real(0.5) * stiffness * norm2(Triple<Real>{slip[0], slip[1], slip[2]});
        stiffness_before = stiffness;
        return {force, select(sticks, sticking, sliding)};
    }
};
}
