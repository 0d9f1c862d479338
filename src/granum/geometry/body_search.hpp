// Where a sphere touches a wall body.
//
// A contact is a point where the distance from the centre to the body has a local minimum: the foot on a face, or a
// point of a convex edge or corner that no face of the same body covers. So a sphere that crosses the seam of two
// coplanar triangles touches one plane; in a reentrant corner it touches each side once; over a convex edge it touches
// the edge. Of contacts whose normals make less than 5 degrees the nearest counts, which on the inside of a finely
// facetted surface keeps the overlap continuous and undoubled.
#pragma once

#include "granum/geometry/body.hpp"
#include "granum/geometry/triangle_tree.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace granum::geometry
{
//! Contacts of one sphere with one body at most; of more the nearest count.
inline constexpr std::size_t most_touches = 4;

class BodySearch
{
  public:
    explicit BodySearch(Body const& body);

    //! Appends the facets (shapes, triangles) that a sphere about `centre` (in the body's frame, m) reaches into.
    void near(Vec3 const& centre, double reach, std::vector<std::uint32_t>& facets) const;

    //! Room for touches() to work in.
    struct Scratch
    {
        struct Candidate
        {
            Nearest at;
            std::uint32_t facet;
        };
        std::vector<Candidate> candidates;
    };

    //! Contacts of the sphere, nearest first, all in the body's frame. `facets` are those that near() found for a
    //! sphere that contains this one. Returns their number.
    std::size_t touches(Vec3 const& centre, double radius, std::span<std::uint32_t const> facets, Scratch& scratch,
                        std::array<Nearest, most_touches>& out) const;

  private:
    Nearest nearest_of(std::uint32_t facet, Vec3 const& centre) const;

    using Smooth = std::variant<Plane, Frustum, Disc, Sphere>;
    std::vector<Smooth> smooth_;  // facets 0 .. smooth_.size()
    std::vector<Triangle> triangles_;
    std::vector<Vec3> normals_;
    TriangleTree tree_;
};
}
