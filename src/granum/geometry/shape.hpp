// Shapes that walls are made of, and the point of a shape that is nearest to a sphere's centre.
#pragma once

#include "granum/math/vec3.hpp"

#include <array>
#include <variant>
#include <vector>

namespace granum::geometry
{
using math::Vec3;

//! Infinite plane; granules live on the side the normal points to.
struct Plane
{
    Vec3 point, normal;  //!< m, unit
};

//! Where granules live: a centre on the other side of the surface is behind it and is pushed back.
enum class Side
{
    inside,   //!< towards the axis or centre
    outside,  //!< away from it
    both      //!< a thin wall: a centre is pushed to the side on which it is
};

//! Flank of a cylinder or cone about any axis, without its ends.
struct Frustum
{
    Vec3 base;             //!< the point of the axis where it begins, m
    Vec3 axis{0, 0, 1};    //!< unit
    double length = 0;     //!< along the axis, m
    double base_radius{};  //!< m; one of the radii may be 0
    double top_radius{};   //!< m
    Side side = Side::both;
};

//! Flat circular disc, or ring where it has a hole; thin, touched from both sides.
struct Disc
{
    Vec3 centre;           //!< m
    Vec3 normal{0, 0, 1};  //!< unit
    double radius = 0;     //!< m
    double hole = 0;       //!< radius of the hole, m; 0: none
};

//! Surface of a ball.
struct Sphere
{
    Vec3 centre;             //!< m
    double radius = 0;       //!< m
    Side side = Side::both;  //!< inside: towards the centre
};

using Triangle = std::array<Vec3, 3>;  //!< corners, m

//! Triangles; thin, touched from both sides.
struct Mesh
{
    std::vector<Triangle> triangles;
};

using Shape = std::variant<Plane, Frustum, Disc, Sphere, Mesh>;

//! What of a shape is nearest.
enum class Feature
{
    face,
    edge,
    vertex
};

struct Nearest
{
    Vec3 point;       //!< of the shape, m
    Vec3 normal;      //!< unit, to the side on which the sphere belongs
    double distance;  //!< from the point to the centre along the normal, m; negative behind a one-sided face
    Feature feature = Feature::face;
};

//! The six planes of the inside of an axis-aligned box.
std::vector<Shape> box_inside(Vec3 const& lower, Vec3 const& upper);

//! Nearest point of a shape to `centre`. A thin shape (Side::both, disc, triangle) pushes to the side on which the
//! centre is: a run stops long before a centre reaches a wall, so that the nearest side is the side it came from, and
//! no side need be remembered. A centre in the surface itself is given the normal of the face.
Nearest nearest(Plane const& plane, Vec3 const& centre);
Nearest nearest(Frustum const& frustum, Vec3 const& centre);
Nearest nearest(Disc const& disc, Vec3 const& centre);
Nearest nearest(Sphere const& sphere, Vec3 const& centre);
//! `normal` is the unit normal of the triangle, which `triangle_normal` gives.
Nearest nearest(Triangle const& triangle, Vec3 const& normal, Vec3 const& centre);

//! Unit normal by the order of the corners; zero for three corners in a line.
Vec3 triangle_normal(Triangle const& triangle);
}
