// A spring and a dashpot along the normal, taken over one step of velocity Verlet.
#pragma once

#include "granum/law/contact/damping_ratio.hpp"
#include "granum/law/contact/pair.hpp"

namespace granum::law::contact
{
//! The coefficient (of any unit) with which a dashpot that is given the velocity of the middle of the last step damps a
//! free contact as `coefficient` would at the end of it, where the force acts. `later` times the coefficient is the
//! share of the velocity that half a step of the dashpot's own force takes away.
//!
//! The half step that the velocity lags behind acts like a lighter mass, m - c dt/2; the smaller coefficient keeps the
//! ratio c / sqrt(k m). However strong the damping, it then never reverses the motion by itself. Adding the missing
//! half step of acceleration instead would be wrong wherever other forces hold the contact, as in a bed at rest.
template <class Real>
Real lagged(Real coefficient, Real later)
{
    Real const q = coefficient * (Real(0.5) * later);
    return coefficient * reciprocal(mul_add(q, mul_add(Real(0.5), q, Real(1)), Real(1)));
}

//! True in the first step of a contact: the surfaces touched less than a step ago.
template <class Real>
auto just_touched(Approach<Real> const& at)
{
    return mul_add(at.speed, at.step, at.overlap) < Real(0);
}

//! Overlap at which the dashpot is to be evaluated: in the first step that which is reached half a step from now.
template <class Real>
Real damped_overlap(Approach<Real> const& at)
{
    auto const first = just_touched(at);
    if (!any(first)) return at.overlap;
    return select(first, mul_add(Real(-0.5) * at.speed, at.step, at.overlap), at.overlap);
}

//! Force (N) of a spring that pushes with `elastic` and a dashpot of `coefficient` (N s/m, at `damped_overlap`), which
//! grows with the overlap to the power of `power` - 1.
//!
//! In the first step the force stands for the whole way since the touch, whenever in the step that was: over it the
//! dashpot gives the impulse coefficient * overlap / power. With 20 steps to a contact, restitution from 0.2 to 0.98
//! and any phase of the first step against the touch, the restitution is then met to half a per cent instead of eight.
//! (The lag of the first step lies between a half and a whole of the usual one; three quarters fits best.)
template <class Real>
Real spring_and_dashpot(Approach<Real> const& at, Real elastic, Real coefficient, double power, Attraction attraction)
{
    auto const first = just_touched(at);
    Real later = Real(0.5) * at.step * at.inverse_mass;
    Real opening = at.speed;
    if (any(first)) {
        later = select(first, Real(0.75) * later, later);
        opening = select(first, -damped_overlap(at) * reciprocal(max(Real(power) * at.step, Real(tiny))), opening);
    }
    Real const force = neg_mul_add(lagged(coefficient, later), opening, elastic);
    return attraction == Attraction::cut ? max(force, Real(0)) : force;
}
}
