// Flight of the droplets: motion, evaporation, capture by granules, loss to walls and outlet.
//
// The room knows no grid. What surrounds a droplet, and where its exchange with the gas goes, comes through
// `Surroundings`; what a droplet leaves the gas is exactly what the gas is given.
// Sources: physics.md 4.2 (drag, Abramzon and Sirignano evaporation), 4.5 (filter capture).
#pragma once

#include "granum/base/random.hpp"
#include "granum/geometry/chamber.hpp"
#include "granum/law/capture/all.hpp"
#include "granum/law/dispersion/all.hpp"
#include "granum/law/impact/splash.hpp"
#include "granum/spray/droplet.hpp"

#include <optional>
#include <vector>

namespace granum::spray
{
//! Gas and bed at a point.
struct Seen
{
    Vec3 gas_velocity;                             //!< m/s, analytic jet included where cells are coarse
    double turbulent_energy = 0, dissipation = 0;  //!< k, m2/s2; epsilon, m2/s3
    Vec3 energy_gradient;                          //!< of k, m/s2
    double temperature = 293.15, vapour_fraction = 0, density = 1.2, viscosity = 1.8e-5;
    double solids_fraction = 0;
};

//! What a droplet gave the gas during a sub-step.
struct Given
{
    double vapour = 0;    //!< kg
    double enthalpy = 0;  //!< J, with the enthalpy of the vapour
    Vec3 momentum;        //!< N s
};

//! A granule parcel that a droplet might hit.
struct Target
{
    std::size_t row = 0;
    double chance = 0;  //!< hits per second, weighted by nearness: number density times cross-section times speed
    Vec3 velocity;
    double diameter = 0;  //!< of a real granule
};

class Surroundings
{
  public:
    virtual ~Surroundings() = default;
    virtual Seen seen(Vec3 const& x) const = 0;
    virtual void give(Vec3 const& x, Given const& given) = 0;
    //! Owned granules around x with the number per volume (1/m3) that each adds there in `chance`: a kernel's weight
    //! times number, over the part of the kernel that this rank sees. Empty where there are none.
    virtual void targets(Vec3 const& x, std::vector<Target>& out) const = 0;
    virtual bool mine(Vec3 const& x) const = 0;  //!< does this rank own the place?
};

//! A droplet parcel that met a granule.
struct Hit
{
    Droplet droplet;
    std::size_t row;
    double speed;  //!< relative, m/s
    double left;   //!< s of the step that it had still to fly
};

struct Losses
{
    double solids = 0, water = 0, enthalpy = 0;  //!< kg, kg, J
};

//! Outcome of a step on this rank.
struct Outcome
{
    std::vector<Hit> hits;
    Losses walls, overspray;
    double evaporated = 0;         //!< kg of water
    std::vector<Droplet> leaving;  //!< droplets now on another rank's ground
};

struct FlightSettings
{
    Liquid liquid;
    law::capture::Any capture;
    Vec3 gravity;
    double pressure = 101325;
    double end_moisture = 0.01;  //!< of the feed's: below it a droplet is dry
    law::impact::Splash splash;
    double longest_hop = 0.005;  //!< m that a droplet may move in a sub-step
    law::dispersion::Any dispersion = law::dispersion::NoDispersion{};
    std::uint32_t seed = 1;
};

//! Moves the droplets for `dt`. Those that dry on the way fly on as dust. `step` numbers the gas step for the random
//! streams.
void fly(std::vector<Droplet>& droplets, FlightSettings const& settings, geometry::Chamber const& chamber,
         Surroundings& around, double dt, std::uint32_t step, Outcome& outcome);

//! Evaporation and heating (of a melt: solidification) of one droplet parcel for `dt` in still-held air; `slip` in m/s.
//! Returns what the gas got.
Given evaporate(Droplet& droplet, FlightSettings const& settings, Seen const& seen, double slip, double dt);
}
