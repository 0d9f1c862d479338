// Which rank owns which cells: a box of them each.
#pragma once

#include "granum/par/partition.hpp"

#include <array>
#include <vector>

namespace granum::grid
{
//! Faces of the cells of the whole domain along x, y and z, m.
using Lines = std::array<std::vector<double>, 3>;

//! Equal cells that fill a box.
Lines uniform_lines(math::Vec3 const& lower, math::Vec3 const& upper, std::array<int, 3> cells);

//! Largest edge of the cell at x, m.
double widest_at(Lines const& lines, math::Vec3 const& x);

//! Cells [lower, upper) by their number in the whole domain.
struct CellBox
{
    std::array<int, 3> lower{}, upper{};

    int size(std::size_t d) const { return upper[d] - lower[d]; }
    long cells() const { return static_cast<long>(size(0)) * size(1) * size(2); }
    bool has(std::array<int, 3> const& cell) const
    {
        for (std::size_t d = 0; d < 3; ++d)
            if (cell[d] < lower[d] || cell[d] >= upper[d]) return false;
        return true;
    }
};

struct Layout
{
    std::array<int, 3> cells{1, 1, 1};  //!< of the whole domain
    std::array<bool, 3> periodic{};
    std::vector<CellBox> boxes;  //!< by rank

    int ranks() const { return static_cast<int>(boxes.size()); }
    CellBox const& box(int rank) const { return boxes[static_cast<std::size_t>(rank)]; }
    //! As box, with the ghosts beyond those ends of the domain that are not periodic: faces there belong to the rank.
    CellBox reach(int rank) const;
};

//! The cells of each part of a partition that was cut on faces of `lines`. Throws NumericsError where it was not, or
//! where a rank is left without cells.
Layout layout(par::Partition const& partition, Lines const& lines);
}
