// Whether there is room for a sphere between the walls of a case as they stand at the start.
#pragma once

#include "granum/geometry/body_search.hpp"
#include "granum/sim/case.hpp"

#include <vector>

namespace granum::sim
{
class WallRoom
{
  public:
    explicit WallRoom(Case const& data);

    //! True where a sphere (m) lies within the chamber, as far as that is closed, and touches no other wall.
    bool operator()(Vec3 const& centre, double radius);

  private:
    geometry::Chamber chamber_, outline_;  // with and without the bodies in it
    std::vector<geometry::BodySearch> bodies_;
    std::vector<std::uint32_t> facets_;
    geometry::BodySearch::Scratch scratch_;
};
}
