#include "granum/grid/build.hpp"

#include "granum/base/error.hpp"
#include "granum/grid/halo.hpp"
#include "granum/grid/pockets.hpp"

#include <algorithm>

namespace granum::grid
{
namespace
{
// Volumes and areas of solids are good to some thousandths of a cell: what is smaller may not be there.
constexpr double smallest_of_solids = 5e-3;
}

Openness openness(geometry::Chamber const& chamber)
{
    if (auto const region = chamber.region)
        return {.volume = [region](Vec3 const& low, Vec3 const& high) { return open_volume(*region, low, high); },
                .area =
                    [region](std::size_t d, Vec3 const& low, Vec3 const& high, geometry::Beside const& beside) {
                        return open_area(*region, static_cast<int>(d), low, high, beside);
                    },
                .smallest = smallest_of_solids,
                .smallest_face = smallest_of_solids};
    return {.volume = [chamber](Vec3 const& low, Vec3 const& high) { return chamber.open_volume(low, high); },
            .area = [chamber](std::size_t d, Vec3 const& low, Vec3 const& high,
                              geometry::Beside const&) { return chamber.open_area(static_cast<int>(d), low, high); }};
}

Grid frame(Lines const& lines, Layout const& layout, par::Communicator const& comm)
{
    auto const& box = layout.box(comm.rank());
    Grid grid;
    static_cast<Shape&>(grid) = Shape({box.size(0), box.size(1), box.size(2)});
    grid.global = layout.cells;
    grid.shift = box.lower;
    grid.periodic = layout.periodic;
    grid.lines = lines;
    for (std::size_t d = 0; d < 3; ++d) grid.axes[d] = Axis(lines[d], layout.periodic[d], box.lower[d], box.size(d));
    grid.halo = std::make_shared<Halo const>(layout, grid, comm.rank(), comm);
    return grid;
}

Grid build(Openness const& space, Lines const& lines, Layout const& layout, par::Communicator const& comm)
{
    Grid grid = frame(lines, layout, comm);
    grid.open_volume = grid.make_field();
    grid.open_area = grid.make_face_field();
    auto const corner = [&](std::array<int, 3> const& cell, int upper) {
        return Vec3{grid.axes[0].face(cell[0] + upper), grid.axes[1].face(cell[1] + upper),
                    grid.axes[2].face(cell[2] + upper)};
    };
    for_each_cell(grid, [&](int i, int j, int k, Index c) {
        double const open = space.volume(corner({i, j, k}, 0), corner({i, j, k}, 1));
        grid.open_volume[c] = open < space.smallest * grid.volume(i, j, k) ? 0 : open;
    });
    refresh(grid, {&grid.open_volume});

    // A face is open between two open cells; at an end, as far as its one cell is open.
    for (std::size_t d = 0; d < 3; ++d) {
        std::array<int, 3> last{grid.n[0] - 1, grid.n[1] - 1, grid.n[2] - 1};
        if (grid.at_end(d, true)) ++last[d];
        for_each_cell(grid, {0, 0, 0}, last, [&](int i, int j, int k, Index c) {
            std::array<int, 3> const cell{i, j, k};
            bool const low_end = cell[d] == 0 && grid.at_end(d, false);
            bool const high_end = cell[d] == grid.n[d];
            if (!high_end && !grid.open(c)) return;
            if (!low_end && !grid.open(grid.before(c, d))) return;
            geometry::Beside const beside{low_end ? 0 : grid.axes[d].width(cell[d] - 1),
                                          high_end ? 0 : grid.axes[d].width(cell[d])};
            double const full = grid.area(d, cell);
            double const open = std::min(space.area(d, corner(cell, 0), corner(cell, 1), beside), full);
            grid.open_area[d][c] = open < space.smallest_face * full ? 0 : open;
        });
        refresh(grid, {&grid.open_area[d]});
    }
    close_pockets(grid, comm);
    return grid;
}
}
