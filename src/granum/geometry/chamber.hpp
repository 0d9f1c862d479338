// The chamber: a box, a body of revolution about z given by heights and diameters, or what solids leave open; the
// bodies that stand in it; what of a cell or face is open.
#pragma once

#include "granum/math/vec3.hpp"

#include <array>
#include <memory>
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

class Region;

//! Open volume of a region by height, for what asks often.
struct Levels
{
    double bottom = 0, top = 0;  //!< m
    std::vector<double> below;   //!< m3 below equally spaced heights, from bottom to top
    double plate = 0;            //!< open area at the bottom, m2
    double outlet = 0;           //!< at the top, m2
};

//! Inside of an apparatus. The plate is at z = `bottom`, the outlet at z = `top`.
struct Chamber
{
    enum class Shape
    {
        box,
        revolution,
        solids
    } shape = Shape::box;
    Vec3 size{1, 1, 1};                 //!< of a box, from (0, 0, 0), m
    std::vector<ProfilePoint> profile;  //!< of a body of revolution about the z axis, heights strictly rising from 0
    //! What is open: in a chamber of solids, and where bodies stand in a box or in a body of revolution (see
    //! bodies_in_chamber.hpp). Else nothing.
    std::shared_ptr<Region const> region{};
    std::shared_ptr<Levels const> levels{};  //!< of the region

    //! False for solids that could not be read.
    bool known() const { return shape != Shape::solids || region; }
    double bottom() const { return lower().z; }
    double top() const { return upper().z; }
    double height() const { return top() - bottom(); }
    double radius(double z) const;  //!< of a body of revolution at z; constant beyond its ends
    Vec3 lower() const;             //!< corners of the bounding box
    Vec3 upper() const;
    double area(double z) const;                //!< open cross-section, m2; of a region to a part in a thousand or so
    double volume(double z0, double z1) const;  //!< between two heights, m3; of a region likewise
    double volume() const { return volume(bottom(), top()); }
    bool inside(Vec3 const& x, double margin = 0) const;  //!< farther than `margin` from every wall, plate and outlet
    //! Whether a body of the region stands between two places inside.
    bool parted(Vec3 const& a, Vec3 const& b) const;

    //! Without the bodies that stand in it, and not of solids: open volume of the axis-aligned box [low, high], m3;
    //! exact in the horizontal, five Gauss points in z between profile points (in a cone to 1e-3 of the box). Boxes
    //! that tile a layer share these points, so that their sum is the layer's volume to round-off.
    double open_volume(Vec3 const& low, Vec3 const& high) const;
    //! Likewise: open area of the face of [low, high] with normal `direction`, at low[direction], m2. Exact.
    double open_area(int direction, Vec3 const& low, Vec3 const& high) const;
};

//! Area of the part of the rectangle [x0, x1] x [y0, y1] inside the circle of `radius` about the origin, m2. Exact.
double circle_rectangle_area(double radius, double x0, double x1, double y0, double y1);
}
