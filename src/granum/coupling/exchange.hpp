// Exchange of momentum and heat between parcels and gas over one coupling interval, reciprocal to round-off.
//
// Momentum. The gas equation takes the drag implicitly, with the effective coefficient k = beta / (1 + dt beta/m) of a
// parcel that relaxes meanwhile, so any load is stable. The granule engine then applies the drag it really meets; the
// difference to what the gas was told is kept per parcel (`drag_impulse`) and given to the gas in the next interval.
// Heat. Q = k_h (T_g^{n+1} - T_p^n), k_h = hA / (1 + dt hA/C), is used by the gas equation and then given to the
// parcel. Every closure uses the real granule's diameter; a parcel counts `count` times (physics.md 1.8). Sources:
// physics.md 3.1, 3.6, 3.7.
#pragma once

#include "granum/coupling/mapping.hpp"
#include "granum/gas/flow.hpp"
#include "granum/law/drag/all.hpp"
#include "granum/law/heat/all.hpp"
#include "granum/particle/store.hpp"

namespace granum::coupling
{
struct Laws
{
    law::drag::Any drag;
    law::heat::Any heat;
};

//! The gas that each owned granule sees at the beginning of an interval, and its coefficients. Rows as in the store.
struct Seen
{
    std::vector<Vec3> velocity, own_velocity;  //!< of the gas, and of the granule when the gas was told
    std::vector<double> temperature, vapour_fraction, density, solids_fraction;
    std::vector<double> slip, reynolds, sherwood;  //!< m/s (superficial), 1, 1
    std::vector<double> drag, heat;                //!< effective coefficients of the parcel: kg/s, W/K
    std::vector<double> drag_rate;                 //!< beta / m, 1/s
    void resize(std::size_t rows);
};

class Exchange
{
  public:
    Exchange(Laws laws, gas::Solver const& solver, Grid const& grid, par::Communicator const& comm, Mapping& mapping,
             double pressure, double heat_capacity, bool frozen);

    //! Solids volume per cell from the granules as they are now: the voidage at the end of the coming gas step.
    //! Clamped from below at 0.35; counts the cells where that happened. Collective.
    Field voidage(particle::Store const& granules);

    //! What each granule sees now, and all sources of drag and heat for a gas step of `dt`. Collective.
    //! Adds to `sources`, which the caller has cleared and finishes with `finish_sources`.
    void share(particle::Store const& granules, gas::State const& state, double dt, Seen& seen, gas::Sources& sources);

    //! Gives the granules what the gas step brought: heat now, velocity and forces for the coming granule steps.
    //! Returns the relative mismatch between what the gas lost and the granules got (momentum). Collective.
    double deliver(particle::Store& granules, gas::State const& state, Field const& exchanged_temperature, double dt,
                   Seen const& seen, gas::Sources const& sources);

    long clamped_cells() const { return clamped_; }
    Laws const& laws() const { return laws_; }

    //! J/K of a parcel with its liquid.
    double heat_capacity(particle::Store const& granules, std::size_t row) const;

  private:
    Laws laws_;
    gas::Solver const& solver_;
    Grid const& grid_;
    par::Communicator const& comm_;
    Mapping& mapping_;
    double pressure_, heat_capacity_;
    bool frozen_;
    long clamped_ = 0;
};
}
