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
    // Half of the 26 neighbours, so that each pair of cells is visited from one side. Cells that follow each other
    // along x hold consecutive entries of rows_: the next cell of the own row, and three cells of each of four other
    // rows.
    constexpr std::array<std::array<int, 2>, 4> half{{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
    auto const start_of = [&](int i, int j, int k) {
        return start_[static_cast<std::size_t>((k * cells_[1] + j) * cells_[0] + i)];
    };
    for (int k = 0; k < cells_[2]; ++k)
        for (int j = 0; j < cells_[1]; ++j)
            for (int i = 0; i < cells_[0]; ++i) {
                auto const begin = start_of(i, j, k), end = start_of(i + 1, j, k);
                if (begin == end) continue;
                int const first = std::max(i - 1, 0), behind = std::min(i + 2, cells_[0]);
                std::array<std::array<std::uint32_t, 2>, 4> runs{};
                for (std::size_t n = 0; n < 4; ++n) {
                    int const j2 = j + half[n][0], k2 = k + half[n][1];
                    if (j2 < 0 || j2 >= cells_[1] || k2 >= cells_[2]) continue;
                    runs[n] = {start_of(first, j2, k2), start_of(behind, j2, k2)};
                }
                auto const own_end = start_of(behind, j, k);
                for (auto p = begin; p < end; ++p) {
                    for (auto q = p + 1; q < own_end; ++q) consider(rows_[p], rows_[q]);
                    for (auto const& [low, high] : runs)
                        for (auto q = low; q < high; ++q) consider(rows_[p], rows_[q]);
                }
            }
}
}
