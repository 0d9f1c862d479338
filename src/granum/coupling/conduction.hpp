// Heat that granules pass to each other where they touch.
//
// Explicit, in as many equal parts of the interval as it takes for no granule to come nearer to its neighbours than by
// a tenth of the difference in one of them. What passes a contact is rounded to a power of two that both partners know,
// so that sums know no order: none of it is lost, on any number of ranks, and a restart changes no bit.
//
// A contact of parcels conducts as one of spheres of their size: a bed of parcels l times as large, pressed by the same
// stress, then conducts as that of the granules. Walls pass no heat. Sources: law/conduction.
#pragma once

#include "granum/dem/engine.hpp"
#include "granum/law/conduction/all.hpp"
#include "granum/par/communicator.hpp"
#include "granum/particle/store.hpp"

#include <span>
#include <vector>

namespace granum::coupling
{
//! A material that conducts.
struct Conductor
{
    double conductivity = 0;    //!< W/m/K; 0: passes no heat
    double youngs_modulus = 0;  //!< Pa, the real one; 0: the overlap is taken as it is
    double poisson_ratio = 0.25;
};

class Conduction
{
  public:
    //! `materials` by the number that granules have of theirs.
    Conduction(law::conduction::Any law, std::vector<Conductor> materials, par::Communicator const& comm);

    bool passes_heat() const;

    //! Passes heat for `dt` (s) between granules that touch: changes enthalpy and temperature of owned rows, of heat
    //! capacity `capacity` (J/K). Returns the number of parts that the interval was cut into. Collective.
    int pass(dem::Engine const& engine, particle::Store& granules, std::span<double const> capacity, double dt) const;

  private:
    double conductance(dem::Contact const& contact, Conductor const& one, Conductor const& other) const;

    law::conduction::Any law_;
    std::vector<Conductor> materials_;
    par::Communicator const& comm_;
};
}
