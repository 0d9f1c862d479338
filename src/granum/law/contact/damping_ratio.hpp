// The damping of a spring-dashpot contact that gives a wanted restitution, in closed form.
#pragma once

namespace granum::law::contact
{
//! What happens at the end of a damped contact, where spring plus dashpot would pull.
enum class Attraction
{
    cut,  //!< the force is never negative; the contact ends where it vanishes
    keep  //!< the pull stays until the surfaces part
};

//! Ratio of damping to critical damping zeta of x'' + 2 zeta x' + x = 0 at which a contact gives back `restitution`
//! (clamped to [1e-3, 1]) of its speed.
//!
//! Pull kept: the contact lasts half a period, ln e = -pi zeta / sqrt(1 - zeta^2). Pull cut: it ends where
//! x + 2 zeta x' = 0; with zeta = cos(phi) that is at phase 2 phi, where ln e = -2 phi cot(phi); beyond zeta = 1 with
//! zeta = cosh(u), ln e = -2 u coth(u). (Schwager and Poeschel, Granular Matter 9 (2007) 465, recalled, unverified; the
//! lines above are derived anew.) The Hertz contact with c ~ overlap^(1/4) obeys the same equation in
//! x = overlap^(5/4), so its restitution is independent of the speed and is given by the same zeta.
double damping_ratio(double restitution, Attraction attraction);

//! Duration of that contact, times sqrt(k/m).
double contact_phase(double damping_ratio, Attraction attraction);
}
