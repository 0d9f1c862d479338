// Exchange of momentum, spin and heat between parcels and gas over one coupling interval, reciprocal to round-off.
//
// Momentum. The gas equation takes the drag implicitly, with the effective coefficient k = beta / (1 + dt beta/m) of a
// parcel that relaxes meanwhile, so any load is stable. The granule engine then applies the drag it really meets; the
// difference to what the gas was told is kept per parcel (`drag_impulse`) and given to the gas in the next interval.
// Lift acts on both in the same interval. Virtual mass and history move the engine's mass; what they took from the gas
// follows from the change of the parcel's velocity and is given back in the next interval, like the torque of
// rotational drag (`spin_impulse`), which the gas gets as a couple. Model B has drag and the other forces over the
// voidage, and the hydrostatic buoyancy in the place of the pressure gradient and the stress. Heat. Q = k_h (T_g^{n+1}
// - T_p^n), k_h = C/dt (1 - exp(-dt hA/C)), is used by the gas equation and then given to the parcel; radiation goes
// the same way, explicitly, and the gas bears what the granules around do not. Every closure uses the real granule's
// diameter; a parcel counts `count` times (physics.md 1.8). Sources: physics.md 2.1, 3.1, 3.3, 3.6, 3.7, 3.8.
#pragma once

#include "granum/coupling/histories.hpp"
#include "granum/coupling/mapping.hpp"
#include "granum/gas/flow.hpp"
#include "granum/law/dispersion/all.hpp"
#include "granum/law/drag/all.hpp"
#include "granum/law/force/all.hpp"
#include "granum/law/heat/all.hpp"
#include "granum/particle/store.hpp"

#include <optional>

namespace granum::coupling
{
struct Laws
{
    law::drag::Any drag;
    law::heat::Any heat;
    law::force::VirtualMassLaws::Any virtual_mass{};
    law::force::ShearLiftLaws::Any shear_lift{};
    law::force::SpinLiftLaws::Any spin_lift{};
    law::force::TorqueLaws::Any torque{};
    bool history = false;       //!< Basset's force, of which `Histories` keep what was
    bool polydisperse = false;  //!< drag of each size in a mixture
    bool filtered = false;      //!< drag of cells that do not see clusters (Radl and Sundaresan)
    double emissivity = 0;      //!< of granules; 0: no radiation
    law::dispersion::Any dispersion = law::dispersion::NoDispersion{};
    std::uint32_t seed = 1;  //!< of the fluctuations that granules see
};

//! What granules are like.
struct Solids
{
    double heat_capacity = 0;  //!< of dry granules, J/kg/K
    bool frozen = false;       //!< granules stay where they are
};

//! The gas that each owned granule sees at the beginning of an interval, and its coefficients. Rows as in the store.
struct Seen
{
    std::vector<Vec3> velocity, own_velocity;  //!< of the gas, and of the granule when the gas was told
    std::vector<double> temperature, vapour_fraction, density, solids_fraction;
    std::vector<double> slip, reynolds, sherwood;  //!< m/s (superficial), 1, 1
    std::vector<double> drag, heat;                //!< effective coefficients of the parcel: kg/s, W/K
    std::vector<double> drag_coefficient;          //!< beta of the parcel, kg/s
    std::vector<double> radiation;                 //!< into the parcel, W
    std::vector<double> voidage;                   //!< 1 in model A: what forces on the granule are divided by
    std::vector<Vec3> lift, vorticity;             //!< N, 1/s; empty without lift and torque
    std::vector<double> turning;                   //!< rotational drag of the parcel, N m s; empty without
    std::vector<Vec3> history;                     //!< explicit part of the history force, N; empty without
    std::vector<double> added_mass;                //!< of virtual mass and history, kg; empty without
    std::vector<Vec3> fluctuation;                 //!< of the gas, in `velocity` too, m/s; empty without
};

class Exchange
{
  public:
    Exchange(Laws laws, gas::Solver const& solver, Grid const& grid, par::Communicator const& comm, Mapping& mapping,
             Solids solids, Histories* histories = nullptr);

    //! Solids volume per cell from the granules as they are now: the voidage at the end of the coming gas step. Not
    //! below 0.35: what is too much for a cell goes to those beside it, as far as they have room. Counts the cells that
    //! had too much. Collective.
    Field voidage(particle::Store const& granules);

    //! What each granule sees now, and all sources of drag and heat for a gas step of `dt`. Collective.
    //! Adds to `sources`, which the caller has cleared and finishes. `step` numbers the gas step for the fluctuations,
    //! of which the granules remember theirs.
    void share(particle::Store& granules, gas::State const& state, double dt, Seen& seen, gas::Sources& sources,
               std::uint32_t step = 0);

    //! Gives the granules what the gas step brought: heat now, velocity and forces for the coming granule steps.
    //! Returns the relative mismatch between what the gas lost and the granules got (momentum). Collective.
    double deliver(particle::Store& granules, gas::State const& state, double dt, Seen const& seen,
                   gas::Sources const& sources);

    //! Impulse that a parcel has taken from the gas and the gas not yet lost, kg m/s.
    Vec3 debt(particle::Store const& granules, std::size_t row) const;

    long clamped_cells() const { return clamped_; }
    Laws const& laws() const { return laws_; }
    //! Columns that the laws need.
    bool adds_mass() const { return adds_mass_; }
    bool turns() const { return turns_; }
    bool disperses() const { return disperses_; }

    //! J/K of a parcel with its liquid.
    double heat_capacity(particle::Store const& granules, std::size_t row) const;

  private:
    void find_drag(particle::Store const& granules, std::size_t row, double dt, Seen& seen, double sauter) const;
    void find_heat(particle::Store const& granules, double dt, Seen& seen) const;
    void find_fluctuations(particle::Store& granules, gas::State const& state, double dt, std::uint32_t step,
                           Seen& seen);
    void find_lift(particle::Store const& granules, std::size_t row, Seen& seen) const;
    void find_added_mass(particle::Store const& granules, std::size_t row, Seen& seen);
    double viscosity(double temperature) const;
    //! Diameter of the mixture that granules of a cell make up, m: volume over area.
    Field sauter_diameter(particle::Store const& granules) const;

    Laws laws_;
    gas::Solver const& solver_;
    Grid const& grid_;
    par::Communicator const& comm_;
    Mapping& mapping_;
    Solids solids_;
    bool model_b_, adds_mass_, turns_, lifts_, disperses_;
    Histories* histories_;
    long clamped_ = 0;
    Bundle cells_, more_;  // scratch
};
}
