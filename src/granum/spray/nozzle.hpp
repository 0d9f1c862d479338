// The two-fluid nozzle: where its air goes in the gas cells, the jet that coarse cells cannot show, its droplets.
//
// The air enters as a source of mass, enthalpy and momentum J = mass flow times exit velocity, spread over the analytic
// round jet near the tip: symmetric about the true axis, so the jet stays on it whatever the cells are. Where the cells
// are wider than the jet, droplets see the analytic jet instead of the cell mean. Source: physics.md 4.1 (round-jet
// constants recalled, unverified).
#pragma once

#include "granum/base/random.hpp"
#include "granum/particle/sizes.hpp"
#include "granum/spray/droplet.hpp"

#include <optional>
#include <vector>

namespace granum::spray
{
struct Nozzle
{
    Vec3 position, direction{0, 0, -1};                        //!< m, unit
    double half_angle = 0.26;                                  //!< rad, of the droplet cone
    double air_mass_flow = 0;                                  //!< kg/s, moist
    double air_temperature = 293.15, air_vapour_fraction = 0;  //!< K, kg/kg
    double air_velocity = 250;                                 //!< m/s at the exit
    double droplet_velocity = 30;                              //!< m/s at the exit
    double droplet_temperature = 298.15;                       //!< K
    double rate = 0;                                           //!< kg/s of liquid
    double median = 40e-6, spread = 1.6;                //!< of the volume distribution: m, geometric standard deviation
    std::optional<particle::SizeDistribution> sizes{};  //!< instead of the log-normal distribution
    double parcels_per_second = 2e4;
    std::uint64_t number = 0;  //!< among the nozzles: none shares identities or draws with another

    double diameter(base::Random& random) const;  //!< m, of a parcel of droplets: parcels have equal masses
    double median_diameter() const { return sizes ? sizes->mass_diameter(0.5) : median; }  //!< m
    double largest_diameter() const;  //!< m, of all but some droplets in 10^5

    double momentum() const { return air_mass_flow * air_velocity; }  //!< N

    //! Gas velocity (m/s) along the axis at x in the jet of this nozzle in gas of density `density`; 0 behind the tip.
    double jet_speed(Vec3 const& x, double density) const;

    //! Half-width of the jet (half of the axis speed) at distance z from the tip, m.
    static double half_width(double z) { return 0.09 * z; }

    //! Relative strength of the source at x for cells of size `cell`: a Gaussian across the axis, no narrower than the
    //! cells can carry, over two cells along it. The caller normalises the sum over all cells to one.
    double source_weight(Vec3 const& x, double cell) const;

    //! Droplet parcels that leave during the `dt` after `now`; identities count up from the number emitted before.
    std::vector<Droplet> emit(double now, double dt, Liquid const& liquid, std::uint32_t seed) const;
};
}
