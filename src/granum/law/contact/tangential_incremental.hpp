// Tangential force of a contact that is summed step by step, with or without a correction when the contact unloads.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/dashpot.hpp"
#include "granum/law/contact/tangential_mindlin.hpp"

namespace granum::law::contact
{
//! Moves the tangential `spring` force (x, y, z; N, on the first partner; already in the plane and rescaled) on by the
//! velocity times the step and answers with spring plus dashpot, limited by friction. At the limit the spring is left
//! with just that force.
template <class Real>
TangentialForce<Real> summed_force(Pair<Real> const& pair, Approach<Real> const& at, NormalForce<Real> const& normal,
                                   Triple<Real> const& before, Triple<Real> const& velocity, Real* spring, Real& stored,
                                   Real& stiffness_before)
{
    Real const stiffness = normal.tangential_stiffness;
    Real const later = Real(half_step_of_surface) * at.step * at.inverse_mass;
    Real const viscous = lagged(Real(2) * pair.tangential_damping * normal.tangential_impedance, later);
    Triple<Real> const after = neg_mul_add(stiffness * at.step, velocity, before);
    Triple<Real> const trial = neg_mul_add(viscous, velocity, after);
    Real const limit = pair.sliding_friction * max(normal.force, Real(0));
    Real const size2 = norm2(trial);
    auto const sticks = size2 <= limit * limit;
    Triple<Real> const force = shortening(sticks, limit, size2) * trial;
    spring[0] = select(sticks, after.x, force.x);
    spring[1] = select(sticks, after.y, force.y);
    spring[2] = select(sticks, after.z, force.z);

    Real const viscous_work = viscous * mul_add(later, dot(velocity, force), norm2(velocity));
    Real const sticking = at.step * mul_add(Real(-0.5), dot(before + after, velocity), viscous_work);
    Real const sliding = Real(-0.5) * at.step * dot(before + force, velocity);
    stored = Real(0.5) * norm2(Triple<Real>{spring[0], spring[1], spring[2]}) * normal.tangential_compliance;
    stiffness_before = stiffness;
    return {force, select(sticks, sticking, sliding)};
}

//! dF = -k_t v_t dt with the k_t of the moment: what the contact has built up stays when it unloads.
struct MindlinIncremental
{
    static constexpr base::Card card{
        .name = "mindlin-incremental",
        .title = "Mindlin spring summed step by step, Coulomb limit on the total force",
        .source = "Di Renzo and Di Maio, Chem. Eng. Sci. 59 (2004) 525 (recalled, unverified)",
        .valid = "small slip; near the continuum answer in micro-slip; gains energy when loaded and unloaded in turns"};
    static constexpr int history = 3;

    //! As Mindlin, with the spring's force (N, on the first partner) as history.
    template <class Real>
    TangentialForce<Real> operator()(Pair<Real> const& pair, Approach<Real> const& at, NormalForce<Real> const& normal,
                                     Triple<Real> const& n, Triple<Real> const& velocity, Real* spring, Real& stored,
                                     Real& stiffness_before) const
    {
        Triple<Real> const before = turned_into_plane(Triple<Real>{spring[0], spring[1], spring[2]}, n);
        return summed_force(pair, at, normal, before, velocity, spring, stored, stiffness_before);
    }
};

//! As MindlinIncremental, but when the contact unloads the force falls with its stiffness, so that no energy is gained.
struct MindlinRescaled
{
    static constexpr base::Card card{
        .name = "mindlin-rescaled",
        .title = "Mindlin spring summed step by step and rescaled when the contact unloads",
        .source = "Thornton, Cummins and Cleary, Powder Technol. 233 (2013) 30 (recalled, unverified)",
        .valid = "small slip"};
    static constexpr int history = 4;

    //! As MindlinIncremental; the fourth number kept is the stiffness (N/m) at the step before.
    template <class Real>
    TangentialForce<Real> operator()(Pair<Real> const& pair, Approach<Real> const& at, NormalForce<Real> const& normal,
                                     Triple<Real> const& n, Triple<Real> const& velocity, Real* spring, Real& stored,
                                     Real& stiffness_before) const
    {
        Triple<Real> const turned = turned_into_plane(Triple<Real>{spring[0], spring[1], spring[2]}, n);
        Real const kept = normal.tangential_stiffness * reciprocal(max(spring[3], normal.tangential_stiffness));
        spring[3] = normal.tangential_stiffness;
        return summed_force(pair, at, normal, min(kept, Real(1)) * turned, velocity, spring, stored, stiffness_before);
    }
};
}
