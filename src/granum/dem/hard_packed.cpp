#include "granum/dem/hard_packed.hpp"

#include <algorithm>
#include <cmath>

namespace granum::dem
{
namespace
{
// Spheres may lie in each other by this part of the sum of their radii: it is what rounding needs, and of the smaller
// of two radii in the ratio ten it is less than 1e-9.
constexpr double rounding = 2e-11;

// In time-driven steps spheres keep this part of the sum of their radii between their surfaces: what the rounds of
// impulses and displacements leave undone then uses up air, not matter.
constexpr double cushion = 1e-4;
}

double HardPacked::step_length(double left) const
{
    auto const& state = world_.state;
    double length = left;
    double smallest = state.body[0].radius, fastest = 0, strongest = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        smallest = std::min(smallest, state.body[i].radius);
        fastest = std::max(fastest, norm2(state.body[i].v));
        strongest = std::max(strongest, norm2(state.acceleration(i)));
    }
    double const most = 0.05 * smallest;
    if (fastest > 0) length = std::min(length, 0.5 * most / std::sqrt(fastest));
    if (strongest > 0) length = std::min(length, 0.1 * std::sqrt(most / std::sqrt(strongest)));
    return length;
}

void HardPacked::list_neighbours(double now)
{
    auto const& state = world_.state;
    double smallest = state.body[0].radius;
    for (auto const& body : state.body) smallest = std::min(smallest, body.radius);
    skin_ = 0.4 * smallest;
    moved_ = 0;
    cells_.build(state, now, skin_);
    near_.clear();
    for (std::size_t i = 0; i < state.size(); ++i)
        cells_.near(i, [&](std::size_t j, Vec3 const& shift) {
            if (j < i) return;
            double const reach = state.body[i].radius + state.body[j].radius + skin_;
            if (norm2(state.body[j].x + shift - state.body[i].x) < reach * reach)
                near_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
        });
}

void HardPacked::find_contacts(double reach)
{
    auto const& state = world_.state;
    contacts_.clear();
    for (auto const& [i, j] : near_) {
        Vec3 const apart = state.nearest(state.body[j].x - state.body[i].x);
        double const sum = state.body[i].radius + state.body[j].radius, distance2 = norm2(apart);
        if (distance2 >= (sum + reach) * (sum + reach)) continue;
        double const distance = std::sqrt(distance2);
        contacts_.push_back({i, j, (1 / distance) * apart, distance - sum, false});
    }
    for (std::size_t i = 0; i < state.size(); ++i)
        for (std::size_t wall = 0; wall < world_.walls.size(); ++wall) {
            auto const touch = world_.walls.touch(wall, state.body[i].x, state.body[i].radius);
            if (!touch || touch->distance >= state.body[i].radius + reach) continue;
            contacts_.push_back({static_cast<std::uint32_t>(i), wall_first + static_cast<std::uint32_t>(wall),
                                 -touch->normal, touch->distance - state.body[i].radius, false});
        }
    for (auto const& contact : contacts_) {
        double smaller = state.body[contact.first].radius;
        if (contact.second < wall_first) smaller = std::min(smaller, state.body[contact.second].radius);
        world_.see_overlap(-contact.gap, smaller);
    }
}

// Returns whether the contact had to be pushed by more than `done`. Below `slow` there is no bounce.
bool HardPacked::push_apart(Contact& contact, double step, double slow, double done)
{
    auto& state = world_.state;
    std::size_t const i = contact.first, j = contact.second;
    bool const wall = contact.second >= wall_first;
    double const sum = state.body[i].radius + (wall ? 0 : state.body[j].radius);
    Vec3 const& n = contact.n;
    Vec3 const slip = wall ? world_.slip(i, n) : world_.slip(i, j, n);
    double const approach = dot(slip, n), allowed = std::max(contact.gap - cushion * sum, 0.0) / step;
    if (approach <= allowed) return false;
    auto pair =
        world_.pair(state.material[i], wall ? world_.walls.material(contact.second - wall_first) : state.material[j]);
    bool const bounces = !contact.bounced && approach > slow;
    if (!bounces) {
        pair.restitution = -allowed / approach;  // what is left of the approach closes the gap by the end of the step
        pair.tangential_restitution = 0;
    }
    double const mass = wall ? state.mass[i] : world_.reduced_mass(i, j);
    auto const [impulse, lost] = world_.bounce(pair, mass, n, slip);
    if (wall) {
        world_.push_off(i, contact.second - wall_first, n, impulse);
    } else {
        world_.push(i, n, impulse);
        world_.push(j, -n, -impulse);
    }
    world_.watch.dissipated += lost;
    touched_[i] = 1;
    if (!wall) touched_[j] = 1;
    if (bounces) {
        contact.bounced = true;
        ++(wall ? world_.watch.wall_collisions : world_.watch.collisions);
    }
    return approach - allowed > done;
}

