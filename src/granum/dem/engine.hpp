// The granule engine: contacts, walls and motion of soft spheres on this rank's slab.
//
// One step is velocity Verlet with the drag of the held gas taken implicitly in each half kick:
// v <- (v + h (F/m + rate u)) / (1 + h rate), h = dt/2, so that a stiff drag never limits the step and steady states
// are exact. The impulse that the gas gave is summed in `drag_impulse`.
#pragma once

#include "granum/base/timer.hpp"
#include "granum/dem/contact_laws.hpp"
#include "granum/dem/contact_store.hpp"
#include "granum/geometry/wall.hpp"
#include "granum/par/communicator.hpp"
#include "granum/par/slabs.hpp"
#include "granum/particle/attachment.hpp"
#include "granum/particle/store.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace granum::dem
{
struct Settings
{
    Laws laws;  //!< contact laws and the table of material pairs
    std::vector<geometry::Wall> walls;
    math::Vec3 lower, upper;  //!< of the domain, m
    std::array<bool, 3> periodic{};
    math::Vec3 gravity{0, 0, -9.81};                  //!< m/s2
    double skin = 0;                                  //!< of the neighbour list, m; 0: chosen from the largest radius
    double warn_overlap = 0.10, stop_overlap = 0.50;  //!< of a radius
    bool frozen = false;                              //!< granules stay where they are
};

//! What the steps saw since it was last reset (by whoever reads it).
struct Watch
{
    double largest_overlap = 0;  //!< over the radius of the smaller partner
    long warned_overlaps = 0;    //!< steps on which an overlap above the warning line appeared
    long rebuilds = 0;
    long contacts = 0;      //!< pairs and walls touching at the last step, this rank
    double dissipated = 0;  //!< J lost in contacts, this rank; of a pair split over two ranks each counts one half
    double elastic = 0;     //!< J stored in contacts at the last step, this rank
    math::Vec3 wall_force;  //!< sum of the forces of all walls on this rank's granules at the last step, N
};

class Engine
{
  public:
    Engine(Settings settings, par::Slabs const& slabs, par::Communicator const& comm);
    ~Engine();

    //! Joins something that belongs to granules and must migrate with them (open deposits).
    void attach(particle::Attachment& attachment);

    //! Sorts, migrates, fills ghosts, finds neighbours and computes the first forces. Collective. Also to be called
    //! after granules were added or removed; contacts that go on keep their history. Throws NumericsError where the
    //! domain is too narrow for the granules or the state is not finite.
    void prepare(particle::Store& granules);

    //! One velocity-Verlet step. Collective. Throws NumericsError on a non-finite state or too large an overlap (on
    //! several ranks on all of them: at the latest in the step after).
    void step(particle::Store& granules, double dt);

    //! Tells the engine that radii, masses or other columns that ghosts carry were changed from outside (growth).
    //! Collective. Rows keep their places.
    void changed(particle::Store& granules);

    //! Makes sure that every owned granule lies in this rank's slab and in the periodic domain, so that a cell and the
    //! granules in it are on one rank; between steps they may be ahead by half a skin. Collective. Rows may move.
    void bring_home(particle::Store& granules);

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

//! Bounds for granules of `radius` (m) and `density` (kg/m3) that meet with `speed` (m/s), for every pairing that the
//! granules' material 0 has: 0.2 of the time a Rayleigh wave takes around a granule, 1/20 of the duration of a Hertz
//! contact, 0.2 sqrt(I / k_r) of the rolling spring at the overlap of that contact. Sources: Thornton and Randall,
//! Micromechanics of Granular Materials (1988) 133 [R]; Johnson, Contact Mechanics (1985) 11.4 [R].
std::vector<StepBound> step_bounds(Settings const& settings, double radius, double density, double speed);
}
