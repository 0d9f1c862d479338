// Open area of a rectangle across one of the axes, without regard to what lies before and behind it.
#pragma once

#include "granum/geometry/open_part.hpp"
#include "granum/geometry/wall_model.hpp"

#include <array>
#include <vector>

namespace granum::geometry
{
//! A wall that is nearer to a face than this lies on it: a ten-thousandth of the shorter edge, m.
double on_face_within(int direction, Vec3 const& low, Vec3 const& high);

class FaceArea
{
  public:
    //! A wall that lies on the face [low, high] closes it.
    FaceArea(Region const& region, int direction, Vec3 const& low, Vec3 const& high);

    //! Of the rectangle about `middle` that reaches `half_u` and `half_v` in the two directions that follow
    //! `direction`.
    double open(Vec3 const& middle, double half_u, double half_v);

    //! Where the distance was taken so far, in the middle and on the first two levels of halving; `at` is counted from
    //! the origin of space.
    std::vector<Sample> const& seen() const { return seen_; }
    //! Moved within the plane of the rectangle.
    Vec3 place(Vec3 const& middle, double u, double v) const;

  private:
    double halved(Vec3 const& middle, double half_u, double half_v, Sample const& own, int level);
    double by_signs(Vec3 const& middle, double half_u, double half_v, std::array<bool, 4> const& corners, int level);
    double crossed(Vec3 const& middle, double half_u, double half_v, std::array<bool, 4> const& corners) const;
    bool open_at(Vec3 const& x) const;
    //! Whether a wall or a seam lies on the face.
    bool on_face(Linear const& plane) const;
    double part_of(WallModel const& model, Vec3 const& half) const;
    Line line(Linear const& plane) const;
    Vec3 half(double half_u, double half_v) const;
    std::array<bool, 4> corners(Vec3 const& middle, double half_u, double half_v) const;

    Region const& region_;
    std::size_t d_, u_, v_;
    double near_;
    std::vector<Sample> seen_;
};
}
