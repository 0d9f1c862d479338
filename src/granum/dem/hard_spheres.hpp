// The second granule engine: hard spheres, whose contacts last no time and which never overlap. One rank.
//
// Spheres fly on parabolas from collision to collision, with the gas held over the step as a constant acceleration of
// each; added mass and what turns granules are not looked at. Where a dense state makes collisions come without end,
// time-driven steps take over for a while by themselves; the watch tells when and for how long.
#pragma once

#include "granum/base/timer.hpp"
#include "granum/dem/engine.hpp"
#include "granum/dem/hard_flight.hpp"
#include "granum/dem/hard_world.hpp"

#include <memory>

namespace granum::dem
{
struct HardOptions
{
    double tangential_restitution = 0.33;  //!< of the slip where surfaces stick, 0 to 1
    //! s: a collision sooner than this after another of the same sphere is taken as elastic, so that collisions cannot
    //! pile up without end. Source: Luding and McNamara, Granul. Matter 1 (1998) 113 (recalled, unverified).
    double contact_time = 1e-6;
};

//! What the next step depends on besides the columns of the granules; belongs in a checkpoint.
struct HardMemory
{
    std::vector<double> last;  //!< time of each row's last collision, the present being 0, s
    HardFlight::Pace pace;     //!< its time counts from the present too
    int packed_steps = 0;      //!< time-driven steps that are left before flight is tried again
};

class HardSpheres
{
  public:
    //! Uses of `settings` the walls, the domain, gravity, and restitution and sliding friction of each pairing.
    explicit HardSpheres(Settings settings, HardOptions const& options = {});
    ~HardSpheres();

    //! Takes over the granules. Also to be called after granules were changed, added or removed. Throws NumericsError
    //! where granules overlap each other or a wall by more than 1e-9 of a radius, where the state is not finite, or
    //! where a periodic domain is narrower than two diameters.
    void prepare(particle::Store& granules);

    //! As prepare, but for a state that was saved with this memory: the run goes on with the same bits.
    void resume(particle::Store& granules, HardMemory const& memory);
    HardMemory memory() const;

    //! Moves the granules on by `dt` (s); rows keep their places. Events are predicted anew from the columns, so that a
    //! step does not know whether the one before was in the same run of the program.
    //! Throws NumericsError on a state that is not finite.
    void step(particle::Store& granules, double dt);

    //! `steps` steps of `dt`, of which only the end is written to the store where no gas acts.
    void advance(particle::Store& granules, double dt, long steps);

    Settings const& settings() const;
    HardWatch& watch();
    HardWatch const& watch() const;
    base::Stopwatch& stopwatch();

  private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};
}
