#include "granum/dem/hard_flight.hpp"

#include "granum/base/error.hpp"
#include "granum/math/first_fall.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
using math::never;

void HardFlight::start(double now, double horizon)
{
    auto& state = world_.state;
    std::size_t const number = state.size();
    horizon_ = horizon;
    for (std::size_t i = 0; i < number; ++i) state.bring(i, now);
    cells_.build(state, now, 0);
    next_.assign(number, {never, nobody, 0});
    exit_.assign(number, {never, -1, 0});
    hits_.assign(number, 0);
    queue_.fill(std::vector<double>(number, never));
    for (std::size_t i = 0; i < number; ++i) predict(i, now);
}

void HardFlight::look_for_exit(std::size_t i, double now)
{
    auto const& state = world_.state;
    exit_[i] = cells_.exit(state, i);
    if (exit_[i].time < never || !world_.walls.curved()) return;
    // A sphere that never leaves its cell still has to look at curved walls now and then.
    HardBody const& body = state.body[i];
    double const speed = norm(body.v), acceleration = norm(state.acceleration(i));
    double const soon = std::min(speed > 0 ? 100 * body.radius / speed : never,
                                 acceleration > 0 ? std::sqrt(100 * body.radius / acceleration) : never);
    exit_[i] = {now + soon, -1, 0};
}

// What sphere i, whose row is at `now`, sees of its neighbours; called for each of them, so all it needs is at hand.
struct HardFlight::Lookout
{
    HardFlight& flight;
    HardBody const* body;
    Next const* next;
    HardBody const a;
    Vec3 const common;
    std::size_t i;
    double now;
    Next best;

    Lookout(HardFlight& from, std::size_t who, double time, Next const& first)
        : flight(from),
          body(from.world_.state.body.data()),
          next(from.next_.data()),
          a(body[who]),
          common(from.world_.state.common),
          i(who),
          now(time),
          best(first)
    {
    }

    void consider(std::size_t j, double time)
    {
        // A partner that is in a collision before this one looks again then, and finds this one if it still comes.
        if (time < best.time && time < next[j].time) best = {time, static_cast<std::uint32_t>(j), flight.hits_[j]};
    }
    void overlap(double room, double sum, double other)
    {
        flight.world_.see_overlap(-0.5 * room / sum, std::min(a.radius, other));
    }
};

// All spheres have the same acceleration: two of them move past each other on straight lines.
struct HardFlight::Straight : Lookout
{
    using Lookout::Lookout;

    void operator()(std::size_t j, Vec3 const& shift)
    {
        HardBody const& b = body[j];
        double const s = now - b.t, sum = a.radius + b.radius;
        Vec3 const relative = b.v + s * common - a.v;
        Vec3 const apart = b.x + s * (b.v + (0.5 * s) * common) - a.x + shift;
        double const closing = dot(apart, relative);
        if (closing >= 0) return;
        double const room = norm2(apart) - sum * sum;
        if (room <= 0) {
            overlap(room, sum, b.radius);
            consider(j, now);
            return;
        }
        double const discriminant = closing * closing - norm2(relative) * room;
        if (discriminant >= 0) consider(j, now + room / (std::sqrt(discriminant) - closing));
    }
};

// Each has its own acceleration until the horizon.
struct HardFlight::Bent : Lookout
{
    using Lookout::Lookout;

    void operator()(std::size_t j, Vec3 const& shift)
    {
        auto const& own = flight.world_.state.own;
        HardBody const& b = body[j];
        double const longest = std::min({best.time, next[j].time, flight.horizon_}) - now;
        if (longest < 0) return;
        double const s = now - b.t, sum = a.radius + b.radius;
        Vec3 const relative = b.v + s * own[j] - a.v, change = own[j] - own[i];
        Vec3 const apart = b.x + s * (b.v + (0.5 * s) * own[j]) - a.x + shift;
        double const travel = longest * (norm(relative) + 0.5 * longest * norm(change));
        if (norm2(apart) > (sum + travel) * (sum + travel)) return;
        double const room = norm2(apart) - sum * sum;
        if (room < 0) overlap(room, sum, b.radius);
        double const time = math::first_fall({room, 2 * dot(apart, relative), norm2(relative) + dot(apart, change),
                                              dot(relative, change), 0.25 * norm2(change)},
                                             longest);
        consider(j, now + time);
    }
};

void HardFlight::predict(std::size_t i, double now)
{
    look_for_exit(i, now);
    Next best{never, nobody, 0};
    predict_walls(i, now, best);
    if (world_.state.uniform()) {
        Straight look(*this, i, now, best);
        cells_.near(i, look);
        settle(i, look.best);
    } else {
        Bent look(*this, i, now, best);
        cells_.near(i, look);
        settle(i, look.best);
    }
}

void HardFlight::predict_walls(std::size_t i, double now, Next& best) const
{
    auto const& body = world_.state.body[i];
    for (std::size_t wall = 0; wall < world_.walls.size(); ++wall) {
        double const longest = std::min(best.time, exit_[i].time) - now;
        double const time =
            now + world_.walls.meeting(wall, body.x, body.v, world_.state.acceleration(i), body.radius, longest);
        if (time < best.time) best = {time, wall_first + static_cast<std::uint32_t>(wall), 0};
    }
}

