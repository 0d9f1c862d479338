// From a level whose cells are shared among ranks to the same level whole on every rank.
#pragma once

#include "granum/solve/level.hpp"

namespace granum::solve
{
class Gathering
{
  public:
    Gathering(Level const& parts, par::Communicator const& comm);

    //! Links and extras. Collective.
    void aggregate(Level const& parts, Level& whole);
    //! Right side. Collective.
    void restrict(Level const& parts, Level& whole);
    //! x, ghosts included.
    void prolong(Level const& whole, Level& parts) const;

  private:
    void share(Level const& parts, Values const& from, Level const& whole, Values& to);

    par::Communicator comm_;
    std::vector<int> counts_;  // cells by rank
    std::vector<float> mine_, all_;
};
}
