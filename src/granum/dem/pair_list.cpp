#include "granum/dem/pair_list.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace granum::dem
{
using kernel::block;

namespace
{
constexpr std::size_t nowhere = ~std::size_t{0};

// Fills without ever holding the old and a larger new piece of memory at once.
template <class Vector>
void refill(Vector& numbers, std::size_t count, typename Vector::value_type const& value)
{
    if (count > numbers.capacity()) {
        numbers = {};
        numbers.reserve(count + count / 16);
    }
    numbers.assign(count, value);
}
}

void PairList::make(Frame const& frame, Layers const& layers, Candidates& candidates,
                    std::function<std::uint32_t(std::uint32_t)> const& row_now, std::size_t owned_before,
                    kernel::Rules const& rules, kernel::Energy& lost)
{
    take_known(frame, row_now, owned_before, rules, lost);
    auto const* const material = frame.material.data();
    mixed_ = std::any_of(material, material + frame.rows(), [&](auto other) { return other != material[0]; });
    std::swap(candidates_, candidates);
    auto const &near = candidates_.near, &far = candidates_.far;
    pairs_ = near.size() + far.size();

    std::size_t const count = layers.bins();
    near_next_.assign(count, 0);
    far_next_.assign(count, 0);
    for (auto const& pair : near) ++near_next_[layers.bin(pair.low, pair.high)];
    for (auto const& pair : far) ++far_next_[layers.bin(pair.low, pair.high)];
    bin_begin_.assign(1, 0);
    for (std::size_t bin = 0; bin < count; ++bin) {
        std::size_t const near_blocks = (near_next_[bin] + block - 1) / block,
                          far_blocks = (far_next_[bin] + block - 1) / block, first = bin_begin_.back();
        near_next_[bin] = static_cast<std::uint32_t>(first * block);
        far_next_[bin] = static_cast<std::uint32_t>((first + near_blocks) * block);
        bin_begin_.push_back(first + near_blocks + far_blocks);
    }
    std::size_t const blocks = bin_begin_.back();
    kernel::PairBlock lonely;
    std::fill_n(lonely.low, block, kernel::place_of(frame.lonely()));
    std::fill_n(lonely.high, block, kernel::place_of(frame.lonely() + 1));
    refill(blocks_, blocks, lonely);
    refill(history_, blocks * columns_ * block, 0.0);
    touching_.assign(blocks, 0);
    auto const put = [&](PairRows const& pair, std::uint32_t place) {
        auto& to = blocks_[place / block];
        to.low[place % block] = kernel::place_of(pair.low);
        to.high[place % block] = kernel::place_of(pair.high);
        return place;
    };
    near_place_.resize(near.size());
    for (std::size_t k = 0; k < near.size(); ++k)
        near_place_[k] = put(near[k], near_next_[layers.bin(near[k].low, near[k].high)]++);
    for (auto const& pair : far) put(pair, far_next_[layers.bin(pair.low, pair.high)]++);

    for (std::size_t k = 0; k < known_.size(); ++k) {
        double const* const history = known_history_.data() + k * (columns_ + 1);
        if (std::size_t const place = find_near(known_[k].low, known_[k].high); place != nowhere)
            put_history(place, history);
        else if (rules.ledger)
            lost.add(rules, history[columns_ - 1], history[columns_]);
    }
}

// Takes the contacts out of the list, with the rows that their partners have now.
void PairList::take_known(Frame const& frame, std::function<std::uint32_t(std::uint32_t)> const& row_now,
                          std::size_t owned_before, kernel::Rules const& rules, kernel::Energy& lost)
{
    known_.clear();
    known_history_.clear();
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        for (unsigned touching = touching_[b]; touching != 0; touching &= touching - 1) {
            auto const lane = static_cast<std::size_t>(std::countr_zero(touching));
            auto const before_low = low(b, lane), before_high = high(b, lane);
            auto const low_now = row_now(before_low), high_now = row_now(before_high);
            // Energies of a pair that two ranks had are counted by halves.
            double const share = before_low < owned_before && before_high < owned_before ? 1.0 : 0.5;
            double const* const from = history_.data() + b * columns_ * block + lane;
            if (low_now >= frame.owned && high_now >= frame.owned) continue;  // both gone to other ranks, with a copy
            if (low_now < frame.rows() && high_now < frame.rows()) {
                known_.push_back({low_now, high_now});
                for (std::size_t c = 0; c < columns_; ++c) known_history_.push_back(from[c * block]);
                known_history_.push_back(share);
            } else if (rules.ledger) {
                lost.add(rules, from[(columns_ - 1) * block], share);
            }
        }
}

void PairList::put_history(std::size_t place, double const* history)
{
    std::size_t const b = place / block, lane = place % block;
    for (std::size_t c = 0; c < columns_; ++c) history_[(b * columns_ + c) * block + lane] = history[c];
    touching_[b] = static_cast<std::uint8_t>(touching_[b] | 1u << lane);
}

std::size_t PairList::find_near(std::uint32_t row, std::uint32_t other) const
{
    auto const& near = candidates_.near;
    for (auto const finder : {row, other})
        for (std::size_t k = candidates_.near_begin[finder]; k < candidates_.near_end[finder]; ++k)
            if ((near[k].low == row && near[k].high == other) || (near[k].low == other && near[k].high == row))
                return near_place_[k];
    return nowhere;
}

void PairList::set(std::uint32_t row, std::uint32_t other, History const& history)
{
    if (std::size_t const place = find_near(row, other); place != nowhere) put_history(place, history.data());
}

History PairList::history(std::size_t b, std::size_t lane) const
{
    History out{};
    for (std::size_t c = 0; c < columns_; ++c) out[c] = history_[(b * columns_ + c) * block + lane];
    return out;
}

std::size_t PairList::bytes() const
{
    return blocks_.capacity() * sizeof(kernel::PairBlock) + touching_.capacity() +
           sizeof(double) * (history_.capacity() + known_history_.capacity()) +
           sizeof(PairRows) * (candidates_.near.capacity() + candidates_.far.capacity() + known_.capacity()) +
           4 * (candidates_.near_begin.capacity() + candidates_.near_end.capacity() + near_place_.capacity());
}

void PairList::run(Layers::Range const& bins, kernel::Kernel const& kernel, kernel::Rules const& rules, Frame& frame,
                   kernel::Images const& images, double dt, kernel::Seen& seen)
{
    std::size_t const first = bin_begin_[bins.begin], blocks = bin_begin_[bins.end] - first;
    if (blocks == 0) return;
    kernel.pairs({.rules = &rules,
                  .bodies = frame.bodies.data(),
                  .material = mixed_ ? frame.material.data() : nullptr,
                  .pairing = frame.material[0] * (rules.materials + 1),
                  .blocks = blocks,
                  .pairs = blocks_.data() + first,
                  .images = images,
                  .history = history_.data() + first * columns_ * block,
                  .touching = touching_.data() + first,
                  .owned = frame.owned,
                  .dt = dt,
                  .collisions = frame.counted()},
                 seen);
}
}
