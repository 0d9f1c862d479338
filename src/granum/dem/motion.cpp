// Moving granules on: layer by layer, one step at a time or several in one sweep.
#include "granum/dem/engine_inside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace granum::dem
{
using base::Stage;

namespace
{
constexpr int most_steps = Layers::most_steps;
}

// Kicks the granules of a part of a layer, `kicks` halves of a step, and lets them drift by a step. Answers what part
// of its room any has used up.
double Engine::Inside::move(double dt, Layers::Part const& part, int kicks, bool drifts)
{
    auto const rows = layers.rows(part);
    double const drift = drifts ? dt : 0;
    kernel::MotionSeen seen;
    kernel->move({.bodies = frame.bodies.data(),
                  .rows = rows.data(),
                  .count = rows.size(),
                  .gravity = {settings.gravity.x, settings.gravity.y, settings.gravity.z},
                  .half = 0.5 * dt,
                  .drift = drift,
                  .kicks = kicks,
                  .clear = drifts,
                  .gas = gas.of_velocities(),
                  .turn = gas.of_spins()},
                 seen);
    if (!seen.finite) find_non_finite();
    if (drifts && images.any)
        for (auto const row : rows) frame.wrap(domain, row);
    return std::sqrt(seen.hastiest2) * drift;
}

double Engine::Inside::move_all(double dt, int kicks, bool drifts)
{
    auto const timing = stopwatch.time(Stage::contacts);
    double moved = 0;
    for (std::size_t layer = 0; layer < layers.count(); ++layer)
        moved = std::max(moved, move(dt, layers.whole(layer), kicks, drifts));
    return moved;
}

// What part of its room any granule of any rank will use up in the first step of a call, where others may have changed
// its velocity and the gas: what the first kick makes of it. Collective.
double Engine::Inside::first_move(double dt)
{
    double const half = 0.5 * dt;
    double hastiest2 = 0;
    constexpr double infinite = std::numeric_limits<double>::infinity();  // what is not finite asks for a single step
    for (std::size_t row = 0; row < frame.owned; ++row) {
        auto const& body = frame.bodies[row];
        kernel::Drag const* const drag = gas.of_velocities() ? gas.of_velocities() + row : nullptr;
        double const push = drag ? drag->push : half * body.inverse_mass;
        double speed2 = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            double v = body.velocity[d] + push * body.force[d];
            v += drag ? drag->pull[d] - drag->share * v : half * settings.gravity[d];
            speed2 += v * v;
        }
        hastiest2 = std::max(hastiest2, std::isfinite(speed2) ? speed2 * body.per_room2 : infinite);
    }
    return comm.max(std::sqrt(hastiest2) * dt);
}

// How many of the `left` steps the next sweep does: as many as the list will do for with some reserve, since nobody
// looks at it on the way; the last sweeps of a call share what is left alike.
int Engine::Inside::steps_together(int left) const
{
    if (walls.any_motion()) return 1;
    double const left_over = std::max(0.0, free() - travelled), each = reserve * last_moved;
    int const sweeps = (left + most_steps - 1) / most_steps, together = (left + sweeps - 1) / sweeps;
    return each * together <= left_over ? together : std::max(1, static_cast<int>(left_over / each));
}

// Does `together` steps in one sweep over the layers: layer k takes its step t when layer k + 1 has taken step t - 1.
// Ranks exchange layer 0 in each step, which all of them take up first; while the last messages are on their way, the
// other layers go on, strip by strip.
// `first`: it begins a call of advance(), with one kick.
void Engine::Inside::sweep(double dt, int together, bool first)
{
    auto const timing = stopwatch.time(Stage::contacts);
    std::array<kernel::Seen, most_steps> seen;
    std::array<double, most_steps + 1> moved{};  // by step; the last: whether something failed
    auto const steps_of_sweep = static_cast<std::size_t>(together);
    long const before = steps;
    ++watch.sweeps;
    bool const many = comm.size() > 1;
    auto const move_on = [&](Layers::Part const& part, std::size_t t) {
        steps = before + static_cast<long>(t) + 1;
        moved[t] = std::max(moved[t], move(dt, part, first && t == 0 ? 1 : 2, true));
    };
    auto const take_exchanged = [&](std::size_t t) {
        if (many) halo.end_refresh(frame);
        forces(layers.whole(0), false, dt, seen[t]);
    };
    for (std::size_t front = 0; front < steps_of_sweep; ++front)
        for (std::size_t t = 0; t <= front; ++t) {
            std::size_t const layer = front - t;
            if (layer >= layers.count()) continue;
            if (layer == 0 && t > 0) take_exchanged(t - 1);
            move_on(layers.whole(layer), t);
            if (layer > 0)
                forces(layers.whole(layer), false, dt, seen[t]);
            else if (many)
                halo.begin_refresh(frame);
        }
    for (std::size_t strip = 0; strip < layers.strips(); ++strip)
        for (std::size_t front = steps_of_sweep; front < layers.count() + steps_of_sweep; ++front) {
            for (std::size_t t = 0; t < steps_of_sweep; ++t) {
                std::size_t const layer = front - t;
                if (layer >= layers.count()) continue;
                auto const part = layers.part(strip, layer, t);
                move_on(part, t);
                forces(part, front > steps_of_sweep, dt, seen[t]);
            }
            if (strip == 0 && front == steps_of_sweep) take_exchanged(steps_of_sweep - 1);
        }
    for (std::size_t t = 0; t < steps_of_sweep; ++t) {
        steps = before + static_cast<long>(t) + 1;
        time += dt;
        finish_forces(dt, seen[t]);
    }
    walls.go_to(time, dt);
    moved.back() = failure.empty() ? 0 : 1;
    if (comm.size() > 1)
        MPI_Allreduce(MPI_IN_PLACE, moved.data(), static_cast<int>(moved.size()), MPI_DOUBLE, MPI_MAX, comm.handle());
    if (moved.back() > 0) agree_on_failure();
    for (std::size_t t = 0; t < steps_of_sweep; ++t) travelled += moved[t];
    last_moved = moved[steps_of_sweep - 1];
    if (travelled > free() && (travelled = comm.max(farthest())) > free()) {
        ++watch.late_lists;
        reserve *= 2;
    }
}
}
