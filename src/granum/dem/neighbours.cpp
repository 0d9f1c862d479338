#include "granum/dem/neighbours.hpp"

#include "granum/math/short_axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace granum::dem
{
namespace
{
double nearest_image(double x, double centre, double length)
{
    return x - length * std::round((x - centre) / length);
}

}

std::array<int, 3> NeighbourSearch::Cells::at(Place const& place) const
{
    std::array<int, 3> out{};
    std::array<double, 3> const x{place.x, place.y, place.z};
    for (std::size_t d = 0; d < 3; ++d)
        out[d] = std::clamp(static_cast<int>((x[d] - lower[d]) * scale[d]), 0, number[d] - 1);
    return out;
}

std::size_t NeighbourSearch::Cells::index(int i, int j, int k) const
{
    return static_cast<std::size_t>(i) * stride[0] + static_cast<std::size_t>(j) * stride[1] +
           static_cast<std::size_t>(k) * stride[2];
}

void NeighbourSearch::fill(Cells& cells, Domain const& domain, std::vector<std::uint32_t> const& rows, double reach)
{
    double const big = std::numeric_limits<double>::max();
    Vec3 low{big, big, big}, high{-big, -big, -big};
    for (auto const row : rows) {
        auto const& p = unsorted_[row];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    if (rows.empty()) low = high = {};
    Vec3 const whole = domain.size();
    // Cells need not be finer than the granules are many: scattered granules get wider cells.
    double width = reach;
    for (bool fits = false; !fits; width *= 1.5) {
        double total = 1;
        for (std::size_t d = 0; d < 3; ++d) {
            double const extent = high[d] - low[d];
            cells.wraps[d] = domain.periodic[d] && extent + width > whole[d];
            double const length = cells.wraps[d] ? whole[d] : extent;
            double const count = std::clamp(std::floor(length / width), 1.0, 1e6);
            total *= count;
            cells.number[d] = static_cast<int>(count);
            cells.scale[d] = length > 0 ? count / length : 0;
            if (cells.wraps[d]) low[d] = std::min(low[d], high[d] - whole[d] * (1 - 1e-12));
            cells.lower[d] = low[d];
        }
        fits = total <= 4.0 * static_cast<double>(rows.size()) + 64;
    }
    Vec3 lengths = high - low;
    for (std::size_t d = 0; d < 3; ++d)
        if (cells.wraps[d]) lengths[d] = whole[d];
    std::size_t count = 1;
    for (auto const d : math::short_axes(lengths)) {
        cells.stride[d] = count;
        count *= static_cast<std::size_t>(cells.number[d]);
    }
    cells.start.assign(count + 1, 0);
    cell_of_.resize(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        auto const at = cells.at(unsorted_[rows[k]]);
        cell_of_[k] = static_cast<std::uint32_t>(cells.index(at[0], at[1], at[2]));
        ++cells.start[cell_of_[k] + 1];
    }
    for (std::size_t c = 0; c < count; ++c) cells.start[c + 1] += cells.start[c];
    std::vector<std::uint32_t> next(cells.start.begin(), cells.start.end() - 1);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        auto const to = cells.begin + next[cell_of_[k]]++;
        rows_[to] = rows[k];
        auto const& from = unsorted_[rows[k]];
        places_[0][to] = from.x, places_[1][to] = from.y, places_[2][to] = from.z, places_[3][to] = from.radius;
    }
}

void NeighbourSearch::place(Frame const& frame, Domain const& domain, Vec3 const& centre)
{
    std::size_t const rows = frame.rows();
    unsorted_.resize(rows);
    for (auto& numbers : places_) numbers.resize(rows + kernel::block);
    rows_.resize(rows);
    Vec3 const whole = domain.size();
    for (std::size_t row = 0; row < rows; ++row) {
        auto const& body = frame.bodies[row];
        std::array<double, 3> x{body.position[0], body.position[1], body.position[2]};
        for (std::size_t d = 0; d < 3; ++d)
            if (domain.periodic[d]) x[d] = nearest_image(x[d], centre[d], whole[d]);
        unsorted_[row] = {x[0], x[1], x[2], body.radius};
    }
}

void NeighbourSearch::classify(Domain const& domain, double skin)
{
    std::size_t const rows = unsorted_.size();
    double largest = 0, smallest = std::numeric_limits<double>::max();
    for (auto const& at : unsorted_) {
        largest = std::max(largest, at.radius);
        smallest = std::min(smallest, at.radius);
    }
    constexpr std::size_t most = 12;
    std::size_t count = 1;
    while (count < most && smallest < largest * std::pow(0.5, static_cast<double>(count))) ++count;
    members_.resize(count);
    for (auto& members : members_) members.clear();
    for (std::size_t row = 0; row < rows; ++row) {
        std::size_t level = 0;
        if (count > 1)
            level = std::min(count - 1, static_cast<std::size_t>(std::log2(largest / unsorted_[row].radius)));
        members_[level].push_back(static_cast<std::uint32_t>(row));
    }
    classes_.resize(count);
    std::size_t begin = 0;
    for (std::size_t level = 0; level < count; ++level) {
        classes_[level].begin = begin;
        classes_[level].radius = largest * std::pow(0.5, static_cast<double>(level));
        fill(classes_[level], domain, members_[level], 2 * classes_[level].radius + skin);
        begin += members_[level].size();
    }
}

// The cells around `at` as spans of places; `half`: of each pair of cells only one sees the other, the own cell not at
// all.
template <class Consider>
void NeighbourSearch::visit(Cells const& cells, std::array<int, 3> const& at, bool half, Consider&& consider) const
{
    // The axis along which cells lie side by side in memory.
    std::size_t const along = cells.stride[0] == 1 ? 0 : cells.stride[1] == 1 ? 1 : 2;
    std::size_t const second = along == 0 ? 1 : 0, third = along == 2 ? 1 : 2;
    auto const run = [&](std::array<int, 3> cell, int first, int last) {  // last is within
        cell[along] = first;
        auto const low = cells.index(cell[0], cell[1], cell[2]);
        consider(Span{cells.start[low], cells.start[low + static_cast<std::size_t>(last - first) + 1]});
    };
    int const n = cells.number[along], i = at[along];
    auto const row_of_cells = [&](std::array<int, 3> const& cell) {
        if (!cells.wraps[along] || (i > 0 && i + 1 < n)) {
            run(cell, std::max(i - 1, 0), std::min(i + 1, n - 1));
        } else if (n <= 3) {
            run(cell, 0, n - 1);
        } else if (i == 0) {
            run(cell, 0, 1);
            run(cell, n - 1, n - 1);
        } else {
            run(cell, 0, 0);
            run(cell, n - 2, n - 1);
        }
    };
    // Steps across, without meeting a cell twice where a periodic direction has few of them.
    auto const steps = [&](std::size_t d) {
        std::array<int, 3> out{-1, 0, 1};
        std::size_t count = 3;
        if (cells.wraps[d] && cells.number[d] == 2) out = {0, 1, 0}, count = 2;
        if (cells.wraps[d] && cells.number[d] == 1) out = {0, 0, 0}, count = 1;
        return std::pair{out, count};
    };
    auto const [steps2, count2] = steps(second);
    auto const [steps3, count3] = steps(third);
    for (std::size_t a = 0; a < count3; ++a)
        for (std::size_t b = 0; b < count2; ++b) {
            int const d3 = steps3[a], d2 = steps2[b];
            if (half && (d3 < 0 || (d3 == 0 && d2 < 0))) continue;
            auto cell = at;
            bool inside = true;
            for (auto const& [d, step] : {std::pair{second, d2}, std::pair{third, d3}}) {
                cell[d] += step;
                if (cell[d] >= 0 && cell[d] < cells.number[d]) continue;
                inside = inside && cells.wraps[d];
                cell[d] = cell[d] < 0 ? cells.number[d] - 1 : 0;
            }
            if (!inside) continue;
            if (!half || d3 != 0 || d2 != 0) {
                row_of_cells(cell);
            } else if (i + 1 < n) {
                run(cell, i + 1, i + 1);
            } else if (cells.wraps[along] && n > 1) {
                run(cell, 0, 0);
            }
        }
}

void NeighbourSearch::find(Frame const& frame, Domain const& domain, Vec3 const& centre, Gaps const& gaps,
                           Candidates& out, kernel::Kernel const& kernel)
{
    place(frame, domain, centre);
    classify(domain, gaps.skin);
    std::size_t const rows = frame.rows(), owned = frame.owned;
    out.near.clear();
    out.far.clear();
    out.near_begin.assign(rows, 0);
    out.near_end.assign(rows, 0);
    seen_near_.resize(rows + kernel::block);
    seen_far_.resize(rows + kernel::block);
    auto const* const id = frame.id.data();
    kernel::Look look{.x = places_[0].data(),
                      .y = places_[1].data(),
                      .z = places_[2].data(),
                      .radius = places_[3].data(),
                      .skin = gaps.skin,
                      .close = gaps.close,
                      .images = domain.images(),
                      .near = seen_near_.data(),
                      .far = seen_far_.data()};
    for (std::size_t level = 0; level < classes_.size(); ++level) {
        auto const& own = classes_[level];
        // With fewer than three cells around a periodic direction a cell meets another from both sides: then all are
        // looked at and the second sight is dropped.
        bool half = true;
        for (std::size_t d = 0; d < 3; ++d) half = half && !(own.wraps[d] && own.number[d] < 3);
        auto const begin = static_cast<std::uint32_t>(own.begin);
        std::size_t const end = own.begin + own.start.back();
        std::size_t cell = 0, cell_end = own.begin;  // the places of a cell follow each other
        for (std::size_t p = own.begin; p < end; ++p) {
            auto const row = rows_[p];
            Place const here{places_[0][p], places_[1][p], places_[2][p], places_[3][p]};
            if (p >= cell_end || level > 0) {
                auto const at = own.at(here);
                cell = own.index(at[0], at[1], at[2]);
                cell_end = own.begin + own.start[cell + 1];
                spans_.assign(1, {0, 0});  // the rest of the own cell
                auto const from = [this](Cells const& cells) {
                    return [this, first = static_cast<std::uint32_t>(cells.begin)](Span span) {
                        if (span.begin < span.end) spans_.push_back({first + span.begin, first + span.end});
                    };
                };
                visit(own, at, half, from(own));
                for (std::size_t coarse = 0; coarse < level; ++coarse)
                    if (classes_[coarse].start.back() > 0)
                        visit(classes_[coarse], classes_[coarse].at(here), false, from(classes_[coarse]));
            }
            if (half) spans_[0] = {static_cast<std::uint32_t>(p + 1), static_cast<std::uint32_t>(cell_end)};
            look.at[0] = here.x, look.at[1] = here.y, look.at[2] = here.z, look.own_radius = here.radius;
            kernel.look(look, spans_.data(), spans_.size());
            out.near_begin[row] = static_cast<std::uint32_t>(out.near.size());
            auto const take = [&](std::uint32_t const* places, std::size_t count, std::vector<PairRows>& list) {
                for (std::size_t k = 0; k < count; ++k) {
                    if (!half && places[k] >= begin && places[k] <= p) continue;
                    auto const other = rows_[places[k]];
                    if (row >= owned && other >= owned) continue;
                    list.push_back(id[row] < id[other] ? PairRows{row, other} : PairRows{other, row});
                }
            };
            take(look.near, look.near_count, out.near);
            take(look.far, look.far_count, out.far);
            out.near_end[row] = static_cast<std::uint32_t>(out.near.size());
        }
    }
    look_ahead(frame, domain, gaps, out.far);
}

std::vector<std::uint32_t> NeighbourSearch::sorted_rows(Frame const& frame, Domain const& domain, Vec3 const& centre,
                                                        double width)
{
    place(frame, domain, centre);
    std::vector<std::uint32_t> all(frame.rows());
    std::iota(all.begin(), all.end(), 0u);
    Cells cells;
    fill(cells, domain, all, width);
    return rows_;
}
}
