// What both ways of moving hard spheres share: the spheres, the walls, how they bounce, and what was seen.
#pragma once

#include "granum/dem/hard_state.hpp"
#include "granum/dem/hard_walls.hpp"
#include "granum/law/contact/hard_sphere.hpp"

namespace granum::dem
{
//! What granules gave to a body.
struct HardLoad
{
    Vec3 impulse;  //!< N s
    Vec3 turn;     //!< about the origin, N m s
};

//! What happened since the watch was last reset (by whoever reads it).
struct HardWatch
{
    long collisions = 0;  //!< of pairs
    long wall_collisions = 0;
    long kept_elastic = 0;        //!< collisions taken as elastic because they came too soon after another
    double largest_overlap = 0;   //!< over the radius of the smaller partner, whenever a pair was looked at
    double dissipated = 0;        //!< J lost in collisions
    Vec3 wall_impulse;            //!< of all walls on the granules, N s
    Vec3 wall_force;              //!< their mean over the last step, N
    std::vector<HardLoad> loads;  //!< on each body; empty where none was hit
    long collapses = 0;           //!< how often events came so fast that time-driven steps took over
    double time_driven = 0;       //!< s of process in time-driven steps
    long time_driven_steps = 0;
    long held_back = 0;  //!< displacements cut in time-driven steps to keep spheres apart
};

struct HardWorld
{
    HardState state;
    HardWalls walls;
    law::contact::Hoomans bounce;
    std::vector<law::contact::HardPair> table;  //!< of materials a and b at a * materials + b
    std::size_t materials = 0;
    double contact_time = 1e-6;  //!< s: a collision sooner than this after another is elastic
    HardWatch watch;

    law::contact::HardPair const& pair(std::uint32_t a, std::uint32_t b) const { return table[a * materials + b]; }

    //! Takes note of how deep two spheres, `apart` between centres, lie in each other.
    void see_overlap(double overlap, double smaller)
    {
        if (overlap > watch.largest_overlap * smaller) watch.largest_overlap = overlap / smaller;
    }

    //! Velocity of the surface of i against that of j where they touch; n from i to j.
    Vec3 slip(std::size_t i, std::size_t j, Vec3 const& n) const
    {
        auto const& a = state.body[i];
        auto const& b = state.body[j];
        return a.v - b.v + cross(a.radius * state.spin[i] + b.radius * state.spin[j], n);
    }
    //! The same against a wall at rest; n from the sphere to the wall.
    Vec3 slip(std::size_t i, Vec3 const& n) const
    {
        return state.body[i].v + cross(state.body[i].radius * state.spin[i], n);
    }
    double reduced_mass(std::size_t i, std::size_t j) const
    {
        return state.mass[i] * state.mass[j] / (state.mass[i] + state.mass[j]);
    }
    //! A wall in direction n gives `impulse` to sphere i.
    void push_off(std::size_t i, std::size_t wall, Vec3 const& n, Vec3 const& impulse)
    {
        push(i, n, impulse);
        watch.wall_impulse += impulse;
        std::size_t const body = walls.body(wall);
        if (watch.loads.size() <= body) watch.loads.resize(body + 1);
        watch.loads[body].impulse -= impulse;
        watch.loads[body].turn -= cross(state.body[i].x + state.body[i].radius * n, impulse);
    }
    //! Gives `impulse` to sphere i at the point of its surface in direction n.
    void push(std::size_t i, Vec3 const& n, Vec3 const& impulse)
    {
        double const mass = state.mass[i], radius = state.body[i].radius;
        state.body[i].v += (1 / mass) * impulse;
        state.spin[i] += (2.5 / (mass * radius)) * cross(n, impulse);
    }
};
}
