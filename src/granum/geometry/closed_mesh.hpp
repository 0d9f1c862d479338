// A solid whose surface is a closed mesh of triangles.
//
// The sign of a distance is that of the angle to the pseudo-normal of the face, edge or corner that is nearest: of an
// edge the sum of the normals of its faces, of a corner the sum weighted by the angles of its faces there. That is the
// right side for every closed mesh that does not cross itself, however thin or sharp. Source: Baerentzen and Aanaes,
// IEEE Trans. Vis. Comput. Graph. 11 (2005) 243 (recalled).
#pragma once

#include "granum/geometry/bounds.hpp"
#include "granum/geometry/surface_distance.hpp"
#include "granum/geometry/triangle_corners.hpp"
#include "granum/geometry/triangle_tree.hpp"

#include <span>
#include <vector>

namespace granum::geometry
{
class ClosedMesh
{
  public:
    //! The mesh must be good: closed, of one orientation, normals pointing out, no triangle without area (see
    //! inspect_closed).
    explicit ClosedMesh(Corners const& corners);

    SurfaceDistance distance(Vec3 const& x) const;
    //! At once, and at most the true distance in magnitude; 0 near the surface.
    double rough_distance(Vec3 const& x) const;
    Bounds const& bounds() const { return bounds_; }
    double volume() const;  //!< m3
    std::vector<Triangle> const& triangles() const { return triangles_; }

  private:
    struct Facet
    {
        Vec3 corner, first, second, normal;   // a corner, the sides that begin there
        std::array<std::uint32_t, 6> pseudo;  // of its edges a-b, b-c, c-a and its corners a, b, c
    };

    std::vector<Triangle> triangles_;
    std::vector<Facet> facets_;
    std::vector<Vec3> pseudo_normals_;  // unit
    TriangleTree tree_;
    Bounds bounds_;

    //! Distances in the middles of some thousand cubes that fill the bounds.
    struct Rough
    {
        double step = 0;
        std::array<std::size_t, 3> n{};
        std::vector<double> distance;
    } rough_;
    void make_rough();
};
}
