// Normal force of elastic spheres with viscous damping: Hertz's spring and Tsuji's dashpot.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/contact/pair.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::contact
{
//! What happens at the end of a damped contact, where spring plus dashpot would pull.
enum class Attraction
{
    cut,  //!< the force is never negative; the damping is corrected so that the restitution is the one asked for
    keep  //!< the pull stays; Tsuji's own damping then gives exactly the restitution asked for
};

//! F = k overlap - c speed, k = 4/3 E* a, c = 2 g sqrt(S m*), S = 2 E* a, a = sqrt(R* overlap).
struct HertzTsuji
{
    static constexpr base::Card card{
        .name = "hertz-tsuji",
        .title = "Hertz spring with Tsuji damping",
        .source = "Tsuji, Tanaka and Ishida, Powder Technol. 71 (1992) 239 (recalled, unverified)",
        .valid =
            "elastic spheres, overlap small against the radius; damping fitted for "
            "restitution from 0.1 to 1, extrapolated below"};
    Attraction attraction = Attraction::cut;

    //! The g that gives `restitution` (clamped to [1e-3, 1]), dimensionless.
    double damping(double restitution) const;

    NormalForce operator()(Pair const& pair, Approach const& at) const
    {
        double const contact_radius = std::sqrt(at.radius * at.overlap);
        double const elastic = 4.0 / 3.0 * pair.youngs_modulus * contact_radius * at.overlap;
        double const viscous = 2 * pair.damping * std::sqrt(2 * pair.youngs_modulus * contact_radius * at.mass);
        double force = elastic - viscous * at.speed;
        if (attraction == Attraction::cut) force = std::max(0.0, force);
        return {force, elastic, 0.4 * elastic * at.overlap, contact_radius};
    }
};
}
