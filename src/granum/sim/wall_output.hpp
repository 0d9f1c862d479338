// What the walls of a run met and where they were: walls.csv, and their surfaces for ParaView.
#pragma once

#include "granum/io/vtk.hpp"
#include "granum/sim/kept_series.hpp"
#include "granum/sim/simulation.hpp"

#include <string>

namespace granum::sim
{
//! The bodies as triangles and quadrangles where they are now; planes are left out. Round shapes have 64 pieces.
io::Surface body_surface(geometry::Body const& body, geometry::Pose const& pose);

//! The chamber and the bodies in it, its outlet open where it is a box or a body of revolution.
io::Surface chamber_walls(Case const& data);

//! Writes on rank 0; every call is collective.
class WallOutput
{
  public:
    WallOutput(std::string folder, Simulation& simulation);

    //! A row of walls.csv: force of the granules on each wall, torque about its origin where it is now.
    void sample();
    //! The walls of the case for ParaView, again for every picture where one moves.
    void picture(int number);

    //! What the files held, and how they go on from there; on rank 0.
    void save(io::Sections& out) const;
    void go_on(io::Sections const& saved);

  private:
    std::string folder_;
    Simulation& simulation_;
    KeptSeries loads_;
    io::Collection surfaces_;
    bool moving_ = false;
};
}
