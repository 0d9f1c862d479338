// The granules of a rank in layers, and the layers in strips, so that several steps can be done on a part of the
// granules while it is in the cache.
//
// A layer is thicker than contacts reach: what a granule of layer k does depends on layers k - 1 to k + 1 only. So
// layer k can be moved on by a step as soon as the forces of layer k + 1 are known, whatever the layers behind have
// still to do, and a sweep over the layers carries several steps along, each one layer behind the one before
// (Engine::advance). The state then travels from memory once for all of them. That granules next to other ranks are in
// layer 0 makes the same sweep right with several ranks: what they exchange in a step is known when the sweep begins
// with it.
//
// Where a layer is too wide for the cache, strips across the layers are swept one after the other. In each further step
// of a sweep a strip ends one unit earlier, in whose place the next one begins: units are wider than contacts reach, so
// a strip asks for nothing that those behind it have still to do.
//
// Pairs stand in bins, two per unit: bin 0 has those that can be done when the unit is the last of a strip to be moved,
// bin 1 those with the next unit of the layer before, which may belong to the next strip.
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
    //! Most steps that a sweep may do.
    static constexpr std::size_t most_steps = 6;

    //! Units [first, last) of a layer.
    struct Part
    {
        std::size_t layer, first, last;
    };
    //! Bins or other numbers [begin, end).
    struct Range
    {
        std::size_t begin, end;
    };

    //! Sorts the rows of the frame, of which those behind the owned ones are copies of others', into layers of at least
    //! `reach` (m), and these into strips of no more than about `most_rows` rows where they are wide enough.
    void make(Frame const& frame, Domain const& domain, par::Partition const& partition, int rank, double reach,
              double most_rows = 1000);

    std::size_t count() const { return count_; }
    std::size_t strips() const { return strips_; }
    //! Of all layers.
    std::size_t units() const { return begin_.size() - 1; }
    Part whole(std::size_t layer) const { return {layer, 0, units_}; }
    //! What step `t` of a sweep does of a layer in a strip.
    Part part(std::size_t strip, std::size_t layer, std::size_t t) const
    {
        return {layer, strip == 0 ? 0 : strip * most_steps - t,
                strip + 1 == strips_ ? units_ : (strip + 1) * most_steps - t};
    }

    //! Owned rows of a unit, of a part of a layer.
    std::span<std::uint32_t const> rows(std::size_t unit) const { return rows(Range{unit, unit + 1}); }
    std::span<std::uint32_t const> rows(Part const& part) const { return rows(units(part)); }
    //! Numbers of the units of a part among those of all layers.
    Range units(Part const& part) const { return {part.layer * units_ + part.first, part.layer * units_ + part.last}; }
    std::size_t unit_of(std::uint32_t row) const { return of_row_[row]; }

    std::size_t bins() const { return 2 * units(); }
    //! Where a pair of rows stands.
    std::size_t bin(std::uint32_t row, std::uint32_t other) const
    {
        auto const [before, last] = std::minmax(of_row_[row], of_row_[other]);
        return before / units_ == last / units_ || before % units_ <= last % units_ ? 2 * last : 2 * last + 1;
    }
    //! Bins of the pairs of a part that can be done when it is moved. `alone`: its strip does the layer before alike,
    //! so that pairs with the strip behind are left to that one.
    Range bins(Part const& part, bool alone) const
    {
        auto const [begin, end] = units(part);
        return {2 * begin, 2 * end - (alone && part.last < units_ ? 1 : 0)};
    }
    //! Bins of the pairs that the strip before has left to a part.
    Range bins_left(Part const& part) const
    {
        if (part.first == 0 || part.layer + 1 == count_) return {0, 0};
        std::size_t const left = 2 * ((part.layer + 1) * units_ + part.first - 1) + 1;
        return {left, left + 1};
    }

  private:
    std::span<std::uint32_t const> rows(Range const& units) const
    {
        return {rows_.data() + begin_[units.begin], rows_.data() + begin_[units.end]};
    }

    std::size_t count_ = 0, strips_ = 1, units_ = 1;  // units of a layer
    std::vector<std::uint32_t> of_row_, rows_;
    std::vector<std::size_t> begin_{0};
    std::vector<double> depth_;
};
}
