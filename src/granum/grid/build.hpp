// Cuts the chamber into the gas cells of a rank.
#pragma once

#include "granum/geometry/chamber.hpp"
#include "granum/grid/grid.hpp"
#include "granum/par/slabs.hpp"

namespace granum::grid
{
//! The cells of `rank`: the chamber's bounding box cut into `cells`, with open volumes and areas, ghosts included.
//! Ghosts beyond an end that is not periodic are closed; plate and top faces keep their open area. A cell with less
//! than 1e-5 of its volume open is closed with its faces. Periodic directions need a box.
Grid build(geometry::Chamber const& chamber, std::array<int, 3> cells, std::array<bool, 3> periodic,
           par::Slabs const& slabs, int rank);

//! Open volume of each layer of cells across x, m3: the weights for par::Slabs::balanced.
std::vector<double> column_weights(geometry::Chamber const& chamber, std::array<int, 3> cells);
}
