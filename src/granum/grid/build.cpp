#include "granum/grid/build.hpp"

#include "granum/base/error.hpp"

#include <algorithm>

namespace granum::grid
{
namespace
{
constexpr double smallest_open_fraction = 1e-5;

Vec3 spacing_of(geometry::Chamber const& chamber, std::array<int, 3> cells)
{
    Vec3 const extent = chamber.upper() - chamber.lower();
    return {extent.x / cells[0], extent.y / cells[1], extent.z / cells[2]};
}

//! Open geometry by global index: ends, periodic images and closed slivers are decided here, alike on every rank.
class Cutter
{
  public:
    Cutter(geometry::Chamber const& chamber, std::array<int, 3> cells, std::array<bool, 3> periodic)
        : chamber_(chamber), cells_(cells), periodic_(periodic), spacing_(spacing_of(chamber, cells))
    {
    }

    double volume(std::array<int, 3> cell) const
    {
        if (!wrap(cell)) return 0;
        double const open = chamber_.open_volume(corner(cell, 0), corner(cell, 1));
        return open < smallest_open_fraction * spacing_.x * spacing_.y * spacing_.z ? 0 : open;
    }

    //! Of the lower face of `cell` in `direction`.
    double area(int direction, std::array<int, 3> cell) const
    {
        auto const d = static_cast<std::size_t>(direction);
        std::array<int, 3> below = cell;
        --below[d];
        bool const at_end = !periodic_[d] && (cell[d] == 0 || cell[d] == cells_[d]);
        if (at_end) {
            // Plate and top: open as far as the one cell that has this face.
            if (direction != 2 || volume(cell[2] == 0 ? cell : below) == 0) return 0;
        } else if (volume(cell) == 0 || volume(below) == 0) {
            return 0;
        }
        std::array<int, 3> own = cell;
        for (std::size_t e = 0; e < 3; ++e)
            if (periodic_[e]) own[e] = (own[e] + cells_[e]) % cells_[e];
        return chamber_.open_area(direction, corner(own, 0), corner(own, 1));
    }

  private:
    //! Maps a periodic image to the cell itself; false beyond an end.
    bool wrap(std::array<int, 3>& cell) const
    {
        for (std::size_t d = 0; d < 3; ++d) {
            if (periodic_[d]) cell[d] = (cell[d] + cells_[d]) % cells_[d];
            if (cell[d] < 0 || cell[d] >= cells_[d]) return false;
        }
        return true;
    }
    Vec3 corner(std::array<int, 3> const& cell, int upper) const
    {
        Vec3 const low = chamber_.lower(), high = chamber_.upper();
        Vec3 x;
        for (std::size_t d = 0; d < 3; ++d) {
            int const index = cell[d] + upper;
            x[d] = index == cells_[d] ? high[d] : low[d] + index * spacing_[d];  // the last face exactly at the end
        }
        return x;
    }

    geometry::Chamber const& chamber_;
    std::array<int, 3> cells_;
    std::array<bool, 3> periodic_;
    Vec3 spacing_;
};
}

Grid build(geometry::Chamber const& chamber, std::array<int, 3> cells, std::array<bool, 3> periodic,
           par::Slabs const& slabs, int rank)
{
    base::require(std::min({cells[0], cells[1], cells[2]}) > 0,
                  "gas cells must be at least 1 x 1 x 1, got {} x {} x {}", cells[0], cells[1], cells[2]);
    base::require(slabs.cells() == cells[0], "{} columns of cells are cut among the ranks, the grid has {}",
                  slabs.cells(), cells[0]);
    Grid grid;
    auto const mine = static_cast<std::size_t>(rank);
    grid.shift = slabs.first[mine];
    grid.n = {slabs.first[mine + 1] - slabs.first[mine], cells[1], cells[2]};
    grid.global = cells;
    grid.origin = chamber.lower();
    grid.spacing = spacing_of(chamber, cells);
    grid.periodic = periodic;
    grid.open_volume = grid.make_field();
    grid.open_area = grid.make_face_field();

    Cutter const cutter(chamber, cells, periodic);
    for (int k = -1; k <= grid.n[2]; ++k)
        for (int j = -1; j <= grid.n[1]; ++j)
            for (int i = -1; i <= grid.n[0]; ++i) {
                std::array<int, 3> const cell{i + grid.shift, j, k};
                Index const at = grid.at(i, j, k);
                grid.open_volume[at] = cutter.volume(cell);
                // Beyond an end only the faces at that end itself can be open.
                for (std::size_t d = 0; d < 3; ++d) grid.open_area[d][at] = cutter.area(static_cast<int>(d), cell);
            }
    return grid;
}

std::vector<double> column_weights(geometry::Chamber const& chamber, std::array<int, 3> cells)
{
    Vec3 const low = chamber.lower(), high = chamber.upper(), spacing = spacing_of(chamber, cells);
    std::vector<double> weights;
    for (int i = 0; i < cells[0]; ++i) {
        Vec3 const from{low.x + i * spacing.x, low.y, 0}, to{low.x + (i + 1) * spacing.x, high.y, 0};
        double sum = 0;
        for (int k = 0; k < cells[2]; ++k)
            sum +=
                chamber.open_volume({from.x, from.y, low.z + k * spacing.z}, {to.x, to.y, low.z + (k + 1) * spacing.z});
        weights.push_back(sum);
    }
    return weights;
}
}
