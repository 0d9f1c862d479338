#include "granum/dem/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::dem
{
void NeighbourSearch::fill_cells(particle::Store const& granules, std::size_t rows, double reach)
{
    auto const& x = granules.position.values;
    double const big = std::numeric_limits<double>::max();
    Vec3 low{big, big, big}, high{-big, -big, -big};
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], x[row][d]);
            high[d] = std::max(high[d], x[row][d]);
        }
    // Cells need not be finer than the granules are many: scattered granules get wider cells.
    Vec3 scale;
    double width = reach;
    for (bool fits = false; !fits; width *= 1.5) {
        double total = 1;
        for (std::size_t d = 0; d < 3; ++d) {
            double const extent = rows > 0 ? high[d] - low[d] : 0;
            double const count = std::max(1.0, std::floor(extent / width));
            total *= count;
            cells_[d] = static_cast<int>(std::min(count, 1e6));
            scale[d] = extent > 0 ? count / extent : 0;
        }
        fits = total <= 4.0 * static_cast<double>(rows) + 64;
    }
    std::size_t const cells =
        static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(cells_[2]);
    cell_of_.resize(rows);
    start_.assign(cells + 1, 0);
    for (std::size_t row = 0; row < rows; ++row) {
        std::array<int, 3> at{};
        for (std::size_t d = 0; d < 3; ++d)
            at[d] = std::min(static_cast<int>((x[row][d] - low[d]) * scale[d]), cells_[d] - 1);
        cell_of_[row] = static_cast<std::uint32_t>((at[2] * cells_[1] + at[1]) * cells_[0] + at[0]);
        ++start_[cell_of_[row] + 1];
    }
    for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
    rows_.resize(rows);
    for (std::size_t row = rows; row-- > 0;) rows_[--start_[cell_of_[row] + 1]] = static_cast<std::uint32_t>(row);
    // The loop above moved every start to its cell's first entry, one place too far to the right.
    std::rotate(start_.begin(), start_.begin() + 1, start_.end());
    start_.back() = static_cast<std::uint32_t>(rows);
}

std::vector<std::uint32_t> NeighbourSearch::sorted_rows(particle::Store const& granules, double reach)
{
    fill_cells(granules, granules.owned, reach);
    return rows_;
}

void NeighbourSearch::pairs(particle::Store const& granules, double reach, double skin, std::vector<PairRows>& out)
{
    fill_cells(granules, granules.rows(), reach);
    out.clear();
    auto const& x = granules.position.values;
    auto const& radius = granules.radius.values;
    auto const& id = granules.id.values;
    auto const consider = [&](std::uint32_t a, std::uint32_t b) {
        if (a >= granules.owned && b >= granules.owned) return;
        double const limit = radius[a] + radius[b] + skin;
        if (norm2(x[a] - x[b]) >= limit * limit || id[a] == id[b]) return;
        out.push_back(id[a] < id[b] ? PairRows{a, b} : PairRows{b, a});
    };
    // Half of the 26 neighbours: each pair of cells is visited from one side.
    constexpr std::array<std::array<int, 3>, 13> half{{{1, 0, 0},
                                                       {-1, 1, 0},
                                                       {0, 1, 0},
                                                       {1, 1, 0},
                                                       {-1, -1, 1},
                                                       {0, -1, 1},
                                                       {1, -1, 1},
                                                       {-1, 0, 1},
                                                       {0, 0, 1},
                                                       {1, 0, 1},
                                                       {-1, 1, 1},
                                                       {0, 1, 1},
                                                       {1, 1, 1}}};
    std::size_t cell = 0;
    for (int k = 0; k < cells_[2]; ++k)
        for (int j = 0; j < cells_[1]; ++j)
            for (int i = 0; i < cells_[0]; ++i, ++cell)
                for (std::uint32_t p = start_[cell]; p < start_[cell + 1]; ++p) {
                    for (std::uint32_t q = p + 1; q < start_[cell + 1]; ++q) consider(rows_[p], rows_[q]);
                    for (auto const& [di, dj, dk] : half) {
                        int const i2 = i + di, j2 = j + dj, k2 = k + dk;
                        if (i2 < 0 || i2 >= cells_[0] || j2 < 0 || j2 >= cells_[1] || k2 >= cells_[2]) continue;
                        auto const other = static_cast<std::size_t>((k2 * cells_[1] + j2) * cells_[0] + i2);
                        for (std::uint32_t q = start_[other]; q < start_[other + 1]; ++q) consider(rows_[p], rows_[q]);
                    }
                }
}
}
