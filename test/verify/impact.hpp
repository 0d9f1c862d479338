// One or two spheres stated as a case, as a user would, and moved by the step of `granum run`: impacts on each other
// and on the plate, and motion along the plate. Shared by the rows of the verification table.
#pragma once

#include "scene/case_text.hpp"
#include "scene/granules.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace granum::verify
{
using math::Vec3;
using scene::Stuff;

struct Scenario
{
    Stuff stuff;
    dem::PairProperties pair;
    std::vector<sim::GranuleCase> granules;
    double radius, step;  //!< m, s; no step: the one that the program chooses
    Vec3 size, gravity;
    bool lever_radius = true;
    std::string contact = "rigid_wall = true";  //!< more lines of [contact]
    std::string apparatus;                      //!< more lines of [apparatus]
};

inline std::unique_ptr<sim::Simulation> simulate(Scenario const& s)
{
    std::string text = "gravity = " + scene::vector_text(s.gravity, "m/s2");
    text += "\n[apparatus]\nshape = \"box\"\nsize = " + scene::vector_text(s.size, "m") + "\n" + s.apparatus;
    text += fmt::format("\n[granules]\ndiameter = \"{} m\"\ndensity = \"{} kg/m3\"\n", 2 * s.radius, s.stuff.density);
    text += fmt::format(
        "[contact]\nyoungs_modulus = \"{} Pa\"\npoisson_ratio = {}\nrestitution = {}\nsliding_friction = {}\n"
        "rolling_friction = {}\nlever_radius = {}\n{}\n",
        s.stuff.youngs_modulus, s.stuff.poisson_ratio, s.pair.restitution, s.pair.sliding_friction,
        s.pair.rolling_friction, s.lever_radius, s.contact);
    text += "[time]\nduration = \"10 s\"\n";
    if (s.step > 0) text += fmt::format("granule_step = \"{} s\"\n", s.step);
    for (auto const& granule : s.granules) text += scene::granule_text(granule);
    return scene::simulation_of(text);
}

struct Impact
{
    double force = 0, overlap = 0, duration = 0;  //!< largest, largest, of the only contact: N, m, s
    Vec3 velocity, spin;                          //!< of the first granule, afterwards
};

//! Steps until the only contact has begun and ended; `look` sees the overlap (m) and the normal force (N) of each step.
inline Impact collide(sim::Simulation& simulation, std::function<void(double, double)> const& look = {})
{
    Impact seen;
    for (bool touched = false;;) {
        simulation.step(simulation.granule_dt());
        auto const contacts = simulation.engine().contacts();
        if (contacts.empty() && touched) break;
        if (contacts.empty()) continue;
        touched = true;
        auto const& contact = contacts[0];
        if (look) look(contact.overlap, contact.normal_force);
        seen.duration += simulation.granule_dt();
        seen.force = std::max(seen.force, contact.normal_force);
        seen.overlap = std::max(seen.overlap, contact.overlap);
    }
    auto const& granules = simulation.granules();
    auto const row = granules.id[0] == 0 ? 0u : 1u;
    seen.velocity = granules.velocity[row], seen.spin = granules.spin[row];
    return seen;
}

inline double plane_modulus(Stuff const& stuff)
{
    return stuff.youngs_modulus / (1 - stuff.poisson_ratio * stuff.poisson_ratio);
}
inline double mass_of(Stuff const& stuff, double radius)
{
    return 4.0 / 3 * math::pi * std::pow(radius, 3) * stuff.density;
}
inline double radians(double degrees)
{
    return degrees * math::pi / 180;
}

//! A sphere a hair above the plate that arrives with `velocity`; 4000 steps in the time of an elastic contact.
inline Scenario above_plate(Stuff const& stuff, double radius, Vec3 const& velocity, dem::PairProperties const& pair,
                            Vec3 const& spin = {}, bool lever_radius = true)
{
    double const contact = scene::hertz_time(plane_modulus(stuff), radius, mass_of(stuff, radius), -velocity.z);
    double const edge = 20 * radius;
    return {.stuff = stuff,
            .pair = pair,
            .granules = {{.position = {edge / 2, edge / 2, radius * (1 + 1e-9)}, .velocity = velocity, .spin = spin}},
            .radius = radius,
            .step = contact / 4000,
            .size = {edge, edge, edge},
            .gravity = {},
            .lever_radius = lever_radius};
}

inline Impact on_plate(Stuff const& stuff, double radius, Vec3 const& velocity, dem::PairProperties const& pair,
                       Vec3 const& spin = {}, bool lever_radius = true)
{
    return collide(*simulate(above_plate(stuff, radius, velocity, pair, spin, lever_radius)));
}

//! A sphere that rests on the plate with the overlap that carries its weight, and moves along it.
inline std::unique_ptr<sim::Simulation> along_the_plate(Stuff const& stuff, double radius, double speed, double spin,
                                                        dem::PairProperties const& pair, double room, double step)
{
    double const g = 9.81;
    double const overlap =
        std::pow(0.75 * mass_of(stuff, radius) * g / (plane_modulus(stuff) * std::sqrt(radius)), 2.0 / 3);
    return simulate({.stuff = stuff,
                     .pair = pair,
                     .granules = {{.position = {4 * radius, 4 * radius, radius - overlap},
                                   .velocity = {speed, 0, 0},
                                   .spin = {0, spin, 0}}},
                     .radius = radius,
                     .step = step,
                     .size = {8 * radius + room, 8 * radius, 8 * radius},
                     .gravity = {0, 0, -g}});
}
}
