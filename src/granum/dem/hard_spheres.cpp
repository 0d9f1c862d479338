#include "granum/dem/hard_spheres.hpp"

#include "granum/base/error.hpp"
#include "granum/dem/hard_flight.hpp"
#include "granum/dem/hard_packed.hpp"
#include "granum/math/first_fall.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
struct HardSpheres::Inside
{
    Settings settings;
    HardWorld world;
    HardFlight flight{world};
    HardPacked packed{world};
    base::Stopwatch stopwatch;
    std::vector<Vec3> drag;  // acceleration by drag, held over the step, m/s2
    int packed_steps = 0;    // time-driven steps that are left before flight is tried again

    Inside(Settings given, HardOptions const& options)
        : settings(std::move(given)),
          world{.state = {}, .walls = HardWalls(settings.walls), .bounce = {}, .table = {}, .watch = {}}
    {
        world.contact_time = options.contact_time;
        world.materials = settings.laws.materials.size();
        for (std::uint32_t a = 0; a < world.materials; ++a)
            for (std::uint32_t b = 0; b < world.materials; ++b) {
                auto const& pair = settings.laws.pair(a, b);
                world.table.push_back({pair.restitution, pair.sliding_friction, options.tangential_restitution});
            }
        world.state.lower = settings.lower;
        world.state.upper = settings.upper;
        world.state.periodic = settings.periodic;
        world.state.common = settings.gravity;
    }

    void take(particle::Store const& granules);
    void check(particle::Store const& granules) const;
    void accelerate(particle::Store const& granules, double dt);
    double longest_span() const;
    void run(double dt);
    void give(particle::Store& granules, double dt);
};

void HardSpheres::Inside::take(particle::Store const& granules)
{
    auto& state = world.state;
    std::size_t const number = granules.owned;
    state.body.resize(number);
    state.spin.assign(granules.spin.values.begin(), granules.spin.values.begin() + static_cast<std::ptrdiff_t>(number));
    state.mass.assign(granules.mass.values.begin(), granules.mass.values.begin() + static_cast<std::ptrdiff_t>(number));
    state.material.assign(granules.material.values.begin(),
                          granules.material.values.begin() + static_cast<std::ptrdiff_t>(number));
    state.last.assign(number, -math::never);
    for (std::size_t i = 0; i < number; ++i) {
        Vec3 x = granules.position[i];
        for (std::size_t d = 0; d < 3; ++d)
            if (state.periodic[d]) {
                double const width = state.upper[d] - state.lower[d];
                if (x[d] < state.lower[d] || x[d] >= state.upper[d])
                    x[d] -= width * std::floor((x[d] - state.lower[d]) / width);
            }
        state.body[i] = {x, granules.velocity[i], 0, granules.radius[i]};
    }
    state.own.clear();
}

void HardSpheres::Inside::check(particle::Store const& granules) const
{
    auto const& state = world.state;
    double largest = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        auto const& body = state.body[i];
        base::require(finite(body.x) && finite(body.v) && finite(state.spin[i]) && body.radius > 0 &&
                          state.mass[i] > 0 && std::isfinite(body.radius + state.mass[i]),
                      "granule {} has a state that is not finite", granules.id[i]);
        base::require(state.material[i] < world.materials, "granule {} has a material that there is not",
                      granules.id[i]);
        largest = std::max(largest, body.radius);
    }
    for (std::size_t d = 0; d < 3; ++d)
        base::require(!state.periodic[d] || state.upper[d] - state.lower[d] >= 4 * largest,
                      "the periodic domain is {:.4g} m wide along {}, narrower than two diameters of {:.4g} m",
                      state.upper[d] - state.lower[d], std::string("xyz")[d], 2 * largest);
    HardCells cells;
    cells.build(state, 0, 0);
    constexpr double allowed = 1e-9;  // of the smaller radius
    for (std::size_t i = 0; i < state.size(); ++i) {
        auto const& a = state.body[i];
        cells.near(i, [&](std::size_t j, Vec3 const& shift) {
            auto const& b = state.body[j];
            double const smaller = std::min(a.radius, b.radius), sum = a.radius + b.radius - allowed * smaller;
            double const distance2 = norm2(b.x + shift - a.x);
            base::require(distance2 >= sum * sum,
                          "granules {} and {} overlap by {:.2g} of a radius: hard spheres need a start without "
                          "overlaps",
                          granules.id[i], granules.id[j], (a.radius + b.radius - std::sqrt(distance2)) / smaller);
        });
        for (std::size_t wall = 0; wall < world.walls.size(); ++wall) {
            auto const touch = world.walls.touch(wall, a.x, a.radius);
            base::require(!touch || touch->distance >= (1 - allowed) * a.radius,
                          "granule {} overlaps a wall by {:.2g} of its radius: hard spheres need a start without "
                          "overlaps",
                          granules.id[i], touch ? 1 - touch->distance / a.radius : 0.0);
        }
    }
}

