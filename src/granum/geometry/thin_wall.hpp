// Which parts of a face are open to the middles of the cells beside it.
//
// A line leads from the middle of a cell to a place of the face: straight, or around a corner, by stepping away from
// the wall at both ends first. No such line leads through a wall, however thin. So where a face is open only as far as
// both middles reach it, gas passes from cell to cell only where a line within the region does.
#pragma once

#include "granum/geometry/face_area.hpp"

#include <array>
#include <optional>

namespace granum::geometry
{
class ThinWall
{
  public:
    ThinWall(Region const& region, int direction, Vec3 const& low, Vec3 const& high, Beside const& beside);

    //! Whether some of these places of the face are open and both middles see all of those: then nothing thin stands in
    //! the way.
    bool all_seen(std::vector<Sample> const& places) const;
    //! Open area of those sixteenths of the face that both middles reach.
    double reached_area(FaceArea& face) const;

  private:
    static constexpr std::array<double, 3> steps{0.2, 0.5, 0.9};  // away from a wall, in shortest edges of the face

    //! A place in the open and its distance from the wall, m.
    struct Place
    {
        Vec3 at;
        double free;
    };
    struct Cell
    {
        double inwards;  // from the face, +1 or -1
        Place middle;
        std::array<Place, steps.size()> stepped;  // the middle, away from the wall
    };

    Place away(Vec3 const& x, double step) const;
    bool sees(Place const& a, Place const& b) const;
    //! Straight or after a step away from the wall at both ends.
    bool reaches(Cell const& cell, Place const& place) const;
    //! Whether a wall or a seam lies on the face there.
    bool on_wall(Sample const& place) const;
    //! Whether reach(cell, place) holds from both cells for a place of the face.
    template <class Reach>
    bool through(Sample const& from, Reach&& reach) const;
    //! The middle of a part of the face, or the open next to it.
    std::optional<Sample> open_in(FaceArea const& face, Vec3 const& middle, double half_u, double half_v) const;

    Region const& region_;
    std::size_t d_, u_, v_;
    Vec3 low_, high_;
    double shortest_, near_;   // m: of the face's edges; what is nearer lies on the face
    std::vector<Cell> cells_;  // those that have an open place
};
}
