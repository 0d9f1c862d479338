// Neighbours of the few rows that may go farther than the others before the list is made anew.
#include "granum/dem/neighbours.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
// Adds the pairs that only the further room of one of them brings into reach. Rows with such room are few: each looks
// around in the cells of all classes.
void NeighbourSearch::look_ahead(Frame const& frame, Domain const& domain, Gaps const& gaps,
                                 std::vector<PairRows>& out) const
{
    constexpr double rounding = 1e-12;
    auto const ahead_of = [&](std::size_t row) {
        double const ahead = frame.room(row) - gaps.room;
        return ahead > rounding * gaps.room ? ahead : 0.0;
    };
    std::vector<std::pair<std::uint32_t, double>> ahead;
    double most = 0;
    for (std::uint32_t row = 0; row < frame.rows(); ++row)
        if (double const more = ahead_of(row); more > 0) ahead.push_back({row, more}), most = std::max(most, more);
    Vec3 const whole = domain.size();
    for (auto const& [row, more] : ahead) {
        Place const& here = unsorted_[row];
        std::array<double, 3> const x{here.x, here.y, here.z};
        auto const consider = [&, row = row, more = more](std::size_t p) {
            auto const other = rows_[p];
            double const others = ahead_of(other);
            if (other == row || (row >= frame.owned && other >= frame.owned) || (others > 0 && other < row)) return;
            double distance2 = 0;
            for (std::size_t d = 0; d < 3; ++d) {
                double apart = places_[d][p] - x[d];
                if (domain.periodic[d]) apart -= whole[d] * std::round(apart / whole[d]);
                distance2 += apart * apart;
            }
            double const listed = here.radius + places_[3][p] + gaps.skin, reach = listed + more + others;
            if (distance2 < listed * listed * (1 + rounding) || distance2 >= reach * reach) return;
            out.push_back(frame.id[row] < frame.id[other] ? PairRows{row, other} : PairRows{other, row});
        };
        for (auto const& cells : classes_) {
            double const reach = here.radius + cells.radius + gaps.skin + more + most;
            std::array<int, 3> first{}, count{};
            for (std::size_t d = 0; d < 3; ++d) {
                double const from = std::floor((x[d] - reach - cells.lower[d]) * cells.scale[d]);
                double const to = std::floor((x[d] + reach - cells.lower[d]) * cells.scale[d]);
                int const n = cells.number[d];
                if (cells.wraps[d] && to - from + 1 < n) {
                    first[d] = static_cast<int>(from), count[d] = static_cast<int>(to - from) + 1;
                } else if (cells.wraps[d]) {
                    count[d] = n;
                } else {
                    first[d] = static_cast<int>(std::clamp(from, 0.0, n - 1.0));
                    count[d] = static_cast<int>(std::clamp(to, 0.0, n - 1.0)) - first[d] + 1;
                }
            }
            auto const at = [&](std::size_t d, int step) {
                int const n = cells.number[d];
                return ((first[d] + step) % n + n) % n;
            };
            for (int i = 0; i < count[0]; ++i)
                for (int j = 0; j < count[1]; ++j)
                    for (int k = 0; k < count[2]; ++k) {
                        auto const cell = cells.index(at(0, i), at(1, j), at(2, k));
                        for (std::size_t p = cells.start[cell]; p < cells.start[cell + 1]; ++p)
                            consider(cells.begin + p);
                    }
        }
    }
}
}
