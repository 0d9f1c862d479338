// Which rank owns which part of space: boxes made by cutting the domain in two, again and again.
//
// A cut divides the ranks that are left in two groups and the space in two parts of as much work as the groups are
// large. No result depends on where the cuts are, so they may move while a run goes on.
#pragma once

#include "granum/math/vec3.hpp"
#include "granum/par/communicator.hpp"
#include "granum/par/slabs.hpp"

#include <array>
#include <span>
#include <vector>

namespace granum::par
{
using math::Vec3;

struct Box
{
    Vec3 lower, upper;  //!< m
};

//! The whole that is cut.
struct Space
{
    Box box;
    std::array<bool, 3> periodic{};
};

class Partition
{
  public:
    //! All of the space belongs to the one rank.
    explicit Partition(Space const& space);
    //! Slabs along x.
    Partition(Space const& space, Slabs const& slabs);
    //! Cuts so that each rank gets about the same sum of `work` of the points (m) that the ranks hold. Work is counted,
    //! never timed; where there is none yet, by length. Given `faces` (m, rising, from end to end of the space, by
    //! direction), cuts lie on them; `second` may then say of each point whether its work is done in the second half of
    //! a step, for which all ranks wait: each half is shared out. Collective.
    static Partition balanced(Space const& space, std::span<Vec3 const> points, std::span<double const> work,
                              Communicator const& comm, std::array<std::vector<double>, 3> const* faces = nullptr,
                              std::vector<bool> const& second = {});

    //! As cuts() told of another one of the same space.
    Partition(Space const& space, std::vector<double> const& cuts);
    std::vector<double> cuts() const;

    int ranks() const { return static_cast<int>(boxes_.size()); }
    Space const& space() const { return space_; }
    Box const& box(int rank) const { return boxes_[static_cast<std::size_t>(rank)]; }
    //! Rank that owns a point of the space; beyond its faces, the rank at the face.
    int owner(Vec3 const& x) const;
    //! How far a point is off the part of a rank along each axis (over periodic faces where that is shorter), m. Parts
    //! at faces that are not periodic reach to infinity.
    Vec3 off(Vec3 const& x, int rank) const;
    //! Squared distance from a point to the part of a rank, m2.
    double distance2(Vec3 const& x, int rank) const { return norm2(off(x, rank)); }
    //! Ranks other than this one whose part comes nearer than `reach` (m).
    std::vector<int> near(int rank, double reach) const;

  private:
    struct Cut
    {
        std::size_t direction = 0;
        double at = 0;              // m
        int first = 0, behind = 0;  // cut to go on with below and from `at` on; -1 - rank where a rank's part begins
    };
    struct Balance;

    Partition() = default;
    void find_boxes(int cut, Box const& box);

    Space space_;
    std::vector<Cut> cuts_;
    std::vector<Box> boxes_;
};
}
