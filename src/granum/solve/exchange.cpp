#include "granum/solve/exchange.hpp"

namespace granum::solve
{
Exchange::Exchange(grid::Layout const& layout, grid::Shape const& shape, Index half, int rank,
                   par::Communicator const& comm)
    : comm_(comm)
{
    grid::Halo const halo(layout, shape, rank, comm);
    auto const place = [half](std::uint32_t cell) {
        return (cell >> 1) + (cell & 1) * static_cast<std::uint32_t>(half);
    };

    for (std::size_t k = 0; k < halo.images().size(); ++k) {
        auto const original = halo.originals()[k];
        originals_[original & 1].push_back(place(original));
        images_[original & 1].push_back(place(halo.images()[k]));
    }

    // The colour of a ghost is that of its owner, who tells.
    std::vector<std::vector<double>> told(halo.sides().size()), heard(told.size());
    std::vector<par::Message> messages;
    for (std::size_t s = 0; s < told.size(); ++s) {
        auto const& side = halo.sides()[s];
        for (auto const cell : side.mine) told[s].push_back(cell & 1);
        heard[s].resize(side.ghosts.size());
        messages.push_back({side.rank, told[s], heard[s]});
    }
    comm_.end(comm_.begin(messages));
    for (std::size_t s = 0; s < told.size(); ++s) {
        auto const& side = halo.sides()[s];
        auto& sorted = sides_.emplace_back(Side{side.rank, {}, {}});
        for (auto const cell : side.mine) sorted.mine[cell & 1].push_back(place(cell));
        for (std::size_t k = 0; k < side.ghosts.size(); ++k)
            sorted.ghosts[heard[s][k] > 0.5].push_back(place(side.ghosts[k]));
    }
    out_.resize(sides_.size());
    in_.resize(sides_.size());
}

void Exchange::refresh(Values& field, std::size_t colour) const
{
    std::array<Values*, 1> const fields{&field};
    std::array<std::size_t, 1> const colours{colour};
    refresh(fields, colours);
}

void Exchange::refresh(std::initializer_list<Values*> fields) const
{
    std::array<std::size_t, 2> const colours{0, 1};
    refresh(std::span<Values* const>(fields.begin(), fields.size()), colours);
}

void Exchange::refresh(std::span<Values* const> fields, std::span<std::size_t const> colours) const
{
    if (sides_.empty() && images_[0].empty() && images_[1].empty()) return;
    std::vector<par::Message> messages;
    for (std::size_t s = 0; s < sides_.size(); ++s) {
        auto& out = out_[s];
        out.clear();
        std::size_t expected = 0;
        for (auto const colour : colours) {
            for (Values const* field : fields)
                for (auto const place : sides_[s].mine[colour]) out.push_back((*field)[place]);
            expected += fields.size() * sides_[s].ghosts[colour].size();
        }
        in_[s].resize(expected);
        messages.push_back({sides_[s].rank, out, in_[s]});
    }
    auto const pending = comm_.begin(messages);
    for (auto const colour : colours)
        for (Values* field : fields)
            for (std::size_t k = 0; k < images_[colour].size(); ++k)
                (*field)[images_[colour][k]] = (*field)[originals_[colour][k]];
    comm_.end(pending);
    for (std::size_t s = 0; s < sides_.size(); ++s) {
        auto from = in_[s].begin();
        for (auto const colour : colours)
            for (Values* field : fields)
                for (auto const place : sides_[s].ghosts[colour]) (*field)[place] = static_cast<float>(*from++);
    }
}
}
