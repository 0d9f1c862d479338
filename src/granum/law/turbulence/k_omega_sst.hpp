// Turbulence by its kinetic energy k and omega = epsilon / (beta* k): k-omega at walls, k-epsilon far from them.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/turbulence/local.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::turbulence
{
//! Menter's shear stress transport, form of 2003. The rate is omega, 1/s.
struct KOmegaSst
{
    static constexpr base::Card card{
        .name = "k-omega-sst",
        .title = "k-omega SST",
        .source =
            "Menter, Kuntz, Langtry, Turbulence, Heat and Mass Transfer 4 (2003) 625 (recalled; form and "
            "constants as in OpenFOAM)",
        .valid = "walls, resolved or not, separation, free flow"};
    static constexpr bool transports = true;
    static constexpr bool resolves_walls = true;  //!< holds in the viscous layer too

    double alpha_k1 = 0.85, alpha_k2 = 1.0, alpha_omega1 = 0.5, alpha_omega2 = 0.856;
    double gamma_1 = 5.0 / 9, gamma_2 = 0.44, beta_1 = 0.075, beta_2 = 0.0828, beta_star = 0.09;
    double a_1 = 0.31, b_1 = 1, c_1 = 10;

    //! Calls visit(name, constant) for all of them.
    template <class Visit>
    void each_constant(Visit&& visit)
    {
        visit("alpha_k1", alpha_k1), visit("alpha_k2", alpha_k2);
        visit("alpha_omega1", alpha_omega1), visit("alpha_omega2", alpha_omega2);
        visit("gamma_1", gamma_1), visit("gamma_2", gamma_2), visit("beta_1", beta_1), visit("beta_2", beta_2);
        visit("beta_star", beta_star), visit("a_1", a_1), visit("b_1", b_1), visit("c_1", c_1);
    }

    //! Eddy viscosity, m2/s.
    double operator()(Local const& at) const
    {
        double const below = shear_limit(at);
        return below > 0 ? a_1 * at.energy / below : 0;
    }

    Budget budget(Local const& at, double eddy_viscosity) const
    {
        double const near = at_walls(at), gamma = mix(near, gamma_1, gamma_2), beta = mix(near, beta_1, beta_2);
        double const strain2 = at.strain2();
        double const made = std::min(eddy_viscosity * strain2, c_1 * beta_star * at.energy * at.rate);
        double const most = c_1 / a_1 * beta_star * at.rate * shear_limit(at);
        double const cross = (1 - near) * crossing(at);
        return {.made = made,
                .lost = beta_star * at.rate,
                .rate_made = gamma * std::min(strain2, most) + std::max(cross, 0.0),
                .rate_lost = beta * at.rate + (at.rate > 0 ? std::max(-cross, 0.0) / at.rate : 0)};
    }
    Spread spread(Local const& at) const
    {
        double const near = at_walls(at);
        return {mix(near, alpha_k1, alpha_k2), mix(near, alpha_omega1, alpha_omega2)};
    }

    double dissipation(double energy, double rate) const { return beta_star * energy * rate; }
    double decay(double, double rate) const { return beta_star * rate; }
    //! epsilon = beta* k omega changes by C_3 (epsilon/k) added, so omega by (C_3 - 1) (omega/k) added.
    double rate_with(double added, double energy, double rate, double c_3) const
    {
        return energy > 0 ? (c_3 - 1) * added * rate / energy : 0;
    }
    double rate_of(double energy, double length) const
    {
        return std::sqrt(energy) / (std::pow(beta_star, 0.25) * length);
    }
    double least_rate(double energy, double largest) const { return energy / largest; }
    //! Automatic: the root of the sum of squares of both layers' values, whichever the cell is in.
    double at_wall(double energy, double distance, double viscosity, double karman, bool) const
    {
        double const viscous = 6 * viscosity / (beta_1 * distance * distance);
        return std::hypot(viscous, rate_of(energy, karman * distance));
    }

  private:
    static double mix(double near, double one, double two) { return near * one + (1 - near) * two; }
    double crossing(Local const& at) const { return at.rate > 0 ? 2 * alpha_omega2 * at.crossing / at.rate : 0; }

    //! F1: 1 near walls, 0 far from them.
    double at_walls(Local const& at) const
    {
        double const y = at.wall_distance;
        if (!(at.rate > 0) || std::isinf(y)) return 0;
        double const turbulent = std::sqrt(at.energy) / (beta_star * at.rate * y);
        double const viscous = 500 * at.viscosity / (y * y * at.rate);
        double const free = 4 * alpha_omega2 * at.energy / (std::max(crossing(at), 1e-10) * y * y);
        double const argument = std::min({std::max(turbulent, viscous), free, 10.0});
        return std::tanh(argument * argument * argument * argument);
    }
    //! max(a1 omega, b1 F2 |S|), 1/s.
    double shear_limit(Local const& at) const
    {
        double const y = at.wall_distance;
        double within = 0;  // F2
        if (at.rate > 0 && !std::isinf(y)) {
            double const turbulent = 2 * std::sqrt(at.energy) / (beta_star * at.rate * y);
            double const viscous = 500 * at.viscosity / (y * y * at.rate);
            double const argument = std::min(std::max(turbulent, viscous), 100.0);
            within = std::tanh(argument * argument);
        }
        return std::max(a_1 * at.rate, b_1 * within * std::sqrt(at.strain2()));
    }
};
}
