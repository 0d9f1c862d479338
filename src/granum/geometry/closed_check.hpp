// Whether a mesh is the surface of a solid, and what is wrong with it where it is not.
#pragma once

#include "granum/geometry/triangle_corners.hpp"

#include <span>
#include <string>
#include <vector>

namespace granum::geometry
{
//! A triangle lower than this share of the mesh's size has no area: corners are known to about 1e-7 of the size (single
//! precision), so that its normal would be chance.
inline constexpr double lowest_triangle = 1e-6;

//! Height over the longest side, m.
double triangle_height(Triangle const& triangle);

struct MeshFault
{
    enum class Kind
    {
        no_area,          //!< facets without area
        doubled,          //!< facets with the same corners: a sheet without thickness
        hole,             //!< edges with one facet
        crowded_edge,     //!< edges with more than two facets
        turned_facet,     //!< facets of the other orientation than their neighbours
        one_sided,        //!< no orientation fits, as on a Moebius strip
        no_volume,        //!< a body without thickness
        turned_body,      //!< a body that is inside out where another is not
        body_in_body,     //!< a body within another, both facing outwards
        crossing,         //!< facets that go through each other
        lying_on_another  //!< facets of one plane with a part in common
    } kind;
    std::size_t count;  //!< of facets, holes, edges, bodies or pairs
    std::string what;   //!< what is wrong and where, to be read after the name of the mesh; facets are counted from 1
    std::string hint;   //!< likely fix
};

struct ClosedCheck
{
    std::vector<MeshFault> faults;  //!< none: good
    Corners corners;                //!< joined and, where the whole mesh was inside out, turned
    bool was_inside_out = false;
};

//! Looks at everything that can be looked at: orientation and bodies only where every edge has two facets.
ClosedCheck inspect_closed(std::span<Triangle const> triangles);
}
