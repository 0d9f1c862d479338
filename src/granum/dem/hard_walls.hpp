// When a hard sphere meets a wall, and how it touches it then.
//
// A plane is met by a root of a quadratic, a cylinder or cone by one of a quartic. Rims that stick into the room, and
// any other surface that can tell its distance, are approached by steps that cannot pass through them.
#pragma once

#include "granum/dem/hard_state.hpp"
#include "granum/geometry/body.hpp"
#include "granum/geometry/wall.hpp"

namespace granum::dem
{
class HardWalls
{
  public:
    //! Throws NumericsError for a body that hard spheres cannot meet: one that moves, or of other shapes than planes
    //! and the insides of cylinders and cones about the z axis.
    explicit HardWalls(std::vector<geometry::Body> const& bodies);

    std::size_t size() const { return walls_.size(); }
    std::uint32_t material(std::size_t wall) const { return walls_[wall].material; }
    //! Number of the body that the wall is a part of.
    std::size_t body(std::size_t wall) const { return body_[wall]; }

    //! Seconds, at most `longest`, until a sphere at x with velocity v and acceleration a begins to press on the wall;
    //! math::never if it does not.
    double meeting(std::size_t wall, Vec3 const& x, Vec3 const& v, Vec3 const& a, double radius, double longest) const;

    //! Distance and normal for a sphere centre that is within two radii of the wall.
    std::optional<geometry::Touch> touch(std::size_t wall, Vec3 const& x, double radius) const
    {
        return geometry::touch(walls_[wall].surface, x, 2 * radius);
    }

    //! How fast the wall bends towards a sphere that slides along it, 1/m: speed squared times this is the acceleration
    //! with which the gap closes.
    double curvature(std::size_t wall, Vec3 const& x, geometry::Touch const& touch) const;

    //! Some wall is curved, so that `meeting` needs a finite `longest`.
    bool curved() const { return curved_; }

  private:
    double step_towards(std::size_t wall, Vec3 const& x, Vec3 const& v, Vec3 const& a, double radius,
                        double longest) const;

    std::vector<geometry::Wall> walls_;
    std::vector<std::size_t> body_;  // of each
    std::vector<bool> rim_;          // a section of which an end can be touched
    bool curved_ = false;
};
}
