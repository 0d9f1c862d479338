// Tangential force of a contact: Mindlin's spring with a dashpot, limited by Coulomb friction.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/pair.hpp"

namespace granum::law::contact
{
//! F = -k_t slip - c_t v_t with k_t = 8 G* a and the tangential displacement `slip` over the whole contact.
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

    //! Moves `slip` (m, first partner against second) on by `velocity` * dt and answers with the force on the first.
    TangentialForce operator()(Pair const& pair, Approach const& at, NormalForce const& normal, Vec3 const& n,
                               Vec3 const& velocity, double dt, Slip& slip) const
    {
        double const stiffness = 8 * pair.shear_modulus * normal.contact_radius;
        double const viscous = 2 * pair.damping * std::sqrt(stiffness * at.mass);
        Vec3 const before = turned_into_plane(slip.displacement, n);
        Vec3 const spring_before = -slip.stiffness * before;
        slip = {before + dt * velocity, stiffness};
        Vec3 const spring = -stiffness * slip.displacement;
        Vec3 force = spring - viscous * velocity;
        double const limit = pair.sliding_friction * normal.force;
        double const size2 = norm2(force);
        if (size2 <= limit * limit) {
            // The velocity is that of the middle of the last step; half a step of this contact's own acceleration
            // (7/2 over m* at the surface of spheres) brings it to the end, where the dashpot acts.
            Vec3 const now = velocity + (1.75 * dt / at.mass) * force;
            double const work = dt * (viscous * dot(velocity, now) - 0.5 * dot(spring_before + spring, velocity));
            return {force, stiffness, 0.5 * stiffness * norm2(slip.displacement), work};
        }
        force *= limit / std::sqrt(size2);
        slip.displacement = force * (-1 / stiffness);
        return {force, stiffness, 0.5 * stiffness * norm2(slip.displacement),
                -0.5 * dt * dot(spring_before + force, velocity)};
    }
};
}
