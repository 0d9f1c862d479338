// A droplet parcel becomes a deposit: momentum, heat and mass go to the granule, the record of the impact begins.
#pragma once

#include "granum/drying/deposits.hpp"

namespace granum::drying
{
using math::Vec3;

//! A droplet parcel at the moment it meets a granule, in the units of one real droplet where not said otherwise.
struct Arrival
{
    double weight = 0;                                                          //!< real droplets in the parcel
    double water = 0, solute = 0;                                               //!< kg of one droplet
    double diameter = 0;                                                        //!< m, before any splashing
    double temperature = 0;                                                     //!< K
    double enthalpy = 0;                                                        //!< J of the whole parcel, less `heat`
    double heat = 0;                                                            //!< J until the parcel's melt is solid
    double age = 0, path = 0;                                                   //!< s, m
    Vec3 position, velocity;                                                    //!< m, m/s
    double density = 0, viscosity = 0, surface_tension = 0, contact_angle = 0;  //!< of the liquid, SI
    double sine = 0;      //!< of the angle between path and surface normal at the impact point
    double splashed = 0;  //!< share of the mass that has splashed off
    bool dry = false;     //!< or with a crust: it does not spread
    double draw = 1;      //!< from 0 to 1: below the granule's coverage the droplet falls on a wet deposit and joins it
};

//! What the granule sees at the moment of impact.
struct Local
{
    double gas_temperature = 0, gas_humidity = 0, pressure = 101325, drying_potential = 0, solids_fraction = 0,
           slip = 0;
};

//! Adds the deposit to granule `row` and all that the droplet carries to the granule's columns.
void deposit(particle::Store& granules, std::size_t row, Deposits& deposits, Arrival const& droplet, Local const& local,
             double now);
}
