// How much of an opening the apparatus and its bodies leave free.
#pragma once

#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"
#include "granum/sim/case.hpp"

namespace granum::sim
{
struct OpeningArea
{
    double nominal;  //!< m2: as stated, or the whole end of the box around the apparatus
    double free;     //!< of it, m2
};

//! To some thousandths of the end, by squares of it. The chamber must have a region.
OpeningArea opening_area(Case const& data, OpeningCase const& opening);

//! Throws base::CaseError for an opening that no open face of the cells belongs to: bodies cut it off. Collective.
void check_openings(Case const& data, grid::Grid const& grid, par::Communicator const& comm);
}
