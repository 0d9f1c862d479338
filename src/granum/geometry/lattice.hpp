// A lattice of cubes over a region: which cubes the wall may go through, the distances at their corners, and where the
// wall crosses their edges.
#pragma once

#include "granum/geometry/planes_point.hpp"
#include "granum/geometry/region.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace granum::geometry
{
//! Number of a corner or cube in each direction.
using Spot = std::array<int, 3>;

class Lattice
{
  public:
    //! Throws base::CaseError for a region without bounds, or more than a few million corners in one direction.
    Lattice(Region const& region, double edge);

    //! Cubes whose middle is nearer to the wall than their corners are, in an order that the region decides.
    std::vector<Spot> const& near_cubes() const { return near_; }

    double edge() const { return edge_; }
    Vec3 place(Spot const& corner) const { return place(corner, {}); }
    //! `within` is counted from the corner in edges.
    Vec3 place(Spot const& corner, Vec3 const& within) const;
    double distance(Spot const& corner);
    bool open(Spot const& corner) { return distance(corner) > 0; }
    //! Where the wall crosses the edge that leads from a corner along an axis, whose ends must be of different kind.
    TangentPlane const& crossing(Spot const& corner, std::size_t axis);

    static std::uint64_t key(Spot const& corner);

  private:
    void look_for_wall(Spot const& low, int cubes);

    Region const& region_;
    double edge_;
    Vec3 origin_;
    Spot cubes_{};
    std::vector<Spot> near_;
    std::unordered_map<std::uint64_t, double> distance_;
    std::unordered_map<std::uint64_t, TangentPlane> crossing_;
};
}
