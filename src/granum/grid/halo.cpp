#include "granum/grid/halo.hpp"

#include "granum/base/error.hpp"

#include <algorithm>

namespace granum::grid
{
namespace
{
CellBox grown(CellBox box)
{
    for (std::size_t d = 0; d < 3; ++d) --box.lower[d], ++box.upper[d];
    return box;
}

CellBox shifted(CellBox box, std::array<int, 3> const& by)
{
    for (std::size_t d = 0; d < 3; ++d) box.lower[d] += by[d], box.upper[d] += by[d];
    return box;
}

//! Calls visit(cell) for the cells of `of` in `in` that are not in `without`, x fastest.
template <class Visitor>
void for_common(CellBox const& of, CellBox const& in, CellBox const& without, Visitor&& visit)
{
    CellBox both;
    for (std::size_t d = 0; d < 3; ++d) {
        both.lower[d] = std::max(of.lower[d], in.lower[d]);
        both.upper[d] = std::min(of.upper[d], in.upper[d]);
    }
    std::array<int, 3> cell;
    for (cell[2] = both.lower[2]; cell[2] < both.upper[2]; ++cell[2])
        for (cell[1] = both.lower[1]; cell[1] < both.upper[1]; ++cell[1])
            for (cell[0] = both.lower[0]; cell[0] < both.upper[0]; ++cell[0])
                if (!without.has(cell)) visit(cell);
}
}

Halo::Halo(Layout const& layout, Shape const& shape, int rank, par::Communicator const& comm)
    : layout_(layout), comm_(comm)
{
    base::require(shape.size() < (Index{1} << 32), "{} cells on one rank are more than it can name", shape.size());
    auto const& mine = layout.box(rank);
    auto const local = [&](std::array<int, 3> const& cell) {
        return static_cast<std::uint32_t>(
            shape.at(cell[0] - mine.lower[0], cell[1] - mine.lower[1], cell[2] - mine.lower[2]));
    };
    // All images of a rank's box over periodic faces, in an order that both sides of an exchange know.
    std::vector<std::array<int, 3>> images;
    for (int c = -1; c <= 1; ++c)
        for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a) {
                std::array<int, 3> const sign{a, b, c};
                std::array<int, 3> by{};
                bool there = true;
                for (std::size_t d = 0; d < 3; ++d) {
                    there = there && (sign[d] == 0 || layout.periodic[d]);
                    by[d] = sign[d] * layout.cells[d];
                }
                if (there) images.push_back(by);
            }
    for (int other = 0; other < layout.ranks(); ++other) {
        Side side{other, {}, {}};
        for (auto const& by : images) {
            // What of the other's image I see as ghosts.
            auto const theirs = shifted(layout.reach(other), by);
            bool const self = other == rank;
            if (self && by == std::array<int, 3>{}) continue;
            for_common(grown(mine), theirs, layout.reach(rank), [&](std::array<int, 3> const& cell) {
                if (self) {
                    images_.push_back(local(cell));
                    originals_.push_back(local({cell[0] - by[0], cell[1] - by[1], cell[2] - by[2]}));
                } else {
                    side.ghosts.push_back(local(cell));
                }
            });
            if (self) continue;
            // What the other sees of my cells: its cells at +by are mine at -by, in the order in which it asks.
            for_common(grown(layout.box(other)), shifted(layout.reach(rank), by), layout.reach(other),
                       [&](std::array<int, 3> const& cell) {
                           side.mine.push_back(local({cell[0] - by[0], cell[1] - by[1], cell[2] - by[2]}));
                       });
        }
        if (!side.mine.empty() || !side.ghosts.empty()) sides_.push_back(std::move(side));
    }
    out_.resize(sides_.size());
    in_.resize(sides_.size());
}

void Halo::refresh(std::span<Field* const> fields) const
{
    std::vector<par::Message> messages;
    for (std::size_t s = 0; s < sides_.size(); ++s) {
        auto const& side = sides_[s];
        auto& out = out_[s];
        out.clear();
        for (Field const* field : fields)
            for (auto const cell : side.mine) out.push_back((*field)[cell]);
        in_[s].resize(fields.size() * side.ghosts.size());
        messages.push_back({side.rank, out, in_[s]});
    }
    auto const pending = comm_.begin(messages);
    for (Field* field : fields)
        for (std::size_t k = 0; k < images_.size(); ++k) (*field)[images_[k]] = (*field)[originals_[k]];
    comm_.end(pending);
    for (std::size_t s = 0; s < sides_.size(); ++s) {
        auto from = in_[s].begin();
        for (Field* field : fields)
            for (auto const cell : sides_[s].ghosts) (*field)[cell] = *from++;
    }
}

void Halo::fold(std::span<Field* const> fields) const
{
    std::vector<par::Message> messages;
    for (std::size_t s = 0; s < sides_.size(); ++s) {
        auto const& side = sides_[s];
        auto& out = out_[s];
        out.clear();
        for (Field* field : fields)
            for (auto const cell : side.ghosts) {
                out.push_back((*field)[cell]);
                (*field)[cell] = 0;
            }
        in_[s].resize(fields.size() * side.mine.size());
        messages.push_back({side.rank, out, in_[s]});
    }
    auto const pending = comm_.begin(messages);
    for (Field* field : fields)
        for (std::size_t k = 0; k < images_.size(); ++k) {
            (*field)[originals_[k]] += (*field)[images_[k]];
            (*field)[images_[k]] = 0;
        }
    comm_.end(pending);
    for (std::size_t s = 0; s < sides_.size(); ++s) {
        auto from = in_[s].begin();
        for (Field* field : fields)
            for (auto const cell : sides_[s].mine) (*field)[cell] += *from++;
    }
}

void refresh(Grid const& grid, std::span<Field* const> fields)
{
    grid.halo->refresh(fields);
}

void refresh(Grid const& grid, std::initializer_list<Field*> fields)
{
    grid.halo->refresh(std::span<Field* const>(fields.begin(), fields.size()));
}

void fold(Grid const& grid, std::span<Field* const> fields)
{
    grid.halo->fold(fields);
}
}
