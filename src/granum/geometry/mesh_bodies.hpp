// The bodies that a closed mesh is made of: pieces of surface without an edge in common.
#pragma once

#include "granum/geometry/triangle_corners.hpp"

#include <cstddef>
#include <vector>

namespace granum::geometry
{
struct MeshBody
{
    std::size_t facets = 0;
    std::size_t first = 0;   //!< lowest number of its facets
    double volume = 0;       //!< m3; negative where its facets face inwards
    double area = 0;         //!< m2
    int depth = 0;           //!< how many other bodies it lies in
    std::size_t around = 0;  //!< one of those

    //! An outer surface faces outwards, that of a cavity inwards.
    bool faces_right() const { return (volume > 0) == (depth % 2 == 0); }
};

struct MeshBodies
{
    std::vector<MeshBody> bodies;
    std::vector<std::uint32_t> of;  //!< body of each facet
};

//! All edges must have two facets of the same orientation.
MeshBodies find_bodies(Corners const& corners, Edges const& edges);
}
