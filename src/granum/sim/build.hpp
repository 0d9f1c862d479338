// From the resolved case to the settings of the rooms.
#pragma once

#include "granum/coupling/conduction.hpp"
#include "granum/coupling/exchange.hpp"
#include "granum/dem/engine.hpp"
#include "granum/dem/hard_spheres.hpp"
#include "granum/dem/step_bounds.hpp"
#include "granum/drying/drying.hpp"
#include "granum/gas/flow.hpp"
#include "granum/product/all.hpp"
#include "granum/sim/balance.hpp"
#include "granum/sim/case.hpp"
#include "granum/spray/flight.hpp"
#include "granum/spray/nozzle.hpp"

namespace granum::sim
{
//! Contact laws, walls and gravity. Material 0 is the granule, 1 the wall.
dem::Settings granule_settings(Case const& data);

//! How hard spheres bounce, besides what the settings say.
dem::HardOptions hard_options(Case const& data);

//! The columns that granules of this case need besides those of motion and contacts.
particle::Groups column_groups(Case const& data);

gas::Settings gas_settings(Case const& data);  //!< gas_settings.cpp
gas::Opening gas_opening(Case const& data, OpeningCase const& one);
grid::Lines gas_lines(Case const& data);  //!< faces of the gas cells
//! What passes heat between granules, and from them to walls, beside the gas that flows.
coupling::Conduction conduction(Case const& data, par::Communicator const& comm);
coupling::Laws exchange_laws(Case const& data);
//! Standard deviation of what granules and gas share, m.
double smoothing(Case const& data);

//! Within which a droplet strikes granules, m along each direction.
double capture_reach(Case const& data);
coupling::Scheme mapping_scheme(Case const& data);

spray::Liquid spray_liquid(Case const& data);
std::vector<spray::Nozzle> nozzles(Case const& data);
spray::FlightSettings flight_settings(Case const& data);

product::Any porosity_model(Case const& data);
drying::Settings drying_settings(Case const& data);

//! The largest radius of a parcel, m.
double largest_radius(Case const& data);

//! The smallest parcels of each batch, or of those given of one material: what bounds the step.
std::vector<dem::Grains> granule_kinds(Case const& data);

//! Speed of the fastest wall, m/s: of one that turns at half the diagonal of the chamber from its axis.
double fastest_wall(Case const& data);

//! Its own density, or that of its material, or that of [granules], kg/m3.
double density_of(Case const& data, GranuleCase const& one);

//! Speed at which the two fastest of the granules given by hand would meet head-on, m/s.
double fastest_meeting(Case const& data);

//! Appends a row for a granule that has its density.
void add_granule(particle::Store& granules, GranuleCase const& one);

//! The step that `granum run` takes if the case names none: the least of the bounds; `speed` (m/s) is a typical speed.
double granule_step(Case const& data);
}
