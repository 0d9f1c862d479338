// How the domain is cut among ranks: slabs of cells along x, granules and cells together.
//
// A slab per rank is the simplest cut that gives each rank a box and two neighbours. The cuts lie on cell faces, so a
// cell and the granules in it always live on one rank. `Slabs` is the only place that knows the cut.
#pragma once

#include <vector>

namespace granum::par
{
struct Slabs
{
    double origin = 0;             //!< lower end of the domain along x, m
    double width = 1;              //!< of one cell along x, m
    bool periodic = false;         //!< along x
    std::vector<int> first{0, 1};  //!< first[r] is the first cell of rank r; first.back() the number of cells

    int ranks() const { return static_cast<int>(first.size()) - 1; }
    int cells() const { return first.back(); }
    double lower(int rank) const { return origin + width * first[static_cast<std::size_t>(rank)]; }
    double upper(int rank) const { return origin + width * first[static_cast<std::size_t>(rank) + 1]; }
    double length() const { return width * cells(); }

    //! Rank beyond the lower (upper) face, or -1 where the domain ends. A periodic domain on one rank returns itself.
    int left(int rank) const { return rank > 0 ? rank - 1 : periodic ? ranks() - 1 : -1; }
    int right(int rank) const { return rank + 1 < ranks() ? rank + 1 : periodic ? 0 : -1; }

    //! Rank that owns coordinate x; beyond the ends, the first and the last (walls keep granules inside).
    int owner(double x) const
    {
        int rank = 0;
        while (rank + 1 < ranks() && x >= upper(rank)) ++rank;
        return rank;
    }

    //! Cuts `cells` into `ranks` slabs of nearly equal summed `weight` (one entry per cell), at least one cell each.
    static Slabs balanced(double origin, double width, bool periodic, std::vector<double> const& weight, int ranks);
};
}