void HardPacked::exchange_impulses(double step)
{
    auto const& state = world_.state;
    double strongest = 0, fastest = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        strongest = std::max(strongest, norm2(state.acceleration(i)));
        fastest = std::max(fastest, norm2(state.body[i].v));
    }
    double const gained = std::sqrt(strongest) * step, done = 1e-3 * gained + 1e-9 * std::sqrt(fastest);
    for (int round = 0; round < 200; ++round) {
        bool again = false;
        for (std::size_t k = 0; k < contacts_.size(); ++k) {
            auto& contact = contacts_[round % 2 == 0 ? k : contacts_.size() - 1 - k];
            again = push_apart(contact, step, 4 * gained, done) || again;
        }
        if (!again) break;
    }
}

void HardPacked::displace(double step, double reach)
{
    auto const& state = world_.state;
    for (std::size_t i = 0; i < state.size(); ++i) {
        // Who touched nobody flies on its parabola; who did moves with the velocity that its contacts allow.
        displacement_[i] =
            touched_[i] ? step * state.body[i].v : step * (before_[i] + (0.5 * step) * state.acceleration(i));
        double const size = norm(displacement_[i]);
        if (size > 0.4 * reach) displacement_[i] *= 0.4 * reach / size;
    }
}

void HardPacked::separate()
{
    auto const& state = world_.state;
    for (int round = 0; round < 60; ++round) {
        bool again = false;
        for (auto const& contact : contacts_) {
            std::size_t const i = contact.first, j = contact.second;
            double const radius = state.body[i].radius;
            if (contact.second >= wall_first) {
                auto const touch =
                    world_.walls.touch(contact.second - wall_first, state.body[i].x + displacement_[i], radius);
                double const lacking = touch ? radius * (1 + cushion) - touch->distance : 0;
                if (lacking <= 0) continue;
                displacement_[i] += lacking * touch->normal;
                again = again || lacking > 0.3 * cushion * radius;
                continue;
            }
            double const wanted = (radius + state.body[j].radius) * (1 + cushion);
            Vec3 const apart = state.nearest(state.body[j].x + displacement_[j] - state.body[i].x - displacement_[i]);
            double const distance2 = norm2(apart);
            if (distance2 >= wanted * wanted) continue;
            double const distance = std::sqrt(distance2), lacking = wanted - distance;
            Vec3 const n = (1 / distance) * apart;
            double const to_i = state.mass[j] / (state.mass[i] + state.mass[j]);
            displacement_[i] -= (to_i * lacking) * n;
            displacement_[j] += ((1 - to_i) * lacking) * n;
            again = again || lacking > 0.3 * cushion * wanted;
        }
        if (!again) return;
    }
}

void HardPacked::hold_back()
{
    auto const& state = world_.state;
    std::fill(share_.begin(), share_.end(), 1.0);
    // Where everybody stays no two overlap; shares fall by halves and then to nothing, so that this comes to an end.
    for (bool again = true; again;) {
        again = false;
        for (auto const& contact : contacts_) {
            std::size_t const i = contact.first, j = contact.second;
            Vec3 const x = state.body[i].x + share_[i] * displacement_[i];
            double allowed = state.body[i].radius, distance;
            bool const wall = contact.second >= wall_first;
            if (wall) {
                auto const touch = world_.walls.touch(contact.second - wall_first, x, allowed);
                distance = touch ? touch->distance : 2 * allowed;
            } else {
                allowed += state.body[j].radius;
                distance = norm(state.nearest(state.body[j].x + share_[j] * displacement_[j] - x));
            }
            if (distance >= allowed * (1 - rounding)) continue;
            if (share_[i] == 0 && (wall || share_[j] == 0)) continue;
            for (std::size_t const k : {i, wall ? i : j}) share_[k] = share_[k] > 0.02 ? 0.5 * share_[k] : 0;
            ++world_.watch.held_back;
            again = true;
        }
    }
}

double HardPacked::advance(double now, double until, int& steps)
{
    auto& state = world_.state;
    std::size_t const number = state.size();
    before_.resize(number);
    displacement_.resize(number);
    share_.resize(number);
    moved_ = skin_ = 0;
    while (now < until && steps > 0) {
        double const step = step_length(until - now);
        double fastest = 0, smallest = state.body[0].radius;
        touched_.assign(number, 0);
        for (std::size_t i = 0; i < number; ++i) {
            before_[i] = state.body[i].v;
            state.body[i].v += step * state.acceleration(i);
            fastest = std::max(fastest, norm2(state.body[i].v));
            smallest = std::min(smallest, state.body[i].radius);
        }
        double const reach = std::max(4 * step * std::sqrt(fastest), 0.01 * smallest);
        if (2 * moved_ + reach > skin_) list_neighbours(now);
        find_contacts(reach);
        exchange_impulses(step);
        displace(step, reach);
        separate();
        hold_back();
        double farthest = 0;
        now = step < until - now ? now + step : until;
        for (std::size_t i = 0; i < number; ++i) {
            Vec3 const by = share_[i] * displacement_[i];
            farthest = std::max(farthest, norm2(by));
            state.body[i].x += by;
            // The kick gave the energy of a free fall; what the sphere fell less, or was lifted, it does not have.
            Vec3 const& a = state.acceleration(i);
            world_.watch.dissipated += state.mass[i] * dot(a, by - step * (before_[i] + (0.5 * step) * a));
            state.body[i].t = now;
        }
        moved_ += std::sqrt(farthest);
        world_.watch.time_driven += step;
        ++world_.watch.time_driven_steps;
        --steps;
    }
    return now;
}
}