void HardSpheres::Inside::accelerate(particle::Store const& granules, double dt)
{
    if (!granules.groups.gas) return;
    // Implicit in the drag like the kick of the soft engine: at the end of a step without collisions the velocity is
    // (v + dt (F/m + rate u)) / (1 + dt rate).
    auto& state = world.state;
    std::vector<Vec3> own(state.size());
    drag.assign(state.size(), {});
    bool same = true;
    for (std::size_t i = 0; i < state.size(); ++i) {
        double const rate = granules.drag_rate[i];
        Vec3 const steady = settings.gravity + (1 / state.mass[i]) * granules.gas_force[i];
        own[i] = steady;
        if (rate != 0) {
            Vec3 const v = state.velocity(i, 0);
            own[i] = (1 / (1 + dt * rate)) * (steady + rate * (granules.gas_velocity[i] - v));
            drag[i] = own[i] - steady;
        }
        same = same && own[i] == own[0];
    }
    Vec3 const common = own.empty() ? settings.gravity : own[0];
    if (same && state.uniform() && common == state.common) return;
    for (std::size_t i = 0; i < state.size(); ++i) state.bring(i, 0);
    state.common = common;
    if (same)
        state.own.clear();
    else
        state.own = std::move(own);
}

// Times within a step count up to this, so that they have digits enough, s.
double HardSpheres::Inside::longest_span() const
{
    double smallest = 1, fastest = 1;
    for (auto const& body : world.state.body) {
        smallest = std::min(smallest, body.radius);
        fastest = std::max(fastest, norm(body.v));
    }
    return 1e4 * smallest / fastest;
}

void HardSpheres::Inside::run(double dt)
{
    auto& state = world.state;
    if (state.size() == 0) return;
    double const longest = longest_span();
    for (double left = dt; left > 0;) {
        double const span = std::min(left, longest);
        double now = 0;
        while (now < span) {
            if (packed_steps > 0) {
                now = packed.advance(now, span, packed_steps);
                flight.pace = {0, now};
                continue;
            }
            flight.start(now, span);
            double const reached = flight.advance(now, span);
            if (reached < span) {
                ++world.watch.collapses;
                packed_steps = 200;
            }
            now = reached;
        }
        for (std::size_t i = 0; i < state.size(); ++i) {
            state.bring(i, span);
            state.body[i].t = 0;
            state.last[i] -= span;
        }
        flight.pace.since -= span;
        left = span < left ? left - span : 0;
    }
}

void HardSpheres::Inside::give(particle::Store& granules, double dt)
{
    auto& state = world.state;
    bool good = true;
    for (std::size_t i = 0; i < state.size(); ++i) {
        Vec3& x = state.body[i].x;
        for (std::size_t d = 0; d < 3; ++d) {
            if (!state.periodic[d]) continue;
            double const width = state.upper[d] - state.lower[d];
            if (x[d] < state.lower[d]) x[d] += width;
            if (x[d] >= state.upper[d]) x[d] -= width;
        }
        granules.position[i] = x;
        granules.velocity[i] = state.body[i].v;
        granules.spin[i] = state.spin[i];
        if (granules.groups.gas) granules.drag_impulse[i] += (state.mass[i] * dt) * drag[i];
        good = good && finite(x) && finite(granules.velocity[i]) && finite(granules.spin[i]);
    }
    for (std::size_t i = 0; i < state.size() && !good; ++i)
        base::require(finite(granules.position[i]) && finite(granules.velocity[i]) && finite(granules.spin[i]),
                      "granule {} has a state that is not finite", granules.id[i]);
}

HardSpheres::HardSpheres(Settings settings, HardOptions const& options)
    : inside_(std::make_unique<Inside>(std::move(settings), options))
{
}

HardSpheres::~HardSpheres() = default;

void HardSpheres::prepare(particle::Store& granules)
{
    auto const timing = inside_->stopwatch.time(base::Stage::neighbours);
    auto& in = *inside_;
    in.take(granules);
    in.check(granules);
    in.flight.pace = {};
    in.packed_steps = 0;
}

void HardSpheres::resume(particle::Store& granules, HardMemory const& memory)
{
    prepare(granules);
    auto& in = *inside_;
    in.world.state.last = memory.last;
    in.world.state.last.resize(granules.owned, -math::never);
    in.flight.pace = memory.pace;
    in.packed_steps = memory.packed_steps;
}

HardMemory HardSpheres::memory() const
{
    return {inside_->world.state.last, inside_->flight.pace, inside_->packed_steps};
}

void HardSpheres::step(particle::Store& granules, double dt)
{
    auto& in = *inside_;
    if (in.settings.frozen) return;
    auto const timing = in.stopwatch.time(base::Stage::contacts);
    Vec3 const before = in.world.watch.wall_impulse;
    in.accelerate(granules, dt);
    in.run(dt);
    in.give(granules, dt);
    in.world.watch.wall_force = (1 / dt) * (in.world.watch.wall_impulse - before);
}

void HardSpheres::advance(particle::Store& granules, double dt, long steps)
{
    bool const still = std::all_of(granules.drag_rate.values.begin(), granules.drag_rate.values.end(),
                                   [](double rate) { return rate == 0; });
    if (still)
        step(granules, dt * static_cast<double>(steps));
    else
        for (long k = 0; k < steps; ++k) step(granules, dt);
}

Settings const& HardSpheres::settings() const
{
    return inside_->settings;
}
HardWatch const& HardSpheres::watch() const
{
    return inside_->world.watch;
}
HardWatch& HardSpheres::watch()
{
    return inside_->world.watch;
}
base::Stopwatch& HardSpheres::stopwatch()
{
    return inside_->stopwatch;
}
}
