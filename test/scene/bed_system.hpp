// A pressure system as a bubbling bed makes it: gas moves less easily where granules are.
#pragma once

#include "granum/base/random.hpp"
#include "granum/grid/halo.hpp"
#include "granum/solve/pressure.hpp"

#include <algorithm>
#include <cmath>

namespace granum
{
struct BedSystem
{
    double jump = 10;     //!< how much less the gas of the bed moves
    double noise = 0.3;   //!< from cell to cell
    double share = 0.45;  //!< of the height that the bed fills
    int bubbles = 12;
    bool outlet = true;  //!< at the upper end
    double extra = 0;    //!< in every cell, relative to its links (a compressible gas)
};

//! Numbers follow from cells' places in the whole domain: the same system on any ranks.
inline solve::System bed_system(grid::Grid const& grid, BedSystem const& bed = {})
{
    using math::Vec3;
    Vec3 low, size;
    for (std::size_t d = 0; d < 3; ++d) {
        low[d] = grid.lines[d].front();
        size[d] = grid.lines[d].back() - low[d];
    }
    auto const chance = [&](std::uint64_t what, std::uint32_t which) {
        return base::Random(5, base::Purpose::test, what, which).uniform();
    };
    auto const in_bubble = [&](Vec3 const& x) {
        for (int b = 0; b < bed.bubbles; ++b) {
            auto const id = static_cast<std::uint64_t>(b);
            Vec3 const centre{low.x + chance(id, 1) * size.x, low.y + chance(id, 2) * size.y,
                              low.z + chance(id, 3) * bed.share * size.z};
            if (norm(x - centre) < (0.05 + 0.1 * chance(id, 4)) * std::min(size.y, size.z)) return true;
        }
        return false;
    };
    auto const id = [&](int i, int j, int k) {
        auto const n = grid.global;
        return static_cast<std::uint64_t>(i + grid.shift[0]) +
               static_cast<std::uint64_t>(n[0]) *
                   (static_cast<std::uint64_t>(j + grid.shift[1]) +
                    static_cast<std::uint64_t>(n[1]) * static_cast<std::uint64_t>(k + grid.shift[2]));
    };
    solve::System system(grid);
    auto ease = grid.make_field();
    grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
        Vec3 const x = grid.centre(i, j, k);
        bool const dense = x.z - low.z < bed.share * size.z && !in_bubble(x);
        ease[c] = (dense ? 1 / bed.jump : 1) * (1 + bed.noise * chance(id(i, j, k), 5));
    });
    grid::refresh(grid, {&ease});
    grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
        std::array<int, 3> const cell{i, j, k};
        double links = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            if (cell[d] == 0 && grid.at_end(d, false)) continue;
            double const mean = 0.5 * (ease[c] + ease[grid.before(c, d)]);
            links += system.link[d][c] = mean * grid.open_area[d][c] / grid.axes[d].gap(cell[d]);
        }
        if (!grid.open(c)) return;
        system.extra[c] = bed.extra * links;
        if (bed.outlet && k == grid.n[2] - 1 && grid.at_end(2, true))
            system.extra[c] += 2 * ease[c] * grid.open_area[2][grid.next(c, 2)] / grid.axes[2].width(k);
        bool const bottom = k == 0 && grid.at_end(2, false);
        system.right[c] = (chance(id(i, j, k), 6) - 0.5 + (bottom ? 0.3 : 0)) * grid.open_volume[c];
    });
    grid::refresh(grid, {&system.link[0], &system.link[1], &system.link[2]});
    return system;
}
}
