// The steady heat and water balance of the whole apparatus, with no dimension in space: what a recipe must come to.
#pragma once

#include "granum/sim/case.hpp"

namespace granum::sim
{
struct Balance
{
    double dry_mass_flow = 0;       //!< kg dry air per s, fluidising and atomising
    double water_rate = 0;          //!< kg/s of water in the spray
    double inlet_temperature = 0;   //!< K, of both airs mixed
    double inlet_humidity = 0;      //!< kg/kg dry, of both airs mixed
    double wet_bulb = 0;            //!< K, adiabatic saturation of the mixed inlet air
    double wet_bulb_humidity = 0;   //!< kg/kg dry
    double outlet_humidity = 0;     //!< kg/kg dry, all water evaporated
    double outlet_temperature = 0;  //!< K, adiabatic
    double outlet_relative_humidity = 0;
    double eta = 1;  //!< drying potential left at the outlet: 1 dry, 0 saturated, below 0 over-wetted

    bool overwetted() const { return eta < 0 || outlet_relative_humidity >= 1; }
};

//! Area of an opening, m2, without what of it walls within the chamber cover.
double open_area(Case const& data, OpeningCase const& opening);

//! Gas that enters through an inlet, kg/s: as given, or from the superficial velocity and the opening's area.
double moist_mass_flow(Case const& data, InletCase const& inlet);

//! Dry air that enters through all inlets, kg/s.
double dry_inlet_flow(Case const& data);

//! The balance of a case with inlets. Atomising air is another one: all are mixed by enthalpy and humidity; the liquid
//! brings the enthalpy of its water at its temperature, a melt its heat of fusion and what it loses to the temperature
//! of the outlet. Throws base::NumericsError where no dry air flows. Source: physics of adiabatic saturation, drying
//! potential eta = (Y_wb - Y_out) / (Y_wb - Y_in).
Balance balance(Case const& data);
}
