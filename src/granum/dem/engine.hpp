// The granule engine: contacts, walls and motion of soft spheres on this rank's slab.
//
// One step is velocity Verlet with the drag of the held gas taken implicitly in each half kick:
// v <- (v + h (F/m + rate u)) / (1 + h rate), h = dt/2, so that a stiff drag never limits the step and steady states
// are exact. The impulse that the gas gave is summed in `drag_impulse`.
#pragma once

#include "granum/base/timer.hpp"
#include "granum/dem/contact_store.hpp"
#include "granum/dem/contact_laws.hpp"
#include "granum/geometry/wall.hpp"
#include "granum/par/communicator.hpp"
#include "granum/par/slabs.hpp"
#include "granum/particle/attachment.hpp"
#include "granum/particle/store.hpp"

#include <memory>

namespace granum::dem
{
struct Settings
{
    Laws laws;                             //!< contact laws and the table of material pairs
    std::vector<geometry::Wall> walls;
    math::Vec3 lower, upper;               //!< of the domain, m
    std::array<bool, 3> periodic{};
    math::Vec3 gravity{0, 0, -9.81};       //!< m/s2
    double skin = 0;                       //!< of the neighbour list, m; 0: chosen from the largest radius
    double warn_overlap = 0.10, stop_overlap = 0.50;  //!< of a radius
    bool frozen = false;                   //!< granules stay where they are
};

//! What the last steps saw; reset by whoever reads it.
struct Watch
{
    double largest_overlap = 0;   //!< over the radius of the smaller partner
    long warned_overlaps = 0;     //!< steps on which an overlap above the warning line appeared
    long rebuilds = 0;
    long contacts = 0;            //!< pairs and walls touching at the last step, this rank
    double dissipated = 0;        //!< J lost in contacts
    math::Vec3 wall_force;        //!< sum of the forces of all walls on the granules at the last step, N
};

class Engine
{
  public:
    Engine(Settings settings, par::Slabs const& slabs, par::Communicator const& comm);
    ~Engine();

    //! Joins something that belongs to granules and must migrate with them (open deposits).
    void attach(particle::Attachment& attachment);

    //! Sorts, migrates, fills ghosts, finds neighbours and computes the first forces. Collective.
    void prepare(particle::Store& granules);

    //! One velocity-Verlet step. Collective. Throws NumericsError on a non-finite state or too large an overlap.
    void step(particle::Store& granules, double dt);

    //! Tells the engine that radii, masses or rows were changed from outside (growth).
    void changed(particle::Store& granules);

    ContactStore const& contacts() const;
    Settings const& settings() const;
    Watch& watch();
    base::Stopwatch& stopwatch();

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

//! A bound on the granule step with its reason.
struct StepBound
{
    double seconds;
    std::string reason;
};

//! Rayleigh (0.2), Hertz (t_c/20 at `speed`) and rolling bounds for the granules of a store (physics.md 1.5).
std::vector<StepBound> step_bounds(Settings const& settings, double radius, double density, double speed);
}
