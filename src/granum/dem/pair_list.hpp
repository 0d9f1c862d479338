// The pairs of granules that may touch, with the history of those that do, in the blocks that the kernels work on.
//
// Bin by bin of the layers, pairs that touch or nearly touch when the list is made stand in front: their blocks are
// full of contacts. The others follow; most of their blocks cost a look at eight distances. What a contact remembers is
// carried from list to list by the identity of its partners, so sorting and migration cannot lose it. A pair of which a
// partner belongs to another rank is known on both, each with its own copy of the same history.
#pragma once

#include "granum/dem/layers.hpp"
#include "granum/dem/neighbours.hpp"

#include <array>
#include <functional>
#include <utility>

namespace granum::dem
{
//! What a contact remembers: as many numbers as its laws say, the others zero.
using History = std::array<double, 10>;

class PairList
{
  public:
    //! Number of columns of the histories.
    void shape(std::size_t columns) { columns_ = columns; }

    //! Makes the list of `candidates`, which it swaps for those of the list before. `row_now` says where a row of the
    //! list before is now (Frame::lonely or more: nowhere). Histories of contacts go on; what springs of contacts that
    //! are no candidates any more had stored is added to `lost`.
    void make(Frame const& frame, Layers const& layers, Candidates& candidates,
              std::function<std::uint32_t(std::uint32_t)> const& row_now, std::size_t owned_before,
              kernel::Rules const& rules, kernel::Energy& lost);

    //! Gives a history to a pair, if it is in the list. For contacts that come from another rank or a checkpoint.
    void set(std::uint32_t row, std::uint32_t other, History const& history);

    //! Calls what(low row, high row, history) for every pair that touches.
    template <class What>
    void for_each_touching(What&& what) const
    {
        for (std::size_t b = 0; b < blocks_.size(); ++b)
            for (std::size_t lane = 0; lane < kernel::block; ++lane)
                if ((touching_[b] >> lane & 1) != 0) what(low(b, lane), high(b, lane), history(b, lane));
    }

    //! Adds the forces of the pairs of some bins.
    void run(Layers::Range const& bins, kernel::Kernel const& kernel, kernel::Rules const& rules, Frame& frame,
             kernel::Images const& images, double dt, kernel::Seen& seen);

    std::size_t pairs() const { return pairs_; }
    std::size_t blocks() const { return blocks_.size(); }
    bool empty() const { return blocks_.empty(); }
    std::size_t bytes() const;

    History history(std::size_t b, std::size_t lane) const;
    std::uint32_t low(std::size_t b, std::size_t lane) const { return kernel::row_of(blocks_[b].low[lane]); }
    std::uint32_t high(std::size_t b, std::size_t lane) const { return kernel::row_of(blocks_[b].high[lane]); }
    bool touching(std::size_t b, std::size_t lane) const { return (touching_[b] >> lane & 1) != 0; }

  private:
    void take_known(Frame const& frame, std::function<std::uint32_t(std::uint32_t)> const& row_now,
                    std::size_t owned_before, kernel::Rules const& rules, kernel::Energy& lost);
    void put_history(std::size_t place, double const* history);
    std::size_t find_near(std::uint32_t row, std::uint32_t other) const;

    std::size_t columns_ = 6, pairs_ = 0;
    base::AlignedVector<kernel::PairBlock> blocks_;
    base::AlignedVector<double> history_;
    std::vector<std::uint8_t> touching_;
    std::vector<std::size_t> bin_begin_{0};  // of the bins' blocks
    Candidates candidates_;
    std::vector<std::uint32_t> near_place_, near_next_, far_next_;
    // Contacts on their way from one list to the next.
    std::vector<PairRows> known_;
    std::vector<double> known_history_;  // and the share of this rank in what they store
    bool mixed_ = false;                 // more than one material
};
}
