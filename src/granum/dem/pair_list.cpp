#include "granum/dem/pair_list.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
using kernel::block;

void PairList::make(Frame const& frame, Candidates const& candidates,
                    std::function<std::uint32_t(std::uint32_t)> const& row_now, std::size_t owned_before)
{
    auto const former_blocks = std::exchange(blocks_, {});
    auto const former_history = std::exchange(history_, {});
    auto const former_touching = std::exchange(touching_, {});
    auto const* const material = frame.material.data();
    mixed_ = std::any_of(material, material + frame.rows(), [&](auto other) { return other != material[0]; });
    near_begin_ = candidates.near_begin;
    near_end_ = candidates.near_end;
    pairs_ = candidates.near.size() + candidates.far.size();
    std::size_t const near_blocks = (candidates.near.size() + block - 1) / block;
    std::size_t const count = near_blocks + (candidates.far.size() + block - 1) / block;
    blocks_.resize(count);
    history_.assign(count * columns_ * block, 0.0);
    touching_.assign(count, 0);
    auto const place = [&](std::vector<PairRows> const& pairs, std::size_t first_block) {
        std::size_t const padded = (pairs.size() + block - 1) / block * block;
        for (std::size_t k = 0; k < padded; ++k) {
            auto& to = blocks_[first_block + k / block];
            bool const real = k < pairs.size();
            to.low[k % block] = kernel::place_of(real ? pairs[k].low : frame.lonely());
            to.high[k % block] = kernel::place_of(real ? pairs[k].high : frame.lonely() + 1);
        }
    };
    place(candidates.near, 0);
    place(candidates.far, near_blocks);

    for (std::size_t b = 0; b < former_blocks.size(); ++b)
        for (std::size_t lane = 0; lane < block; ++lane) {
            if ((former_touching[b] >> lane & 1) == 0) continue;
            auto const low = kernel::row_of(former_blocks[b].low[lane]),
                       high = kernel::row_of(former_blocks[b].high[lane]);
            auto const low_now = row_now(low), high_now = row_now(high);
            auto const* const from = former_history.data() + b * columns_ * block + lane;
            std::size_t const to =
                low_now < frame.rows() && high_now < frame.rows() ? find_near(low_now, high_now) : pairs_;
            if (to == pairs_) {
                // Ended, or gone to another rank, which has a copy.
                bool const here = low_now < frame.owned || high_now < frame.owned;
                double const share = low < owned_before && high < owned_before ? 1.0 : 0.5;
                if (here && columns_ > 6) lost_energy_ += share * from[(columns_ - 1) * block];
                continue;
            }
            double* const target = history_.data() + to / block * columns_ * block + to % block;
            for (std::size_t c = 0; c < columns_; ++c) target[c * block] = from[c * block];
            touching_[to / block] = static_cast<std::uint8_t>(touching_[to / block] | 1u << (to % block));
        }
}

std::size_t PairList::find_near(std::uint32_t row, std::uint32_t other) const
{
    auto const one = kernel::place_of(row), two = kernel::place_of(other);
    for (auto const finder : {row, other})
        for (std::size_t k = near_begin_[finder]; k < near_end_[finder]; ++k) {
            auto const& at = blocks_[k / block];
            auto const low = at.low[k % block], high = at.high[k % block];
            if ((low == one && high == two) || (low == two && high == one)) return k;
        }
    return pairs_;
}

void PairList::set(std::uint32_t row, std::uint32_t other, History const& history)
{
    std::size_t const to = find_near(row, other);
    if (to == pairs_) return;
    for (std::size_t c = 0; c < columns_; ++c) history_[(to / block * columns_ + c) * block + to % block] = history[c];
    touching_[to / block] = static_cast<std::uint8_t>(touching_[to / block] | 1u << (to % block));
}

History PairList::history(std::size_t b, std::size_t lane) const
{
    History out{};
    for (std::size_t c = 0; c < columns_; ++c) out[c] = history_[(b * columns_ + c) * block + lane];
    return out;
}

double PairList::take_lost_energy()
{
    return std::exchange(lost_energy_, 0.0);
}

std::size_t PairList::bytes() const
{
    return blocks_.capacity() * sizeof(kernel::PairBlock) + history_.capacity() * sizeof(double) +
           touching_.capacity() + 4 * (near_begin_.capacity() + near_end_.capacity());
}

void PairList::run(kernel::Kernel const& kernel, kernel::Rules const& rules, Frame& frame, Domain const& domain,
                   double dt, kernel::Seen& seen)
{
    kernel.pairs({.rules = &rules,
                  .bodies = frame.bodies.data(),
                  .material = mixed_ ? frame.material.data() : nullptr,
                  .pairing = frame.rows() > 0 ? frame.material[0] * (rules.materials + 1) : 0,
                  .blocks = blocks_.size(),
                  .pairs = blocks_.data(),
                  .images = domain.images(),
                  .history = history_.data(),
                  .touching = touching_.data(),
                  .owned = frame.owned,
                  .dt = dt},
                 seen);
}
}
