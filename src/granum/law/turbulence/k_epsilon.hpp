// Turbulence by its kinetic energy k and its rate of dissipation epsilon.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/law/turbulence/local.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::turbulence
{
//! Standard k-epsilon. The rate is epsilon, m2/s3.
struct KEpsilon
{
    static constexpr base::Card card{.name = "k-epsilon",
                                     .title = "k-epsilon, standard",
                                     .source =
                                         "Launder, Spalding, Comput. Methods Appl. Mech. Eng. 3 (1974) 269 (recalled; "
                                         "constants as in OpenFOAM)",
                                     .valid = "turbulence far above viscosity; spreads round jets 15 to 40 % too fast"};
    static constexpr bool transports = true;
    static constexpr bool resolves_walls = false;  //!< holds in the viscous layer too

    double c_mu = 0.09, c_1 = 1.44, c_2 = 1.92, sigma_k = 1.0, sigma_epsilon = 1.3;
    //! Of production over dissipation (own; that of SST): without it quiet gas with a long memory that comes into
    //! strong shear makes k without measure.
    double production_limit = 10;

    //! Calls visit(name, constant) for all of them.
    template <class Visit>
    void each_constant(Visit&& visit)
    {
        visit("c_mu", c_mu), visit("c_1", c_1), visit("c_2", c_2);
        visit("sigma_k", sigma_k), visit("sigma_epsilon", sigma_epsilon);
        visit("production_limit", production_limit);
    }

    //! Eddy viscosity, m2/s.
    double operator()(Local const& at) const { return at.rate > 0 ? c_mu * at.energy * at.energy / at.rate : 0; }

    //! With the eddy viscosity that the gas has.
    Budget budget(Local const& at, double eddy_viscosity) const
    {
        double const made = std::min(eddy_viscosity * at.strain2(), production_limit * at.rate);
        double const per_time = decay(at.energy, at.rate);
        return {.made = made, .lost = per_time, .rate_made = c_1 * made * per_time, .rate_lost = c_2 * per_time};
    }
    Spread spread(Local const&) const { return {1 / sigma_k, 1 / sigma_epsilon}; }

    //! Dissipation, m2/s3; and over k, 1/s.
    double dissipation(double, double rate) const { return rate; }
    double decay(double energy, double rate) const { return energy > 0 ? rate / energy : 0; }
    //! Change of the rate (per s) where something adds `added` (m2/s3) to k: C_3 (epsilon/k) added.
    double rate_with(double added, double energy, double rate, double c_3) const
    {
        return c_3 * added * decay(energy, rate);
    }
    //! The rate of eddies of a length, m.
    double rate_of(double energy, double length) const
    {
        return std::pow(c_mu, 0.75) * energy * std::sqrt(energy) / length;
    }
    //! The least rate that keeps the eddy viscosity below `largest`, m2/s.
    double least_rate(double energy, double largest) const { return c_mu * energy * energy / largest; }
    //! The rate in a cell at a wall, `distance` from it: within the log layer, or below it.
    double at_wall(double energy, double distance, double viscosity, double karman, bool in_log_layer) const
    {
        return in_log_layer ? rate_of(energy, karman * distance) : 2 * viscosity * energy / (distance * distance);
    }
};
}
