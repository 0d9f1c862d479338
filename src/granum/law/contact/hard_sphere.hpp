// What a collision of hard spheres does: one impulse, with restitution, friction and tangential restitution.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/math/vec3.hpp"

#include <cmath>

namespace granum::law::contact
{
using math::Vec3;

//! How two materials bounce off each other.
struct HardPair
{
    double restitution = 0.8;              //!< normal, 0 to 1
    double sliding_friction = 0.3;         //!< 1
    double tangential_restitution = 0.33;  //!< of the slip where the surfaces stick, 0 to 1
};

//! Answer of the collision operator.
struct Impulse
{
    Vec3 on_first;      //!< N s; the second gets the opposite
    double dissipated;  //!< kinetic energy lost, of translation and rotation, J
};

//! Hoomans' operator for solid spheres (moment of inertia 2/5 m R^2). With m* = m_a m_b / (m_a + m_b) (of a wall: the
//! mass of the sphere), slip velocity v of the first surface against the second and n from the first to the second:
//!
//!     J_n = -(1 + e) m* v_n,    J_t = -min(mu |J_n|, (1 + beta0) |v_t| m* / 3.5)
//!
//! where the smaller of the two decides between sliding throughout and sticking at the end.
struct Hoomans
{
    static constexpr base::Card card{
        .name = "hoomans",
        .title = "Hard spheres: restitution, Coulomb friction, tangential restitution",
        .source =
            "Hoomans, Kuipers, Briels and van Swaaij, Chem. Eng. Sci. 51 (1996) 99 (recalled, unverified; "
            "its algebra was checked by conservation of momentum and energy)",
        .valid =
            "short binary contacts: overlaps and the duration of a contact do not matter; beta0 = 0.33 for glass "
            "is recalled, unverified"};

    //! `n` unit, from the first centre to the second; `slip` m/s, of the first surface against the second at the
    //! contact, with slip.n > 0 where they approach; `mass` m*, kg. Surfaces that part get no impulse.
    Impulse operator()(HardPair const& pair, double mass, Vec3 const& n, Vec3 const& slip) const
    {
        double const approach = dot(slip, n);
        if (approach <= 0) return {{}, 0};
        Vec3 const tangential = slip - approach * n;
        double const speed = norm(tangential);
        double const normal = (1 + pair.restitution) * mass * approach;
        double const sticking = (1 + pair.tangential_restitution) * mass * speed / 3.5;
        double const sliding = pair.sliding_friction * normal;
        double const along = sliding < sticking ? sliding : sticking;
        Vec3 impulse = -normal * n;
        if (along > 0) impulse -= (along / speed) * tangential;
        double const lost = normal * (approach - 0.5 * normal / mass) + along * (speed - 1.75 * along / mass);
        return {impulse, lost};
    }
};
}
