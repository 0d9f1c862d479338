// The granules that may touch a wall, with the history of those that do.
#pragma once

#include "granum/dem/pair_list.hpp"
#include "granum/geometry/wall.hpp"

namespace granum::dem
{
class WallList
{
  public:
    void shape(std::size_t columns) { columns_ = columns; }

    //! Lists the owned granules closer than `skin` (m) to a wall; arguments as PairList::make.
    void make(Frame const& frame, std::vector<geometry::Wall> const& walls, double skin,
              std::function<std::uint32_t(std::uint32_t)> const& row_now);

    //! Gives a history to a granule and a wall, if they are in the list.
    void set(std::uint32_t row, std::uint32_t wall, History const& history);

    template <class What>
    void for_each_touching(What&& what) const
    {
        for (std::size_t k = 0; k < size_; ++k)
            if (touches(k)) what(rows_[k], wall_[k], history(k));
    }

    void run(kernel::Kernel const& kernel, kernel::Rules const& rules, Frame& frame,
             std::vector<geometry::Wall> const& walls, double dt, kernel::Seen& seen);

    Vec3 force() const;  //!< of all walls on the granules at the last run, N
    double take_lost_energy() { return std::exchange(lost_energy_, 0.0); }

    std::size_t size() const { return size_; }
    std::uint32_t row(std::size_t k) const { return rows_[k]; }
    std::uint32_t wall(std::size_t k) const { return wall_[k]; }
    double overlap(std::size_t k) const { return overlap_[k]; }
    Vec3 normal(std::size_t k) const { return {normal_[0][k], normal_[1][k], normal_[2][k]}; }
    bool touches(std::size_t k) const { return (touching_[k / kernel::block] >> (k % kernel::block) & 1) != 0; }
    History history(std::size_t k) const;

  private:
    using Numbers = base::AlignedVector<double>;

    void measure(Frame const& frame, std::vector<geometry::Wall> const& walls);
    std::size_t find(std::uint32_t row, std::uint32_t wall) const;

    std::size_t columns_ = 6, size_ = 0;
    std::vector<std::uint32_t> rows_, wall_;  // sorted by row
    std::vector<std::uint8_t> material_, touching_;
    Numbers history_, overlap_;
    std::array<Numbers, 3> normal_, velocity_, spin_, force_, torque_;
    double lost_energy_ = 0;
};
}
