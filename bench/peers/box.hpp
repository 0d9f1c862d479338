// The open box of the comparison and the granules in it, for the engine: laws and numbers as the decks state them.
#pragma once

#include "granum/dem/engine.hpp"
#include "peers/state.hpp"

#include <memory>
#include <string>

namespace granum::peers
{
//! How the spheres of a run touch. The defaults are those of the decks.
struct Touching
{
    law::contact::Attraction attraction = law::contact::Attraction::keep;  //!< as the peers do
    dem::Lever lever = dem::Lever::contact_point;
    bool rolling = true;  //!< epsd, or none
    double restitution = 0.8, sliding_friction = 0.3, rolling_friction = 0.1;
};

//! How the engine works.
struct Engine
{
    double skin = 0;             //!< of the neighbour list, m; 0: its own choice
    std::string kernel;          //!< instruction set; empty: the fastest here
    bool energy_ledger = false;  //!< the peers keep none
};

//! Granules of this rank and the engine that moves them. Five planes: a floor at z = 0 and four sides, of the spheres'
//! own material (E 1e7 Pa, nu 0.25); open above.
struct Box
{
    particle::Store granules;
    std::unique_ptr<dem::Engine> engine;
    long total = 0;  //!< granules on all ranks

    //! The state tiled tiles_x by tiles_y times, and the first forces. Collective.
    Box(State const& state, long tiles_x, long tiles_y, Touching const& touching, Engine const& how,
        par::Communicator const& comm);

    //! Of translation, on all ranks, J. Collective.
    double kinetic_energy(par::Communicator const& comm) const;

    //! Touching pairs of granules, twice over the number of granules; walls do not count. Collective.
    double coordination(par::Communicator const& comm) const;
};
}
