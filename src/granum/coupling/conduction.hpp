// Heat that granules pass to each other and to walls: through the circle where they touch, and through the gas between
// surfaces that touch or nearly do.
//
// Explicit, in as many equal parts of the interval as it takes for no granule to come nearer to its neighbours than by
// a tenth of the difference in one of them. What passes a link is rounded to a power of two that both partners know, so
// that sums know no order: none of it is lost, on any number of ranks, and a restart changes no bit.
//
// A contact of parcels conducts as one of spheres of their size: a bed of parcels l times as large, pressed by the same
// stress, then conducts as that of the granules. Walls pass heat where they have a temperature; the others are
// adiabatic for granules. Sources: law/conduction, law/film.
#pragma once

#include "granum/dem/engine.hpp"
#include "granum/law/conduction/all.hpp"
#include "granum/law/film/all.hpp"
#include "granum/par/communicator.hpp"
#include "granum/particle/store.hpp"

#include <optional>
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
    double softened_modulus = 0;  //!< Pa, of the contacts as they are computed
    bool rigid = false;           //!< does not yield
};

//! What passes heat.
struct Paths
{
    law::conduction::Any contact{};              //!< where surfaces touch
    law::film::Any film{};                       //!< through the gas between them
    double lens = 0.2;                           //!< thickness of that gas over the radius of the larger granule
    double shortest = 2.75e-8;                   //!< way through the gas, m
    std::optional<double> gas{};                 //!< conductivity of the gas, W/m/K; none: of moist air between both
    bool collisions = false;                     //!< contacts are collisions, which softened granules prolong
    std::vector<Conductor> materials{};          //!< by the number that granules and walls have of theirs
    std::vector<std::optional<double>> walls{};  //!< temperatures of the engine's bodies, K; none: adiabatic
};

//! What was passed in an interval, J, this rank's share.
struct PassedHeat
{
    int parts = 0;                            //!< that the interval was cut into
    double contacts = 0, film = 0;            //!< between granules, either way
    double wall_contacts = 0, wall_film = 0;  //!< from granules to walls, net

    double to_walls() const { return wall_contacts + wall_film; }
};

class Conduction
{
  public:
    Conduction(Paths paths, par::Communicator const& comm);

    bool passes_heat() const { return touches_ || films_; }
    //! How far from a granule of `radius` (m) a surface may be that gets heat from it, m: what the engine has to see.
    double reach(double radius) const { return films_ ? paths_.lens * radius : 0; }

    //! Passes heat for `dt` (s): changes enthalpy and temperature of owned rows, of heat capacity `capacity` (J/K).
    //! Collective.
    PassedHeat pass(dem::Engine const& engine, particle::Store& granules, std::span<double const> capacity,
                    double dt) const;

  private:
    struct Link;
    //! W/K through the circle of a contact, and the overlap (m) that its spheres really have.
    double through_contact(dem::Contact const& contact, Conductor const& one, Conductor const& other) const;
    double real_overlap(dem::Contact const& contact, Conductor const& one, Conductor const& other) const;
    double through_film(double radius, double other, double gap, double temperature) const;
    std::vector<Link> links(dem::Engine const& engine, particle::Store const& granules,
                            std::span<double const> capacities) const;

    Paths paths_;
    bool touches_, films_;
    par::Communicator const& comm_;
};
}
