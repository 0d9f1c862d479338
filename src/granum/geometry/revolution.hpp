// Bodies of revolution: cylinders, cones, tubes and whatever a lathe makes, about any axis.
#pragma once

#include "granum/geometry/bounds.hpp"
#include "granum/geometry/chamber.hpp"
#include "granum/geometry/surface_distance.hpp"

#include <optional>
#include <string>
#include <vector>

namespace granum::geometry
{
//! What a closed outline of straight pieces in the half plane of an axis sweeps when it turns about the axis. The
//! nearest point of the surface lies in the half plane through the point asked for, so that all is plane geometry.
class Revolution
{
  public:
    //! Corners of the outline in order, heights counted along `axis` (unit) from `base`, m. Pieces on the axis are no
    //! surface.
    Revolution(Vec3 const& base, Vec3 const& axis, std::vector<ProfilePoint> outline);

    SurfaceDistance distance(Vec3 const& x) const;
    Bounds bounds() const;
    std::optional<std::string> fault() const;  //!< see fault(Solid)

    Vec3 const& base() const { return base_; }
    Vec3 const& axis() const { return axis_; }
    //! The solid is on the left of its outline where the radius is drawn to the right and the height upwards.
    std::vector<ProfilePoint> const& outline() const { return outline_; }

  private:
    struct Piece
    {
        double radius, height;              // where it begins
        double across, rise;                // to where it ends
        double per_length2;                 // 1 / length^2
        double normal_across, normal_rise;  // unit, out of the solid
        bool surface;                       // not on the axis
    };

    Vec3 base_, axis_;
    std::vector<ProfilePoint> outline_;
    std::vector<Piece> pieces_;
};

Revolution cylinder(Vec3 const& base, Vec3 const& axis, double length, double radius);
Revolution cone_frustum(Vec3 const& base, Vec3 const& axis, double length, double base_radius, double top_radius);
//! A hollow cylinder, open at both ends.
Revolution tube(Vec3 const& base, Vec3 const& axis, double length, double inner_radius, double outer_radius);
//! About the z axis, from heights and radii in rising order, closed by discs at its ends.
Revolution turned(std::vector<ProfilePoint> const& profile);
}
