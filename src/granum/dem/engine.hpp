// The granule engine: contacts, walls and motion of soft spheres on this rank's part of space.
//
// One step is velocity Verlet with the drag of the held gas taken implicitly in each half kick (held_gas.hpp), so that
// a stiff drag never limits the step and steady states are exact. The impulses that the drag gave to velocities and
// spins are summed in `drag_impulse` and `spin_impulse`; what granules with added mass take from the gas beside follows
// from the change of their velocity.
//
// With the gas held a state has the same bits on any number of ranks, with any neighbour list, in any order of rows and
// after a restart (kernel/kernel.hpp says how), as long as no overlap exceeds a sixth of a radius and Watch::late_lists
// is 0. Granules that leave a periodic domain come back at the other side in the same step.
//
// advance() does several steps in one sweep over the granules (layers.hpp) where no wall moves: a failure then stops
// the run up to five steps after the one that its message names.
#pragma once

#include "granum/base/exact_sum.hpp"
#include "granum/base/timer.hpp"
#include "granum/dem/contact_laws.hpp"
#include "granum/dem/halo.hpp"
#include "granum/dem/wall_contacts.hpp"
#include "granum/geometry/body.hpp"
#include "granum/par/communicator.hpp"
#include "granum/par/partition.hpp"
#include "granum/particle/attachment.hpp"
#include "granum/particle/store.hpp"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace granum::dem
{
struct Settings
{
    Laws laws;  //!< contact laws and the table of material pairs
    std::vector<geometry::Body> walls;
    math::Vec3 lower, upper;  //!< of the domain, m
    std::array<bool, 3> periodic{};
    math::Vec3 gravity{0, 0, -9.81};                  //!< m/s2
    double skin = 0;                                  //!< of the neighbour list, m; 0: chosen and adapted while running
    double sight = 0;                                 //!< m: contacts(gap) knows what is at most so far apart
    double warn_overlap = 0.10, stop_overlap = 0.50;  //!< of a radius
    bool frozen = false;                              //!< granules stay where they are
    bool energy_ledger = true;                        //!< account for what contacts store and dissipate
    std::string kernel;         //!< "avx512", "avx2", "sse4" or "scalar" (the plain loops); empty: the fastest here
    double largest_radius = 0;  //!< of those that will ever come, m: the unit of energies; 0: of those there at first
    double wear_threshold = 0;  //!< J per kg of granule; what a collision dissipates beyond it counts as wear
    int balance_every = 0;      //!< rebuilds between looks at the balance of work; 0: space stays cut as it was given
};

//! What the steps saw since it was last reset (by whoever reads it).
struct Watch
{
    double largest_overlap = 0;  //!< over the radius of the smaller partner
    long warned_overlaps = 0;    //!< steps on which an overlap above the warning line appeared
    long rebuilds = 0;
    long rebalances = 0;
    long sweeps = 0;      //!< of several steps each
    long strips = 0;      //!< that the layers of the present list are swept in
    long late_lists = 0;  //!< sweeps in which granules went farther than the list reaches
    long contacts = 0;    //!< pairs and walls touching at the last step, this rank
    //! @{ Energies on this rank, J; of a pair split over two ranks each counts one half. The sums over all ranks have
    //! the same bits on any number of them.
    base::ExactSum dissipated;  //!< lost in contacts
    base::ExactSum elastic;     //!< stored in contacts at the last step
    base::ExactSum wall_work;   //!< done by moving walls
    //! @}
    math::Vec3 wall_force;  //!< sum of the forces of all walls on this rank's granules at the last step, N
};

//! A contact as others see it.
struct Contact
{
    Id low, high;  //!< high is the number of the wall for a wall contact
    bool wall;
    double overlap;       //!< m; negative where there is a gap
    double normal_force;  //!< N, at the present velocities
    History history;
    double radius;                      //!< of the smaller partner, m
    double reduced_radius;              //!< R_i R_j / (R_i + R_j), m
    double elastic_force;               //!< N, of the normal law at rest
    std::array<std::uint32_t, 2> rows;  //!< of low and high (of a wall contact: of the granule, twice), as in
                                        //!< Engine::known_here
};

class Engine
{
  public:
    Engine(Settings settings, par::Partition partition, par::Communicator const& comm);
    Engine(Settings settings, par::Slabs const& slabs, par::Communicator const& comm);
    ~Engine();

    //! Joins something that belongs to granules and must migrate with them (open deposits).
    void attach(particle::Attachment& attachment);

    //! Sorts, migrates, finds neighbours and computes the first forces. Collective. Also to be called after granules
    //! were added or removed; contacts that go on keep their history. Throws NumericsError where the domain is too
    //! narrow for the granules or the state is not finite.
    void prepare(particle::Store& granules);

    //! As prepare, but for a state that was saved: forces and torques stay as they are, contacts get these histories
    //! (those of granules elsewhere are passed over). The run goes on with the same bits. Collective.
    void resume(particle::Store& granules, std::span<ContactRecord const> contacts);

    //! `steps` velocity-Verlet steps. Collective. Throws NumericsError on a non-finite state or too large an overlap
    //! (on several ranks on all of them: at the latest in the step after).
    void advance(particle::Store& granules, double dt, int steps);
    void step(particle::Store& granules, double dt) { advance(granules, dt, 1); }

    //! Tells the engine that radii, masses or other columns that contacts ask for were changed from outside (growth).
    //! Collective. Rows keep their places.
    void changed(particle::Store& granules);

    //! Makes sure that every owned granule lies in this rank's part and in the periodic domain, so that a cell and the
    //! granules in it are on one rank; between steps they may be ahead by what the list allows. Collective. Rows may
    //! move.
    void bring_home(particle::Store& granules);

    //! Cuts space anew so that all ranks have as much to do, or as it is given. Collective. Rows may move.
    void rebalance(particle::Store& granules);
    void repartition(particle::Store& granules, par::Partition partition);
    //! Work of each owned row as rebalance() weighs it: one, and a half for each partner that it touches.
    std::vector<double> work() const;

    //! All contacts that touch, as this rank sees them. With a `gap` (m, at most Settings::sight) also the pairs, and
    //! the walls beside granules, whose surfaces are closer than that: without force and history.
    std::vector<Contact> contacts(double gap = 0) const;
    //! A number per row of all granules that this rank knows: those of owned rows as given, behind them what the owners
    //! of the others have given. Collective.
    std::vector<double> known_here(std::span<double const> owned) const;
    //! All contacts to save, each on one rank only.
    std::vector<ContactRecord> save_contacts() const;

    //! Loads of the granules on the bodies at the last step. Collective.
    std::vector<WallLoad> wall_loads() const;
    //! Where the bodies are.
    geometry::Pose const& pose(std::size_t body) const;

    //! Time and what servos have come to, to be saved, and given back before resume().
    double time() const;
    std::vector<geometry::ServoState> servos() const;
    void set_clock(double time, std::vector<geometry::ServoState> const& servos = {});

    long candidates() const;     //!< pairs in the neighbour list
    std::size_t bytes() const;   //!< of memory, about
    double skin() const;         //!< of the present list, m
    std::string kernel() const;  //!< instruction set in use
    par::Partition const& partition() const;
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
