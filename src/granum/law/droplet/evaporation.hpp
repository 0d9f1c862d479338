// Evaporation of one droplet of uniform temperature in flight, and the water activity of what it is made of.
//
// Source: Abramzon and Sirignano, Int. J. Heat Mass Transfer 32 (1989) 1605 (recalled), with Ranz and Marshall's
// transfer numbers and film properties by the one-third rule.
#pragma once

namespace granum::law::droplet
{
struct Drop
{
    double diameter;        //!< m
    double temperature;     //!< K
    double water_activity;  //!< of its surface, 1 for water
    double slip;            //!< m/s relative to the gas
};

struct Air
{
    double temperature;      //!< K
    double vapour_fraction;  //!< kg vapour per kg moist air
    double pressure;         //!< Pa
};

struct Rates
{
    double mass;          //!< kg/s of water leaving; negative where it condenses
    double heat;          //!< W into the drop by convection
    double transfer = 0;  //!< Sherwood number times diffusivity, m2/s
};

//! Rates of `drop` in `air`. Without a heat of evaporation: the drop's energy falls by mass * L.
Rates evaporation(Drop const& drop, Air const& air);

//! W into a drop that does not evaporate, by convection; its water activity is not used.
double convection(Drop const& drop, Air const& air);

//! K at which convection supplies just the heat of evaporation (diffusive wet bulb); `drop.temperature` is not used.
double equilibrium_temperature(Drop drop, Air const& air);

//! Water activity of a solution of `moisture` kg water per kg solids: Raoult with a dissociation factor down to
//! saturation at 1 / `solubility` (solubility in kg solids per kg water), constant below; 1 for a suspension
//! (solubility 0). Molar mass of the solids in kg/mol.
double water_activity(double moisture, double solubility, double molar_mass, double dissociation);
}
