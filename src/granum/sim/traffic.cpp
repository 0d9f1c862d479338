// Feeds bring granules into their regions as these become free; open faces let granules out.
#include "granum/sim/traffic.hpp"

#include "granum/base/error.hpp"
#include "granum/base/random.hpp"
#include "granum/particle/placer.hpp"
#include "granum/particle/rows.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace granum::sim
{
namespace
{
struct Ball
{
    Vec3 centre;
    double radius;
};

double energy_of(Vec3 const& position, Vec3 const& velocity, Vec3 const& spin, double mass, double radius,
                 Vec3 const& gravity)
{
    return 0.5 * mass * norm2(velocity) + 0.2 * mass * radius * radius * norm2(spin) - mass * dot(gravity, position);
}

//! The granules of all ranks that reach into a region; the same list on every rank.
std::vector<Ball> inside(particle::Store const& granules, RegionCase const& region, par::Communicator const& comm)
{
    std::vector<Ball> mine;
    for (std::size_t row = 0; row < granules.owned; ++row) {
        auto const& x = granules.position[row];
        double const r = granules.radius[row];
        bool near = true;
        for (std::size_t d = 0; d < 3; ++d) near = near && x[d] > region.lower[d] - r && x[d] < region.upper[d] + r;
        if (near) mine.push_back({x, r});
    }
    auto bytes = comm.gather(std::as_bytes(std::span(mine)));
    comm.broadcast(bytes);
    std::vector<Ball> all(bytes.size() / sizeof(Ball));
    if (!bytes.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
    return all;
}

std::string face_name(std::size_t axis, bool high)
{
    static constexpr char const* names[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};
    return names[axis][high ? 1 : 0];
}
}

bool Simulation::feed(Feed& feed, double now)
{
    auto const& how = feed.how;
    if (feed.done() || now < how.start || now > how.stop) return false;
    double const due = how.rate > 0 ? how.rate * (now - how.start) : std::numeric_limits<double>::infinity();
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    std::vector<double> radii;
    double mass = feed.mass;
    for (std::size_t k = feed.placed; k < feed.granules.size() && mass < due; ++k) {
        auto const& one = feed.granules[k];
        radii.push_back(0.5 * one.diameter * std::cbrt(one.count));
        smallest = std::min(smallest, radii.back()), largest = std::max(largest, radii.back());
        mass += one.count * one.density * math::pi / 6 * one.diameter * one.diameter * one.diameter;
    }
    if (radii.empty()) return false;

    particle::Placer placer(how.region.lower, how.region.upper, smallest, largest);
    for (auto const& ball : inside(granules_, how.region, comm_)) placer.add(ball.centre, ball.radius);
    constexpr int trials = 300;
    std::size_t const rows = granules_.owned;
    granules_.resize(rows);  // ghosts are made anew
    std::size_t placed = 0;
    for (double const radius : radii) {
        auto& one = feed.granules[feed.placed];
        // A try at another time is another draw, so that a granule is not bound to the place where it found no room.
        base::Random random(case_.seed, base::Purpose::packing, one.id, static_cast<std::uint32_t>(2 + feed_rounds_));
        Vec3 const margin{radius, radius, radius};
        auto const place = placer.place(radius, how.region.lower + margin, how.region.upper - margin, random, trials,
                                        [&](Vec3 const& centre) { return (*wall_room_)(centre, radius); });
        if (!place) break;
        one.position = *place;
        one.velocity = how.velocity;
        if (comm_.root()) {  // the engine sends it to its rank
            add_granule(granules_, one);
            granules_.force[granules_.rows() - 1] = {};
        }
        double const own = one.count * one.density * math::pi / 6 * one.diameter * one.diameter * one.diameter;
        feed.mass += own;
        traffic_.fed_mass += own;
        traffic_.fed_energy += energy_of(one.position, one.velocity, {}, own, radius, case_.gravity);
        ++traffic_.fed, ++feed.placed, ++placed;
    }
    granules_.owned = granules_.rows();
    ++feed_rounds_;
    return placed > 0;
}

void Simulation::feed_all(double now)
{
    if (feeds_.empty() || now < next_feed_) return;
    bool changed = false;
    next_feed_ = std::numeric_limits<double>::infinity();
    for (auto& one : feeds_) {
        changed = feed(one, now) || changed;
        if (!one.done() && now < one.how.stop) next_feed_ = std::min(next_feed_, now + one.how.interval);
    }
    if (changed) mover_->prepare(granules_);  // the same on every rank
}

void Simulation::let_out()
{
    Vec3 const lower = case_.chamber.lower(), upper = case_.chamber.upper();
    std::vector<std::uint32_t> stay, leave;
    long parcels = 0;
    std::array<base::ExactSum, 3> gone;  // mass, energy, and that of their contacts
    std::string failure;
    for (std::uint32_t row = 0; row < granules_.owned; ++row) {
        auto const& x = granules_.position[row];
        int face = -1;
        for (std::size_t d = 0; d < 3; ++d) {
            if (case_.periodic[d]) continue;
            if (x[d] < lower[d]) face = static_cast<int>(2 * d);
            if (x[d] > upper[d]) face = static_cast<int>(2 * d + 1);
        }
        if (face < 0) {
            stay.push_back(row);
            continue;
        }
        auto const axis = static_cast<std::size_t>(face) / 2, high = static_cast<std::size_t>(face) % 2;
        bool const open = case_.open[axis][high];
        if ((!open || !case_.discharge) && failure.empty())
            failure = fmt::format(
                "granule {} left the domain through {} {} at {:.6g} s: it is at ({:.6g}, {:.6g}, {:.6g}) m{}",
                granules_.id[row], open ? "the open face" : "the wall", face_name(axis, high), time_, x.x, x.y, x.z,
                open ? "; apparatus.leaving = \"discharge\" counts such granules" : "");
        leave.push_back(row);
    }
    for (auto const row : leave) {
        double const mass = granules_.mass[row];
        ++parcels;
        gone[0].add(mass);
        gone[1].add(energy_of(granules_.position[row], granules_.velocity[row], granules_.spin[row], mass,
                              granules_.radius[row], case_.gravity));
    }
    if (auto const said = comm_.first_said(failure); !said.empty()) throw base::NumericsError(said);
    parcels = comm_.sum(parcels);
    if (parcels == 0) return;
    auto& watch = mover_->watch();
    gone[2] = watch.elastic;
    particle::reorder(granules_, stay);
    mover_->prepare(granules_);
    gone[2].subtract(watch.elastic);
    comm_.sum(gone);
    traffic_.left += parcels;
    traffic_.left_mass += gone[0].value(), traffic_.left_energy += gone[1].value() + gone[2].value();
}
}
