// What a case implies before anything is run: sizes, speeds, steps, balance and memory.
#pragma once

#include "granum/dem/engine.hpp"
#include "granum/sim/balance.hpp"
#include "granum/sim/case.hpp"

#include <optional>
#include <string>
#include <vector>

namespace granum::sim
{
//! Of memory: fields of a gas cell and the rows of its pressure equation, on all levels (assumed).
constexpr double bytes_of_a_cell = 800;

struct Forecast
{
    double granules = 0;  //!< real granules represented
    long parcels = 0;
    double parcel_diameter = 0;       //!< m
    double bed_height = 0;            //!< m, settled at 60 % solids; 0 where it does not fit or there is no bed
    double plate_velocity = 0;        //!< superficial, m/s
    double minimum_fluidisation = 0;  //!< superficial, m/s, by the case's drag law at voidage 0.42
    double terminal_velocity = 0;     //!< m/s of one granule
    double reynolds = 0;              //!< of a granule at the plate velocity
    double contact_speed = 0;         //!< m/s assumed for the bounds
    double overlap_speed = 0;         //!< m/s assumed for the overlap: what granules of a bed rarely exceed
    double overlap = 0;               //!< over the radius, at that speed
    std::vector<dem::StepBound> bounds;
    double granule_step = 0;  //!< s, of the case or the smallest bound; 0 for hard spheres
    double gas_step = 0;      //!< s, of the case, or from the Courant number 1 of jet and bed and 50 granule steps
    long cells = 0;
    math::Vec3 cell_size;         //!< m
    double cell_over_parcel = 0;  //!< narrowest cell edge over parcel diameter
    std::optional<Balance> balance;
    double memory = 0;  //!< bytes on all ranks
    std::vector<std::string> warnings;
};

//! Height, m, of a settled bed of `mass` kg at 60 % solids; nothing where the chamber is too small for it.
std::optional<double> settled_height(Case const& data);

//! Bounds of the engine on the step for the smallest parcels of the case, at `speed` m/s: the ones a run uses.
std::vector<dem::StepBound> granule_step_bounds(Case const& data, double speed);

//! Relative speed, m/s, that contacts are bounded for: the largest of 1 m/s, the gas at the plate and what granules are
//! given at the start. An assumption: the engine watches the overlaps that really occur.
double expected_contact_speed(Case const& data);

//! Superficial velocity of the gas at the plate, m/s.
double plate_velocity(Case const& data);

//! True where the case has what a balance needs.
bool has_balance(Case const& data);

Forecast forecast(Case const& data, int ranks);
}
