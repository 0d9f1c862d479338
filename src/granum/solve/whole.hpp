// A small system of several ranks, solved by every rank alone: faster than to wait for each other's messages in every
// iteration, and with the same bits on any number of ranks.
#pragma once

#include "granum/solve/pressure.hpp"

#include <vector>

namespace granum::solve
{
class Whole
{
  public:
    Whole(grid::Grid const& part, par::Communicator const& comm);

    //! As Pressure::solve. Collective.
    Outcome solve(System const& system, Field& x, double tolerance, double floor);

  private:
    grid::Grid const& part_;
    par::Communicator const& comm_;
    par::Communicator self_;
    grid::Grid grid_;  // of all cells, as far as a solver needs to know them
    System system_;
    Field x_;
    Pressure pressure_;
    std::vector<int> counts_;  // numbers by rank
    std::vector<double> mine_, all_;
};
}
