// Between parcels and cells: one set of weights spreads what a parcel gives to its cells and gathers what it sees.
//
// Weights sum to one, closed cells get none: nothing is ever lost. Spreading and gathering with the same weights (and
// the same smoothing) are adjoint, so what the gas gives is what parcels get. Three schemes:
//   kernel   trilinear about the cell centres, times the open fraction of each cell: a uniform suspension maps to a
//            uniform voidage along a cut wall;
//   centre   all to the cell in which the parcel's centre lies;
//   divided  to each cell the part of the parcel that lies in it.
//
// The optional smoothing is a diffusion over the open faces (physics.md 3.4 d): conservative, symmetric, explicit in as
// many passes as stability asks for.
#pragma once

#include "granum/base/aligned.hpp"
#include "granum/grid/halo.hpp"
#include "granum/particle/store.hpp"

#include <span>

namespace granum::coupling
{
using grid::Field;
using grid::Grid;
using grid::Index;
using math::Vec3;

enum class Scheme
{
    kernel,
    centre,
    divided
};

//! The eight cells from `base` on and their weights, which sum to one (all zero for a point with no open cell around
//! it).
struct Stencil
{
    std::uint32_t base = 0;
    std::array<double, 8> weight{};
};

//! Eight numbers per cell, side by side in memory.
using Bundle = base::AlignedVector<std::array<double, 8>>;

class Mapping
{
  public:
    //! `width` (m): the standard deviation that the weights of a parcel are to have along each direction at least, far
    //! from walls. Smoothing makes up for what they lack; 0 switches it off.
    Mapping(Grid const& grid, par::Communicator const& comm, double width, Scheme scheme = Scheme::kernel);

    //! Of a point; `radius` (m) is that of the parcel, which `divided` asks for.
    Stencil stencil(Vec3 const& position, double radius = 0) const;

    //! Finds the stencils of all owned granules; valid until rows change.
    void locate(particle::Store const& granules);
    std::span<Stencil const> stencils() const { return stencils_; }

    //! The owned rows of `locate` by cell, the direction fastest in which they reach least far, as they lie in memory,
    //! and, within a cell, by identity: sums taken in this order do not depend on the order in memory, so a run that
    //! was continued, whose rows lie elsewhere, has the same bits.
    std::span<std::uint32_t const> order() const { return order_; }

    //! Cell s of a stencil.
    Index cell(Stencil const& stencil, std::size_t s) const
    {
        return static_cast<Index>(static_cast<std::ptrdiff_t>(stencil.base) + offset_[s]);
    }
    //! Adds amount * weight to the cells; call `finish` after the last one.
    void spread(Stencil const& stencil, double amount, Field& field) const
    {
        for (std::size_t s = 0; s < 8; ++s) field[cell(stencil, s)] += amount * stencil.weight[s];
    }
    double gather(Stencil const& stencil, Field const& field) const
    {
        double sum = 0;
        for (std::size_t s = 0; s < 8; ++s) sum += field[cell(stencil, s)] * stencil.weight[s];
        return sum;
    }
    Vec3 gather(Stencil const& stencil, std::array<Field, 3> const& field) const
    {
        return {gather(stencil, field[0]), gather(stencil, field[1]), gather(stencil, field[2])};
    }
    //! @{ The same for eight numbers at once.
    void spread(Stencil const& stencil, std::array<double, 8> const& amount, Bundle& cells) const
    {
        for (std::size_t s = 0; s < 8; ++s) {
            auto& to = cells[cell(stencil, s)];
            for (std::size_t k = 0; k < 8; ++k) to[k] += amount[k] * stencil.weight[s];
        }
    }
    std::array<double, 8> gather(Stencil const& stencil, Bundle const& cells) const
    {
        std::array<double, 8> sum{};
        for (std::size_t s = 0; s < 8; ++s) {
            auto const& from = cells[cell(stencil, s)];
            for (std::size_t k = 0; k < 8; ++k) sum[k] += from[k] * stencil.weight[s];
        }
        return sum;
    }
    Bundle make_bundle() const { return Bundle(grid_.size()); }
    //! Puts fields side by side; nothing: zeros.
    void bundle(std::array<Field const*, 8> const& fields, Bundle& out) const;
    //! Adds a bundle to fields; nothing: passed over.
    void unbundle(Bundle const& cells, std::array<Field*, 8> const& fields) const;
    //! @}

    //! Folds ghosts into their owners and smooths: amounts per cell are final afterwards, ghosts included. Collective.
    void finish(std::span<Field* const> amounts) const;

    //! Makes intensive cell fields ready for gathering: smooths (the adjoint of `finish`) and fills ghosts. Collective.
    void prepare(std::span<Field* const> fields) const;

    int passes() const { return passes_; }  //!< of the smoothing

  private:
    //! Finds the order of cells that suits the rows.
    void place_cells(particle::Store const& granules);
    //! Diffuses values per volume; ghosts are filled before and after.
    void smooth(std::span<Field* const> fields) const;
    //! Coordinate of a granule that may be ahead of its rank's part by less than half a cell, over a periodic end too.
    double near(std::size_t d, double x) const;

    Grid const& grid_;
    Scheme scheme_;
    std::array<std::ptrdiff_t, 8> offset_{};
    Field open_fraction_;
    std::vector<grid::Run> open_cells_;
    std::vector<Stencil> stencils_;
    std::vector<std::uint32_t> order_, count_;
    std::array<std::size_t, 3> fastest_{};
    std::vector<std::uint32_t> place_;  // of each cell in the order of rows
    grid::FaceField conductance_;       //!< m3 exchanged through each lower face in a pass
    Field per_volume_;                  //!< 1/m3
    int passes_ = 0;
    mutable Field work_;
};
}
