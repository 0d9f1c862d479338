// The chamber: a box, or a body of revolution about z given by heights and diameters; what of a cell or face is open.
#pragma once

#include "granum/math/vec3.hpp"

#include <array>
#include <vector>

namespace granum::geometry
{
using math::Vec3;

//! A point of the generatrix of a body of revolution.
struct ProfilePoint
{
    double height;  //!< above the plate, m
    double radius;  //!< m
};

//! Inside of an apparatus. The plate is at z = 0, the outlet at z = `height`.
struct Chamber
{
    enum class Shape
    {
        box,
        revolution
    } shape = Shape::box;
    Vec3 size{1, 1, 1};                 //!< of a box, from (0, 0, 0), m
    std::vector<ProfilePoint> profile;  //!< of a body of revolution about the z axis, heights strictly rising from 0

    double height() const;
    double radius(double z) const;  //!< of a body of revolution at z; constant beyond its ends
    Vec3 lower() const;             //!< corners of the bounding box
    Vec3 upper() const;
    double area(double z) const;                //!< open cross-section, m2
    double volume(double z0, double z1) const;  //!< between two heights, m3
    double volume() const { return volume(0, height()); }
    bool inside(Vec3 const& x, double margin = 0) const;  //!< farther than `margin` from every wall, plate and outlet

    //! Open volume of the axis-aligned box [low, high], m3; exact in the horizontal, five Gauss points in z between
    //! profile points (in a cone to 1e-3 of the box). Boxes that tile a layer share these points, so that their sum is
    //! the layer's volume to round-off.
    double open_volume(Vec3 const& low, Vec3 const& high) const;
    //! Open area of the face of [low, high] with normal `direction`, at low[direction], m2. Exact.
    double open_area(int direction, Vec3 const& low, Vec3 const& high) const;
};

//! Area of the part of the rectangle [x0, x1] x [y0, y1] inside the circle of `radius` about the origin, m2. Exact.
double circle_rectangle_area(double radius, double x0, double x1, double y0, double y1);
}
