// The granules of a rank in layers, so that several steps can be done on one layer while it is in the cache.
//
// A layer is thicker than contacts reach: what a granule of layer k does depends on layers k - 1 to k + 1 only. So
// layer k can be moved on by a step as soon as the forces of layer k + 1 are known, whatever the layers behind have
// still to do, and a sweep over the layers carries several steps along, each one layer behind the one before
// (Engine::advance). The state then travels from memory once for all of them. That granules next to other ranks are in
// layer 0 makes the same sweep right with several ranks: what they exchange in a step is known when the sweep begins
// with it.
#pragma once

#include "granum/dem/frame.hpp"
#include "granum/par/partition.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace granum::dem
{
class Layers
{
  public:
    //! Sorts the rows of the frame, of which those behind the owned ones are copies of others', into layers of at least
    //! `reach` (m).
    void make(Frame const& frame, Domain const& domain, par::Partition const& partition, int rank, double reach);

    std::size_t count() const { return begin_.size() - 1; }
    //! Owned rows of a layer.
    std::span<std::uint32_t const> rows(std::size_t layer) const
    {
        return {rows_.data() + begin_[layer], rows_.data() + begin_[layer + 1]};
    }
    std::uint32_t of(std::uint32_t row) const { return of_row_[row]; }
    //! The layer in whose pass a pair of rows is done.
    std::uint32_t of(std::uint32_t row, std::uint32_t other) const { return std::max(of_row_[row], of_row_[other]); }

  private:
    std::vector<std::uint32_t> of_row_, rows_;
    std::vector<std::size_t> begin_{0, 0};
    std::vector<double> depth_;
};
}
