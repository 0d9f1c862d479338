// Cuts space into the gas cells of a rank.
#pragma once

#include "granum/geometry/chamber.hpp"
#include "granum/geometry/open_part.hpp"
#include "granum/grid/grid.hpp"
#include "granum/par/communicator.hpp"

#include <functional>

namespace granum::grid
{
//! What of space is open to gas and granules. The domain is the box that `lines` span.
struct Openness
{
    //! Open volume of the box [low, high], m3.
    std::function<double(Vec3 const& low, Vec3 const& high)> volume;
    //! Open area of the rectangle across `direction` at low[direction] of the box [low, high] between two cells, m2.
    std::function<double(std::size_t direction, Vec3 const& low, Vec3 const& high, geometry::Beside const& beside)>
        area;
    double smallest = 1e-5;    //!< open share of a cell below which it is closed
    double smallest_face = 0;  //!< of a face
};

Openness openness(geometry::Chamber const& chamber);

//! The cells of this rank without open volumes and areas. Collective.
Grid frame(Lines const& lines, Layout const& layout, par::Communicator const& comm);

//! The cells of this rank, with open volumes and areas, ghosts included. Ghosts beyond an end that is not periodic are
//! closed; faces at such an end are as open as the geometry says. A cell with too little open is closed with its faces,
//! and so is what no open face connects to the largest connected part of the domain: gas there had nowhere to go.
//! Collective.
Grid build(Openness const& space, Lines const& lines, Layout const& layout, par::Communicator const& comm);
}
