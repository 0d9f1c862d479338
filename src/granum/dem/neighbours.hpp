// Who may touch whom until the list is made anew: a search over grids of cells, one grid per class of size.
//
// Granules of very different size in one grid would fill its cells with thousands of the small ones. Classes halve the
// radius from one to the next; a granule looks for its own kind in the grid of its class, and for larger ones in
// theirs.
#pragma once

#include "granum/dem/frame.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace granum::dem
{
//! Candidate pair: rows of the partner with the lower and of that with the higher id.
struct PairRows
{
    std::uint32_t low, high;
};

//! Candidates in two lists, each grouped by the row that found them: those that touch or nearly do, and the others.
struct Candidates
{
    std::vector<PairRows> near, far;
    std::vector<std::uint32_t> near_begin;  //!< near[near_begin[row] .. near_end[row]) were found by `row`
    std::vector<std::uint32_t> near_end;
};

//! How far apart surfaces of pairs may be, m.
struct Gaps
{
    double skin;   //!< of all pairs, and as much more as a row has more room than `room`
    double close;  //!< of those that are near
    double room;   //!< what rows have at least (Frame::room)
};

class NeighbourSearch
{
  public:
    //! All pairs of rows with at least one owned whose surfaces are closer than the gaps. Two images of one granule are
    //! no pair. `centre` is a point of the region that this rank owns: in periodic directions a row counts where its
    //! image is nearest to it.
    void find(Frame const& frame, Domain const& domain, Vec3 const& centre, Gaps const& gaps, Candidates& out,
              kernel::Kernel const& kernel);

    //! Rows cell by cell, cells as wide as `width` (m): neighbours in space become neighbours in memory.
    std::vector<std::uint32_t> sorted_rows(Frame const& frame, Domain const& domain, Vec3 const& centre, double width);

  private:
    struct Place
    {
        double x, y, z, radius;
    };
    struct Cells
    {
        Vec3 lower, scale;
        std::array<int, 3> number{1, 1, 1};
        std::array<bool, 3> wraps{};
        std::array<std::size_t, 3> stride{};  // the longest side has the largest stride
        std::size_t begin = 0;                // of this class in rows_ and places_
        double radius = 0;                    // of the largest that it is for, m
        std::vector<std::uint32_t> start;     // start[c] .. start[c + 1] lie in cell c, counted from `begin`

        std::array<int, 3> at(Place const& place) const;
        std::size_t index(int i, int j, int k) const;
    };
    using Span = kernel::Span;

    void place(Frame const& frame, Domain const& domain, Vec3 const& centre);
    void classify(Domain const& domain, double skin);
    void fill(Cells& cells, Domain const& domain, std::vector<std::uint32_t> const& rows, double width);
    void look_ahead(Frame const& frame, Domain const& domain, Gaps const& gaps, std::vector<PairRows>& out) const;
    template <class Consider>
    void visit(Cells const& cells, std::array<int, 3> const& at, bool half, Consider&& consider) const;

    std::vector<Cells> classes_;
    std::vector<Place> unsorted_;
    std::array<std::vector<double>, 4> places_;  // x, y, z and radius, sorted by class and cell
    std::vector<Span> spans_;
    std::vector<std::uint32_t> seen_near_, seen_far_;
    std::vector<std::uint32_t> rows_, cell_of_;
    std::vector<std::vector<std::uint32_t>> members_;
};
}
