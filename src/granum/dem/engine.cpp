#include "granum/dem/engine.hpp"

#include "granum/base/error.hpp"
#include "granum/dem/contact_sweep.hpp"
#include "granum/dem/halo.hpp"
#include "granum/dem/neighbours.hpp"
#include "granum/particle/rows.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
using base::Stage;

struct Engine::Inside
{
    Settings settings;
    par::Communicator comm;
    Halo halo;
    ContactSweep sweep;
    NeighbourSearch search;
    ContactStore contacts;
    SavedContacts saved;
    std::vector<particle::Attachment*> attachments;
    Watch watch;
    base::Stopwatch stopwatch;

    double skin = 0;             // of the present list, m
    double growth = 0;           // largest growth of a radius since the list was made, m
    std::vector<Vec3> built_at;  // positions when the list was made
    std::vector<double> built_radius;
    long steps = 0;
    std::string failure;  // seen on this rank, not yet told to the others

    Inside(Settings given, par::Slabs const& slabs, par::Communicator const& communicator)
        : settings(std::move(given)),
          comm(communicator),
          halo({settings.lower, settings.upper, settings.periodic}, slabs, communicator),
          sweep(settings.laws, settings.walls, {settings.warn_overlap, settings.stop_overlap})
    {
    }

    // 0: go on, 1: the neighbour list is outgrown, 2: failed.
    void agree_on_failure(long mine, long worst) const
    {
        if (worst < 2) return;
        if (mine == 2) throw base::NumericsError(failure);
        throw base::NumericsError("stopped: another rank met a failure of the granules");
    }

    void find_non_finite(particle::Store const& granules)
    {
        for (std::size_t row = 0; row < granules.owned && failure.empty(); ++row)
            if (!finite(granules.position[row]) || !finite(granules.velocity[row]) || !finite(granules.spin[row]) ||
                !std::isfinite(granules.radius[row]) || !(granules.mass[row] > 0))
                failure = fmt::format("granule {} has a state that is not finite at step {}", granules.id[row], steps);
    }

    void rebuild(particle::Store& granules);
    void compute_forces(particle::Store& granules, double dt);
    void kick(particle::Store& granules, double half);
    long kick_and_drift(particle::Store& granules, double dt);
    void hold_frozen(particle::Store& granules, double dt) const;
};

void Engine::Inside::rebuild(particle::Store& granules)
{
    auto const timing = stopwatch.time(Stage::neighbours);
    find_non_finite(granules);
    long const mine = failure.empty() ? 0 : 2;
    agree_on_failure(mine, comm.max(mine));

    auto const& radii = granules.radius.values;
    auto const owned_end = radii.begin() + static_cast<std::ptrdiff_t>(granules.owned);
    double const largest = comm.max(granules.owned > 0 ? *std::max_element(radii.begin(), owned_end) : 0.0);
    skin = settings.skin > 0 ? settings.skin : 0.5 * largest;
    double const reach = 2 * largest + skin;
    halo.check_width(largest, reach);

    saved.collect(contacts, granules);
    halo.settle(granules, saved, attachments);
    reorder(granules, search.sorted_rows(granules, reach));
    halo.fill(granules, reach);

    search.pairs(granules, reach, skin, contacts.pairs);
    contacts.touching.assign(contacts.pairs.size(), 0);
    contacts.history.resize(contacts.pairs.size());
    for (std::size_t k = 0; k < contacts.pairs.size(); ++k) {
        auto const [i, j] = contacts.pairs[k];
        double const sum = granules.radius[i] + granules.radius[j];
        if (norm2(granules.position[i] - granules.position[j]) >= sum * sum) continue;
        if (auto const* history = saved.find(granules.id[i], granules.id[j])) {
            contacts.history[k] = *history;
            contacts.touching[k] = 1;
        }
    }
    contacts.wall_rows.clear();
    for (std::uint32_t row = 0; row < granules.owned; ++row)
        for (std::uint32_t wall = 0; wall < settings.walls.size(); ++wall)
            if (touch(settings.walls[wall].surface, granules.position[row], granules.radius[row] + skin))
                contacts.wall_rows.push_back({row, wall});
    contacts.wall_touching.assign(contacts.wall_rows.size(), 0);
    contacts.wall_history.resize(contacts.wall_rows.size());
    for (std::size_t k = 0; k < contacts.wall_rows.size(); ++k) {
        auto const [row, wall] = contacts.wall_rows[k];
        if (auto const* history = saved.find(granules.id[row], SavedContacts::wall_bit | wall)) {
            contacts.wall_history[k] = *history;
            contacts.wall_touching[k] = 1;
        }
    }
    auto const owned = static_cast<std::ptrdiff_t>(granules.owned);
    built_at.assign(granules.position.values.begin(), granules.position.values.begin() + owned);
    built_radius.assign(radii.begin(), radii.begin() + owned);
    growth = 0;
    ++watch.rebuilds;
}

