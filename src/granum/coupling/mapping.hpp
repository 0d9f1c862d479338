// Between parcels and cells: one set of weights spreads what a parcel gives to its cells and gathers what it sees.
//
// Weights are trilinear about the cell centres, times the open fraction of each cell, normalised to one: closed cells
// get nothing, a uniform suspension maps to a uniform voidage along a cut wall, and nothing is ever lost. Spreading and
// gathering with the same weights (and the same smoothing) are adjoint, so what the gas gives is what parcels get.
//
// The optional smoothing is a diffusion over the open faces (physics.md 3.4 d): conservative, symmetric, explicit in as
// many passes as stability asks for.
#pragma once

#include "granum/grid/halo.hpp"
#include "granum/particle/store.hpp"

#include <span>

namespace granum::coupling
{
using grid::Field;
using grid::Grid;
using grid::Index;
using math::Vec3;

//! The cells of a point and their weights, which sum to one (all zero for a point with no open cell around it).
struct Stencil
{
    std::array<std::uint32_t, 8> cell{};
    std::array<double, 8> weight{};
};

class Mapping
{
  public:
    //! `bandwidth` (m) is the standard deviation of the smoothing; 0 switches it off.
    Mapping(Grid const& grid, par::Communicator const& comm, double bandwidth);

    Stencil stencil(Vec3 const& position) const;

    //! Finds the stencils of all owned granules; valid until rows change.
    void locate(particle::Store const& granules);
    std::span<Stencil const> stencils() const { return stencils_; }

    //! The owned rows of `locate` by identity: sums taken in this order do not depend on the order in memory, so a run
    //! that was continued, whose rows lie elsewhere, has the same bits.
    std::span<std::uint32_t const> order() const { return order_; }

    //! Adds amount * weight to the cells; call `finish` after the last one.
    static void spread(Stencil const& stencil, double amount, Field& field)
    {
        for (int s = 0; s < 8; ++s) field[stencil.cell[s]] += amount * stencil.weight[s];
    }
    static double gather(Stencil const& stencil, Field const& field)
    {
        double sum = 0;
        for (int s = 0; s < 8; ++s) sum += field[stencil.cell[s]] * stencil.weight[s];
        return sum;
    }
    static Vec3 gather(Stencil const& stencil, std::array<Field, 3> const& field)
    {
        return {gather(stencil, field[0]), gather(stencil, field[1]), gather(stencil, field[2])};
    }

    //! Folds ghosts into their owners and smooths: amounts per cell are final afterwards, ghosts included. Collective.
    void finish(std::span<Field* const> amounts) const;

    //! Makes intensive cell fields ready for gathering: smooths (the adjoint of `finish`) and fills ghosts. Collective.
    void prepare(std::span<Field* const> fields) const;

  private:
    //! Diffuses values per volume; ghosts are filled before and after.
    void smooth(std::span<Field* const> fields) const;

    Grid const& grid_;
    Field open_fraction_;
    std::vector<Stencil> stencils_;
    std::vector<std::uint32_t> order_;
    grid::FaceField conductance_;  //!< m3 exchanged through each lower face in a pass
    int passes_ = 0;
    mutable Field work_;
};
}
