// What the granule engine keeps; private to its sources.
#pragma once

#include "granum/dem/engine.hpp"
#include "granum/dem/held_gas.hpp"
#include "granum/dem/wall_contacts.hpp"

#include <algorithm>
#include <unordered_map>

namespace granum::dem
{
struct Engine::Inside
{
    Settings settings;
    Domain domain;
    kernel::Images images;
    par::Communicator comm;
    Halo halo;
    kernel::Kernel const* kernel;
    std::vector<law::contact::Pair<double>> pairings;
    std::vector<double> restitutions;  // of pairings
    kernel::Rules rules;

    Frame frame;
    HeldGas gas;
    NeighbourSearch search;
    Candidates candidates;
    Layers layers;
    PairList pairs;
    WallContacts walls;
    double time = 0;  // s
    std::vector<particle::Attachment*> attachments;
    Watch watch;
    kernel::Energy lost;  // in springs of contacts that ended while a list was made
    base::Stopwatch stopwatch;

    double skin = 0;                   // of the present list, m
    double growth = 0;                 // largest growth of a radius since the list was made, m
    double travelled = 0;              // no granule used up more of its room since the list was made
    std::vector<double> built_radius;  // of owned rows when the list was made, m
    long steps = 0, built_step = 0;
    bool sorted = false;  // rows, at least once
    long unsorted_rebuilds = 0, unbalanced_rebuilds = 0;
    double last_moved = 0;  // of its room at most, by any granule of any rank in the last step
    double reserve = 2;     // a sweep is begun if the list will do for so many times as long
    std::string failure;    // seen on this rank, not yet told to the others

    Inside(Settings given, par::Partition partition, par::Communicator const& communicator);

    // rebuild.cpp
    void rebuild(particle::Store& granules, std::span<ContactRecord const> saved = {});
    double next_skin(double mean_radius, double largest) const;
    double give_room(double mean_radius, double largest);
    bool strayed() const;
    std::vector<double> work() const;
    void balance(particle::Store& granules);
    std::vector<ContactRecord> contacts_of(std::vector<std::uint32_t> const& rows,
                                           std::span<ContactRecord const> saved) const;

    // motion.cpp
    double first_move(double dt);
    double move(double dt, Layers::Part const& part, int kicks, bool drifts);
    double move_all(double dt, int kicks, bool drifts);
    int steps_together(int left) const;
    void sweep(double dt, int together, bool first);

    // engine.cpp
    void agree_on_failure();
    void find_non_finite();
    void name_overlap();
    void stop_alone() const;
    Vec3 apart(std::uint32_t row, std::uint32_t other) const;
    void forces(Layers::Part const& part, bool alone, double dt, kernel::Seen& seen);
    void all_forces(double dt);
    void finish_forces(double dt, kernel::Seen const& seen);
    bool outgrown(double moved);
    double farthest() const;
    // Part of the least room that growth leaves.
    double free() const { return std::max(0.0, 1 - growth / (0.5 * skin)); }
};
}
