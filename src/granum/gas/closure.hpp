// What a model of turbulence, or a viscosity that depends on the shear, needs of a step. Private to the room; laminar
// Newtonian gas has none of it.
#pragma once

#include "granum/grid/grid.hpp"

#include <array>
#include <vector>

namespace granum::gas
{
//! Slopes du_d/dx_e of the cells, [d][e], 1/s.
using Gradient = std::array<std::array<grid::Field, 3>, 3>;

struct Closure
{
    grid::Field molecular, eddy;                    //!< Pa s, ghosts filled
    grid::Field width, wall_distance;               //!< m; the latter of models that ask for it
    std::vector<double> wall_viscosity, wall_heat;  //!< by wall piece: Pa s; of conduction, over that of still gas
    grid::Field mass_before;                        //!< at the beginning of the step, kg
    grid::Field made, lost, rate_made, rate_lost;   //!< of the two equations, per mass (law::turbulence::Budget)
    grid::Field granular;                           //!< of `lost`, what granules take, 1/s
    grid::Field fixed_rate;                         //!< of cells at walls; negative elsewhere
    grid::Field spread_energy, spread_rate;         //!< law::turbulence::Spread
};
}
