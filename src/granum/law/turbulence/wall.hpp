// What lies between a wall and the middle of the cell beside it: a viscous layer, and above it the logarithmic law.
//
// Both layers meet where they agree, at y+ = 11.5 with the constants below. Lengths and speeds are over nu / u_tau and
// u_tau.
#pragma once

#include <algorithm>
#include <cmath>

namespace granum::law::turbulence
{
struct WallLaw
{
    double karman = 0.41, smoothness = 9.8;  //!< u+ = ln(E y+) / karman
    double c_mu = 0.09;                      //!< u_tau = c_mu^(1/4) k^(1/2) where turbulence is in balance

    template <class Visit>
    void each_constant(Visit&& visit)
    {
        visit("karman", karman), visit("wall_smoothness", smoothness), visit("wall_c_mu", c_mu);
    }

    //! y+ where the layers meet.
    double edge() const
    {
        double y = 11;
        for (int k = 0; k < 20; ++k) y = std::log(std::max(smoothness * y, 1.0)) / karman;
        return y;
    }
    //! u+ at y+, of a smooth wall.
    double velocity(double y, double edge_at) const { return y > edge_at ? std::log(smoothness * y) / karman : y; }
    double velocity(double y) const { return velocity(y, edge()); }

    //! u_tau from k, m/s.
    double friction_velocity(double energy) const { return std::sqrt(std::sqrt(c_mu) * std::max(energy, 0.0)); }
    //! y+ from the speed along the wall at a distance: u+ y+ = speed distance / viscosity, by Newton's rule.
    double place(double speed, double distance, double viscosity, double edge_at) const
    {
        double const product = speed * distance / viscosity;
        if (product <= edge_at * edge_at) return std::sqrt(product);
        double y = edge_at;
        for (int k = 0; k < 20; ++k) {
            double const over = y * std::log(smoothness * y) / karman - product;
            y -= over * karman / (std::log(smoothness * y) + 1);
        }
        return y;
    }
    //! Temperature over its scale at y+: Pr y+ in the conductive layer; beyond it Pr_t (u+ + P), P by Jayatilleke
    //! (Prog. Heat Mass Transfer 1 (1969) 193, recalled). The smaller one holds.
    double temperature(double y, double edge_at, double prandtl, double turbulent_prandtl) const
    {
        double const ratio = prandtl / turbulent_prandtl;
        double const resistance = 9.24 * (std::pow(ratio, 0.75) - 1) * (1 + 0.28 * std::exp(-0.007 * ratio));
        double const beyond = turbulent_prandtl * (velocity(y, edge_at) + resistance);
        return y > edge_at ? std::min(prandtl * y, beyond) : prandtl * y;
    }
};
}