void HardFlight::settle(std::size_t i, Next const& best)
{
    next_[i] = best;
    queue(i);
    if (best.partner >= wall_first) return;
    next_[best.partner] = {best.time, static_cast<std::uint32_t>(i), hits_[i]};
    queue(best.partner);
}

void HardFlight::leave(std::size_t i, double now)
{
    auto const through = exit_[i];
    world_.state.bring(i, now);
    if (through.axis >= 0) cells_.pass(world_.state, i, through);
    look_for_exit(i, now);
    Next best = next_[i];
    predict_walls(i, now, best);
    if (through.axis >= 0 && world_.state.uniform()) {
        Straight look(*this, i, now, best);
        cells_.newly_near(i, through, look);
        best = look.best;
    } else if (through.axis >= 0) {
        Bent look(*this, i, now, best);
        cells_.newly_near(i, through, look);
        best = look.best;
    }
    if (best.time < next_[i].time)
        settle(i, best);
    else
        queue(i);
}

void HardFlight::collide(std::size_t i, std::size_t j, double now)
{
    auto& state = world_.state;
    state.bring(i, now);
    state.bring(j, now);
    Vec3 const apart = state.nearest(state.body[j].x - state.body[i].x);
    double const distance = norm(apart), sum = state.body[i].radius + state.body[j].radius;
    world_.see_overlap(sum - distance, std::min(state.body[i].radius, state.body[j].radius));
    Vec3 const n = (1 / distance) * apart;
    auto pair = world_.pair(state.material[i], state.material[j]);
    if (now - std::max(state.last[i], state.last[j]) < world_.contact_time) {
        pair.restitution = 1;
        ++world_.watch.kept_elastic;
    }
    double const mass = world_.reduced_mass(i, j);
    auto [impulse, lost] = world_.bounce(pair, mass, n, world_.slip(i, j, n));
    // Spheres that an acceleration presses together part at least so fast that the next meeting is a contact time away.
    Vec3 const relative = state.body[i].v - state.body[j].v;
    double const approach = dot(relative, n), parting = -(approach + dot(impulse, n) / mass);
    double const pressing =
        dot(state.acceleration(i) - state.acceleration(j), n) - (norm2(relative) - approach * approach) / sum;
    double const least = state.uniform() ? 0 : 0.5 * pressing * world_.contact_time;
    if (parting < least) {
        impulse -= (mass * (least - parting)) * n;
        lost -= 0.5 * mass * (least * least - parting * parting);
    }
    world_.push(i, n, impulse);
    world_.push(j, -n, -impulse);
    world_.watch.dissipated += lost;
    state.last[i] = state.last[j] = now;
    ++hits_[i], ++hits_[j];
    ++world_.watch.collisions;
}

void HardFlight::collide_wall(std::size_t i, std::size_t wall, double now)
{
    auto& state = world_.state;
    state.bring(i, now);
    auto const& body = state.body[i];
    ++hits_[i];
    auto const touch = world_.walls.touch(wall, body.x, body.radius);
    if (!touch) return;
    world_.see_overlap(body.radius - touch->distance, body.radius);
    Vec3 const n = -touch->normal;
    auto pair = world_.pair(state.material[i], world_.walls.material(wall));
    if (now - state.last[i] < world_.contact_time) {
        pair.restitution = 1;
        ++world_.watch.kept_elastic;
    }
    double const mass = state.mass[i];
    auto [impulse, lost] = world_.bounce(pair, mass, n, world_.slip(i, n));
    double const approach = dot(body.v, n), parting = -(approach + dot(impulse, n) / mass);
    double const pressing = dot(state.acceleration(i), n) +
                            (norm2(body.v) - approach * approach) * world_.walls.curvature(wall, body.x, *touch);
    double const least = 0.5 * pressing * world_.contact_time;
    if (parting < least) {
        impulse -= (mass * (least - parting)) * n;
        lost -= 0.5 * mass * (least * least - parting * parting);
    }
    world_.push_off(i, wall, n, impulse);
    world_.watch.dissipated += lost;
    state.last[i] = now;
    ++world_.watch.wall_collisions;
}

double HardFlight::advance(double now, double until)
{
    auto& state = world_.state;
    if (state.size() == 0) return until;
    auto const number = static_cast<double>(state.size());
    long const window = std::max(1000L, 2 * static_cast<long>(state.size()));
    while (queue_.first_time() <= until) {
        std::size_t const i = queue_.first();
        now = std::max(now, queue_.first_time());
        if (exit_[i].time < next_[i].time) {
            leave(i, now);
            continue;
        }
        Next const event = next_[i];
        if (event.partner < wall_first) {
            std::size_t const j = event.partner;
            if (hits_[j] != event.hits) {
                state.bring(i, now);
                predict(i, now);
                continue;
            }
            collide(i, j, now);
            next_[i].time = next_[j].time = never;
            predict(i, now);
            predict(j, now);
        } else {
            collide_wall(i, event.partner - wall_first, now);
            predict(i, now);
        }
        if (++pace.collisions < window) continue;
        // The mean time between collisions of one sphere over the window; each concerns two.
        double const mean = 0.5 * number * (now - pace.since) / static_cast<double>(pace.collisions);
        pace = {0, now};
        if (mean > 10 * world_.contact_time) continue;
        for (std::size_t k = 0; k < state.size(); ++k) state.bring(k, now);
        return now;
    }
    return until;
}

}
