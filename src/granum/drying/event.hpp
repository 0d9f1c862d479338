// The record of one dried deposit: the state of the droplet at impact, what it met, how long it took (physics.md 5.8).
//
// A row stands for `weight` equal real droplets that one droplet parcel left on one granule parcel.
#pragma once

#include <array>
#include <string_view>

namespace granum::drying
{
struct EventColumn
{
    std::string_view name, unit, doc;
};

//! Every member is a double, in the order of `event_columns`: a row of the table is the struct itself.
struct Event
{
    double granule, t_deposit, t_dry_end, x, y, z, solids, weight;
    double droplet_diameter, moisture_at_impact, droplet_temperature, age, path, normal_speed, tangential_speed;
    double weber, reynolds, ohnesorge, mundo, splashed, dry;
    double gas_temperature, gas_humidity, relative_humidity, drying_potential, granule_temperature, granule_moisture;
    double coverage, solids_fraction, slip, merged;
    double drying_time, mean_gas_temperature, mean_gas_humidity, mean_drying_potential, mean_granule_temperature;
    double mean_slip, mean_flux, max_flux, constant_rate_time, initial, porosity;
    double footprint, granule_diameter, per_granule;
    double supersaturation, crystals, crystal_size, imbibed;
    double wet_contacts, wet_impulse, viscous_stokes, critical_stokes;
};

inline constexpr std::array<EventColumn, sizeof(Event) / sizeof(double)> event_columns{{
    {"granule", "1", "identity of the granule parcel"},
    {"t_deposit", "s", "simulated time of the impact"},
    {"t_dry_end", "s", "simulated time when the deposit was dry"},
    {"x", "m", "place of the impact"},
    {"y", "m", "place of the impact"},
    {"z", "m", "place of the impact"},
    {"solids", "kg", "dry solids that the deposit left, all real droplets together"},
    {"weight", "1", "number of real droplets"},
    {"droplet_diameter", "m", "of a real droplet at impact"},
    {"moisture_at_impact", "kg/kg", "water per solids of the droplet at impact"},
    {"droplet_temperature", "K", "at impact"},
    {"age", "s", "time of flight"},
    {"path", "m", "length of flight"},
    {"normal_speed", "m/s", "of the impact, at a point drawn over the granule's cross-section"},
    {"tangential_speed", "m/s", "of the impact, at a point drawn over the granule's cross-section"},
    {"weber", "1", "with the normal speed"},
    {"reynolds", "1", "of the droplet, with the normal speed"},
    {"ohnesorge", "1", "of the droplet"},
    {"mundo", "1", "Oh Re^1.25; splashing above about 57.7"},
    {"splashed", "1", "share of the droplet's mass that splashed off"},
    {"dry", "1", "1: the droplet was dry or had a crust, and did not spread"},
    {"gas_temperature", "K", "seen by the granule at impact"},
    {"gas_humidity", "kg/kg", "loading seen by the granule at impact"},
    {"relative_humidity", "1", "seen by the granule at impact"},
    {"drying_potential", "1", "local, at impact"},
    {"granule_temperature", "K", "at impact"},
    {"granule_moisture", "kg/kg", "liquid water per dry mass of the granule at impact"},
    {"coverage", "1", "wet fraction of the granule's surface at impact"},
    {"solids_fraction", "1", "of the bed around the granule at impact"},
    {"slip", "m/s", "superficial gas speed relative to the granule at impact"},
    {"merged", "1", "droplets that have joined what lay wet on the spot"},
    {"drying_time", "s", "from the last impact to dry"},
    {"mean_gas_temperature", "K", "mean over the drying time"},
    {"mean_gas_humidity", "kg/kg", "mean loading over the drying time"},
    {"mean_drying_potential", "1", "mean local drying potential over the drying time"},
    {"mean_granule_temperature", "K", "mean over the drying time"},
    {"mean_slip", "m/s", "mean over the drying time"},
    {"mean_flux", "kg/m2/s", "evaporated water, less the trace at the end, per footprint and drying time"},
    {"max_flux", "kg/m2/s", "largest evaporation per footprint"},
    {"constant_rate_time", "s", "time until the solution was saturated (solutions)"},
    {"initial", "1", "share of the solids that the quasi-steady start had placed, not sprayed"},
    {"porosity", "1", "of the layer element by the chosen model"},
    {"footprint", "m", "radius of the base of one deposit"},
    {"granule_diameter", "m", "of a real granule when the deposit was dry"},
    {"per_granule", "1", "deposits per real granule of the parcel"},
    {"supersaturation", "1", "largest, dissolved over what the water can hold; 0 without drying.crystallisation"},
    {"crystals", "1", "in one real deposit; 0 without drying.crystallisation"},
    {"crystal_size", "m", "of crystals of equal size that hold all solids; 0 without drying.crystallisation"},
    {"imbibed", "1", "share of the solids that went into pores of the core; 0 without granules.pores"},
    {"wet_contacts", "1", "collisions of a real granule with others and walls over the drying time"},
    {"wet_impulse", "N s", "sum of the impulses of these collisions"},
    {"viscous_stokes", "1", "of these collisions with the liquid as it was sprayed; 0 where there were none"},
    {"critical_stokes", "1", "below which they stick where they meet the deposit as it landed"},
}};
}
