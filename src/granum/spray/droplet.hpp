// A droplet parcel in flight: `weight` equal real droplets of solution, suspension or melt.
#pragma once

#include "granum/law/dispersion/turbulence.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/math/vec3.hpp"

#include <cmath>
#include <cstdint>

namespace granum::spray
{
using math::Vec3;

//! The liquid that is sprayed.
struct Liquid
{
    double density = 1000, viscosity = 1e-3, surface_tension = 0.07;  //!< of the feed: kg/m3, Pa s, N/m
    double solids_density = 1440;                                     //!< kg/m3
    double solids_fraction = 0.3;                                     //!< kg solids per kg feed
    double solids_heat_capacity = 1400;                               //!< J/kg/K
    double solubility = 0;                                            //!< kg solids per kg water; 0: a suspension
    double molar_mass = 0.1, dissociation = 1;
    double contact_angle = 0.7;     //!< rad
    double locking = 0;             //!< share of the volume at which solids at the surface lock; 0: they never do
    double solids_diffusivity = 0;  //!< of the solids in the liquid, m2/s; 0: as fast as the surface recedes
    double crust_diffusivity = 0;   //!< of vapour in the crust, m2/s; 0: as in free gas
    double melting_point = 0;       //!< K, of a melt (whose solids fraction is 1); 0: no melt
    double fusion_heat = 0;         //!< J/kg
    bool melt() const { return melting_point > 0; }
    double feed_moisture() const { return (1 - solids_fraction) / solids_fraction; }
};

struct Droplet
{
    std::uint64_t id = 0;
    Vec3 position, velocity;       //!< m, m/s
    double weight = 0;             //!< real droplets
    double water = 0, solute = 0;  //!< kg of one real droplet
    double molten = 0;             //!< kg of the solute of one real droplet
    double temperature = 0;        //!< K, uniform
    double age = 0, path = 0;      //!< s, m
    double crust = 0;              //!< m, diameter at which its solids locked; 0: they have not
    std::uint32_t splashes = 0;    //!< that it has come from
    law::dispersion::Eddy eddy{};  //!< of the gas that it sees
    double delay = 0;              //!< s of the coming step that pass before it flies; negative: s that it lags behind

    //! kg of all real droplets.
    double solids() const { return weight * solute; }
    double liquid_water() const { return weight * water; }
    double mass() const { return weight * (water + solute); }

    //! Is it a grain, dried or solidified, or has it a crust? Such a droplet sticks only where it falls on a wet spot.
    bool dry(Liquid const& liquid, double end_moisture) const
    {
        if (liquid.melt()) return molten < end_moisture * solute;
        return crust > 0 || water < end_moisture * liquid.feed_moisture() * solute;
    }

    //! m, of a real droplet: volumes of water and solids add up to that of the feed at the feed's moisture, until its
    //! solids lock.
    double diameter(Liquid const& liquid) const
    {
        if (crust > 0) return crust;
        double const feed = solute / liquid.solids_fraction;  // mass when it left the nozzle
        double const lost = feed - (water + solute);          // water that has evaporated since
        double const volume = feed / liquid.density - lost / material::water_density;
        double const least = solute / liquid.solids_density;
        return std::cbrt(6 / math::pi * (volume > least ? volume : least));
    }

    //! J of all real droplets of a melt that must go until they are solid and no warmer than their melting point.
    double heat_until_solid(Liquid const& liquid) const
    {
        double const above = temperature > liquid.melting_point ? temperature - liquid.melting_point : 0;
        return weight * (solute * liquid.solids_heat_capacity * above + molten * liquid.fusion_heat);
    }

    //! J of all real droplets, zero at 0 degC, solid.
    double enthalpy(Liquid const& liquid) const
    {
        double const capacity = water * material::heat_capacity_water + solute * liquid.solids_heat_capacity;
        return weight * (capacity * (temperature - math::zero_celsius) + molten * liquid.fusion_heat);
    }
};
}
