#include "granum/solve/transfer.hpp"

#include "granum/base/vectorised.hpp"
#include "granum/solve/rows.hpp"

#include <algorithm>

namespace granum::solve
{
namespace
{
GRANUM_VECTORISED void add(int count, float weight, float const* __restrict from, float* __restrict to)
{
#pragma GCC ivdep
    for (int m = 0; m < count; ++m) to[m] += weight * from[m];
}

//! Adds to every second of a row, or every second of a row.
GRANUM_VECTORISED void add_spread(int count, float const* __restrict from, float* __restrict to)
{
#pragma GCC ivdep
    for (int m = 0; m < count; ++m) to[2 * m] += from[m];
}
GRANUM_VECTORISED void add_second(int count, float const* __restrict from, float* __restrict to)
{
#pragma GCC ivdep
    for (int m = 0; m < count; ++m) to[m] += from[2 * m];
}

GRANUM_VECTORISED void deal(int count, float const* __restrict row, float* __restrict one, float* __restrict other)
{
    deal_row(count, 1.0f, row, one, other);
}
GRANUM_VECTORISED void join(int count, float const* __restrict one, float const* __restrict other,
                            float* __restrict row)
{
    join_row(count, one, other, row);
}
}

grid::Layout coarser(grid::Layout const& layout, Directions const& paired)
{
    auto out = layout;
    for (std::size_t d = 0; d < 3; ++d) {
        if (!paired[d]) continue;
        out.cells[d] = (layout.cells[d] + 1) / 2;
        for (auto& box : out.boxes) {
            box.lower[d] = (box.lower[d] + 1) / 2;
            box.upper[d] = (box.upper[d] + 1) / 2;
        }
    }
    return out;
}

Transfer::Transfer(Level const& fine, Directions const& paired) : paired_(paired)
{
    for (std::size_t d = 0; d < 3; ++d) {
        int const cells = fine.layout.cells[d], upper = fine.lower[d] + fine.n[d];
        offset_[d] = paired[d] ? fine.lower[d] % 2 : 0;
        behind_[d] = fine.n[d] + (paired[d] && upper % 2 != 0 && upper < cells ? 1 : 0);
        for (auto const& box : fine.layout.boxes)
            split_ = split_ || (paired[d] && box.upper[d] % 2 != 0 && box.upper[d] < cells);
    }
    for (auto& row : rows_) row.resize(static_cast<std::size_t>(fine.n[fine.order[0]]) + 2);
}

Transfer::Children Transfer::children(std::size_t d, int coarse) const
{
    if (!paired_[d]) return {coarse, coarse + 1};
    int const first = offset_[d] + 2 * coarse;
    return {first, std::min(first + 2, behind_[d])};
}

//! The cells of one colour in a row between two local indices.
Transfer::Part Transfer::part_of(Level const& fine, std::size_t colour, Index row, int from, int end) const
{
    int const first = from + static_cast<int>((row + static_cast<Index>(from) + colour) % 2);
    std::size_t const a = fine.order[0];
    return {.place = fine.place(row + static_cast<Index>(first)),
            .count = (end - first + 1) / 2,
            .coarse = paired_[a] ? (first - offset_[a]) >> 1 : first};
}

//! Adds a row of a fine field to a coarse row; of pairs along it, both cells or the first only.
void Transfer::add_row(Level const& fine, Values const& field, Index first, bool both, float weight, float* row)
{
    std::size_t const a = fine.order[0];
    if (paired_[a]) {
        Index const at = first + static_cast<Index>(offset_[a]);
        int const pairs = (behind_[a] - offset_[a]) / 2;
        add((behind_[a] - offset_[a] + 1) / 2, weight, field.data() + fine.place(at), row);
        if (both) add(pairs, weight, field.data() + fine.place(at + 1), row);
    } else {
        auto& whole = rows_.back();
        join(fine.n[a], field.data() + fine.place(first), field.data() + fine.place(first + 1), whole.data());
        add(fine.n[a], weight, whole.data(), row);
    }
}

void Transfer::aggregate(Level const& fine, Level& coarse)
{
    auto const [a, b, c] = fine.order;
    int const n = coarse.n[a];
    if (n == 0) return;
    std::array<int, 3> at{}, child{};
    for (at[c] = 0; at[c] < coarse.n[c]; ++at[c])
        for (at[b] = 0; at[b] < coarse.n[b]; ++at[b]) {
            for (auto& row : rows_) std::fill_n(row.begin(), n, 0.0f);
            auto const layers = children(c, at[c]), lines = children(b, at[b]);
            for (child[c] = layers.first; child[c] < layers.end; ++child[c])
                for (child[b] = lines.first; child[b] < lines.end; ++child[b]) {
                    Index const first = fine.number(child);
                    for (std::size_t const d : fine.order) {
                        bool const inner = d != a && paired_[d] && child[d] != (d == b ? lines : layers).first;
                        if (coarse.idle(d) || inner) continue;
                        add_row(fine, fine.link[d], first, d != a, paired_[d] ? 0.5f : 1.0f, rows_[d].data());
                    }
                    add_row(fine, fine.extra, first, true, 1, rows_[3].data());
                }
            Index const to = coarse.number(at);
            for (std::size_t k = 0; k < 4; ++k) {
                auto& field = k < 3 ? coarse.link[k] : coarse.extra;
                deal(n, rows_[k].data(), field.data() + coarse.place(to), field.data() + coarse.place(to + 1));
            }
        }
}

void Transfer::restrict(Level& fine, Level& coarse, Colours colours)
{
    if (split_)
        for (auto const colour : colours) fine.refresh(fine.residual, colour);
    auto const [a, b, c] = fine.order;
    int const n = coarse.n[a];
    if (n == 0) return;
    auto& row = rows_[0];
    std::array<int, 3> at{}, child{};
    for (at[c] = 0; at[c] < coarse.n[c]; ++at[c])
        for (at[b] = 0; at[b] < coarse.n[b]; ++at[b]) {
            std::fill_n(row.begin(), n, 0.0f);
            auto const layers = children(c, at[c]), lines = children(b, at[b]);
            for (child[c] = layers.first; child[c] < layers.end; ++child[c])
                for (child[b] = lines.first; child[b] < lines.end; ++child[b])
                    for (auto const colour : colours) {
                        auto const part = part_of(fine, colour, fine.number(child), offset_[a], behind_[a]);
                        float const* const from = fine.residual.data() + part.place;
                        if (paired_[a])
                            add(part.count, 1, from, row.data());
                        else
                            add_spread(part.count, from, row.data() + part.coarse);
                    }
            Index const to = coarse.number(at);
            deal(n, row.data(), coarse.right.data() + coarse.place(to), coarse.right.data() + coarse.place(to + 1));
        }
}

void Transfer::prolong(Level& coarse, Level& fine, Colours colours)
{
    if (split_) coarse.refresh(coarse.x, 0);  // colour 1 was refreshed before colour 0 was solved for, last of all
    auto const [a, b, c] = fine.order;
    auto& row = rows_[0];
    std::array<int, 3> at{}, child{};
    at[a] = -offset_[a];
    int const n = coarse.n[a] + offset_[a];
    for (at[c] = -offset_[c]; at[c] < coarse.n[c]; ++at[c])
        for (at[b] = -offset_[b]; at[b] < coarse.n[b]; ++at[b]) {
            Index const from = coarse.number(at);
            join(n, coarse.x.data() + coarse.place(from), coarse.x.data() + coarse.place(from + 1), row.data());
            auto const layers = children(c, at[c]), lines = children(b, at[b]);
            for (child[c] = std::max(layers.first, 0); child[c] < std::min(layers.end, fine.n[c]); ++child[c])
                for (child[b] = std::max(lines.first, 0); child[b] < std::min(lines.end, fine.n[b]); ++child[b])
                    for (auto const colour : colours) {
                        auto const part = part_of(fine, colour, fine.number(child), 0, fine.n[a]);
                        float* const to = fine.x.data() + part.place;
                        float const* const correction = row.data() + part.coarse + offset_[a];
                        if (paired_[a])
                            add(part.count, 1, correction, to);
                        else
                            add_second(part.count, correction, to);
                    }
        }
}
}