void Engine::Inside::compute_forces(particle::Store& granules, double dt)
{
    auto const timing = stopwatch.time(Stage::contacts);
    for (std::size_t row = 0; row < granules.owned; ++row) granules.force[row] = granules.mass[row] * settings.gravity;
    std::fill(granules.force.values.begin() + static_cast<std::ptrdiff_t>(granules.owned), granules.force.values.end(),
              Vec3{});
    std::fill(granules.torque.values.begin(), granules.torque.values.end(), Vec3{});
    auto const seen = sweep(granules, contacts, dt);
    watch.largest_overlap = std::max(watch.largest_overlap, seen.largest_overlap);
    if (seen.largest_overlap > settings.warn_overlap) ++watch.warned_overlaps;
    watch.contacts = seen.contacts;
    watch.dissipated += seen.dissipated;
    watch.elastic = seen.elastic;
    watch.wall_force = seen.wall_force;
    if (!seen.failure.empty()) {
        failure = fmt::format(
            "{} at step {}: the time step is too long, the stiffness too low or granules were placed "
            "into each other",
            seen.failure, steps);
        if (comm.size() == 1) throw base::NumericsError(failure);
    }
}

void Engine::Inside::kick(particle::Store& granules, double half)
{
    for (std::size_t row = 0; row < granules.owned; ++row) {
        double const mass = granules.mass[row], radius = granules.radius[row];
        auto& velocity = granules.velocity[row];
        if (granules.groups.gas) {
            double const rate = granules.drag_rate[row];
            Vec3 const& gas = granules.gas_velocity[row];
            Vec3 const given = granules.force[row] + granules.gas_force[row];
            velocity = (velocity + half * (given * (1 / mass) + rate * gas)) * (1 / (1 + half * rate));
            granules.drag_impulse[row] += (mass * half * rate) * (gas - velocity);
        } else {
            velocity += (half / mass) * granules.force[row];
        }
        granules.spin[row] += (half / (0.4 * mass * radius * radius)) * granules.torque[row];
    }
}

long Engine::Inside::kick_and_drift(particle::Store& granules, double dt)
{
    kick(granules, 0.5 * dt);
    double const free = std::max(0.0, 0.5 * skin - growth);
    double farthest2 = 0;
    bool finite_all = true;
    for (std::size_t row = 0; row < granules.owned; ++row) {
        auto& position = granules.position[row];
        position += dt * granules.velocity[row];
        double const moved2 = norm2(position - built_at[row]);
        finite_all = finite_all && std::isfinite(moved2 + norm2(granules.spin[row]));
        farthest2 = std::max(farthest2, moved2);
    }
    if (!finite_all) find_non_finite(granules);
    if (!failure.empty()) return 2;
    return farthest2 > free * free ? 1 : 0;
}

void Engine::Inside::hold_frozen(particle::Store& granules, double dt) const
{
    for (std::size_t row = 0; row < granules.owned; ++row)
        granules.drag_impulse[row] +=
            (granules.mass[row] * granules.drag_rate[row] * dt) * (granules.gas_velocity[row] - granules.velocity[row]);
}

Engine::Engine(Settings settings, par::Slabs const& slabs, par::Communicator const& comm)
    : inside_(std::make_unique<Inside>(std::move(settings), slabs, comm))
{
}

Engine::~Engine() = default;

void Engine::attach(particle::Attachment& attachment)
{
    inside_->attachments.push_back(&attachment);
}

void Engine::prepare(particle::Store& granules)
{
    auto& in = *inside_;
    in.rebuild(granules);
    in.compute_forces(granules, 0);
    long const mine = in.failure.empty() ? 0 : 2;
    in.agree_on_failure(mine, in.comm.max(mine));
}

void Engine::step(particle::Store& granules, double dt)
{
    auto& in = *inside_;
    ++in.steps;
    if (in.settings.frozen) {
        if (granules.groups.gas) in.hold_frozen(granules, dt);
        return;
    }
    long mine = 0;
    {
        auto const timing = in.stopwatch.time(Stage::contacts);
        mine = in.kick_and_drift(granules, dt);
    }
    long const worst = in.comm.size() > 1 ? in.comm.max(mine) : mine;
    in.agree_on_failure(mine, worst);
    if (worst == 1) {
        in.rebuild(granules);
    } else {
        auto const timing = in.stopwatch.time(Stage::neighbours);
        in.halo.refresh_motion(granules);
    }
    in.compute_forces(granules, dt);
    auto const timing = in.stopwatch.time(Stage::contacts);
    in.kick(granules, 0.5 * dt);
}

void Engine::changed(particle::Store& granules)
{
    auto& in = *inside_;
    double growth = 0;
    for (std::size_t row = 0; row < granules.owned; ++row)
        growth = std::max(growth, granules.radius[row] - in.built_radius[row]);
    in.growth = in.comm.max(growth);
    if (in.growth > 0.25 * in.skin)
        in.rebuild(granules);
    else
        in.halo.refresh_all(granules);
}

void Engine::bring_home(particle::Store& granules)
{
    auto& in = *inside_;
    if (in.comm.max(in.halo.strayed(granules) ? 1L : 0L) > 0) in.rebuild(granules);
}

ContactStore const& Engine::contacts() const
{
    return inside_->contacts;
}
Settings const& Engine::settings() const
{
    return inside_->settings;
}
Watch& Engine::watch()
{
    return inside_->watch;
}
base::Stopwatch& Engine::stopwatch()
{
    return inside_->stopwatch;
}
}
