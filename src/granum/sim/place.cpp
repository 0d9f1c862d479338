// Granules where the case wants them at time zero, and how they come to rest there.
#include "granum/base/error.hpp"
#include "granum/base/random.hpp"
#include "granum/particle/generate.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/simulation.hpp"
#include "granum/sim/stop.hpp"
#include "granum/sim/wall_room.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace granum::sim
{
namespace
{
constexpr double longest_pour = 100;  // s, before the run

double cube(double x)
{
    return x * x * x;
}

//! Every granule of the batches without its place; identities run through the batches. Diameters are drawn one from
//! each of equal shares of the distribution, in random order: the drawn sizes follow the distribution closely, and are
//! a function of the seed.
std::vector<GranuleCase> drawn(Case const& data)
{
    std::vector<GranuleCase> out;
    out.reserve(static_cast<std::size_t>(data.granules.parcels));
    for (auto const& batch : data.granules.batches) {
        auto const rows = static_cast<std::size_t>(batch.parcels);
        std::size_t const first = out.size();
        std::vector<std::pair<double, std::uint32_t>> keys(rows);
        for (std::size_t k = 0; k < rows; ++k)
            keys[k] = {base::Random(data.seed, base::Purpose::sizes, first + k, 1).uniform(),
                       static_cast<std::uint32_t>(k)};
        if (batch.sizes.smallest() < batch.sizes.largest()) std::sort(keys.begin(), keys.end());
        for (std::size_t k = 0; k < rows; ++k) {
            base::Random random(data.seed, base::Purpose::sizes, first + k, 0);
            double const share = (static_cast<double>(keys[k].second) + random.uniform()) / static_cast<double>(rows);
            out.push_back({.diameter = batch.sizes.diameter(share),
                           .density = batch.density,
                           .count = cube(batch.parcel_ratio),
                           .id = first + k,
                           .material = batch.material});
        }
    }
    return out;
}

//! The whole batch is one size and the chamber is empty: a dense, cheap arrangement serves, and the parcels share the
//! batch out to the last digit.
bool plain(Case const& data)
{
    auto const& granules = data.granules;
    return granules.batches.size() == 1 && !granules.region && data.walls.empty() &&
           granules.batches[0].sizes.smallest() == granules.batches[0].sizes.largest();
}

void arrange(Case const& data, std::vector<GranuleCase>& list)
{
    auto const& granules = data.granules;
    auto const& chamber = data.chamber;
    std::vector<double> radii;
    radii.reserve(list.size());
    for (auto& one : list) {
        if (plain(data))
            one.count = granules.mass / granules.density / (math::pi / 6 * cube(one.diameter)) /
                        static_cast<double>(list.size());
        radii.push_back(0.5 * one.diameter * std::cbrt(one.count));
    }
    double const largest = *std::max_element(radii.begin(), radii.end());
    auto const count = static_cast<long>(list.size());
    std::vector<Vec3> places;
    if (granules.start == "lattice") {
        places = particle::lattice(chamber, largest, 2 * granules.spacing * largest, count, granules.noise, data.seed);
    } else if (plain(data)) {
        places = particle::random_loose(chamber, largest, count, data.seed);
    } else {
        auto const box = granules.region.value_or(RegionCase{chamber.lower(), chamber.upper()});
        places = particle::random_places({box.lower, box.upper, WallRoom(data)}, radii, data.seed);
    }
    for (std::size_t k = 0; k < list.size(); ++k) list[k].position = places[k];
}

//! Gives them random velocities (a Maxwell distribution) without a common motion.
void agitate(double speed, std::uint32_t seed, std::vector<GranuleCase>& list)
{
    Vec3 momentum;
    double mass = 0;
    for (auto& one : list) {
        base::Random random(seed, base::Purpose::agitation, one.id, 0);
        one.velocity = speed * Vec3{random.normal(), random.normal(), random.normal()};
        double const own = one.count * one.density * cube(one.diameter);
        momentum += own * one.velocity;
        mass += own;
    }
    for (auto& one : list) one.velocity -= (1 / mass) * momentum;
}
}

void add_granule(particle::Store& granules, GranuleCase const& one)
{
    std::size_t const row = granules.rows();
    granules.resize(row + 1);
    granules.id[row] = one.id;
    granules.position[row] = one.position;
    granules.velocity[row] = one.velocity;
    granules.spin[row] = one.spin;
    granules.material[row] = one.material;
    granules.radius[row] = 0.5 * one.diameter * std::cbrt(one.count);
    granules.mass[row] = one.count * one.density * math::pi / 6 * cube(one.diameter);
    if (granules.groups.parcel) {
        granules.count[row] = one.count;
        granules.diameter[row] = one.diameter;
    }
    if (granules.groups.process) {
        granules.core_mass[row] = granules.mass[row];
        granules.core_diameter[row] = one.diameter;
        granules.temperature[row] = one.temperature;  // 0 until the start gives it that of the bed
    }
}

void Simulation::hold_back(std::vector<GranuleCase>& list)
{
    std::vector<GranuleCase> at_once;
    auto begin = list.begin();
    for (std::size_t b = 0; b < case_.granules.batches.size(); ++b) {
        auto const end = begin + static_cast<std::ptrdiff_t>(case_.granules.batches[b].parcels);
        auto const fed =
            std::find_if(case_.feeds.begin(), case_.feeds.end(), [&](auto const& feed) { return feed.batch == b; });
        if (fed == case_.feeds.end())
            at_once.insert(at_once.end(), begin, end);
        else
            feeds_.push_back({.how = *fed, .granules = {begin, end}});
        begin = end;
    }
    list = std::move(at_once);
    if (!feeds_.empty() && !wall_room_) wall_room_ = std::make_unique<WallRoom>(case_);
}

void Simulation::fill_feeds()
{
    if (case_.feeds.empty()) return;
    auto list = drawn(case_);
    hold_back(list);
}

void Simulation::place_granules()
{
    auto& batch = case_.granules;
    granules_.keep(column_groups(case_));
    largest_radius_ = largest_radius(case_);
    std::vector<GranuleCase> list = std::move(batch.given);
    batch.given.clear();
    if (list.empty() && batch.parcels > 0) {
        list = drawn(case_);
        hold_back(list);
        if (batch.start == "poured")
            poured_ = std::move(list), list.clear();
        else if (!list.empty())
            arrange(case_, list);
        if (batch.agitation > 0 && !list.empty()) agitate(batch.agitation, case_.seed, list);
    } else {
        batch.parcels = static_cast<long>(list.size());
    }
    // Each rank begins with an equal share, from which space is cut; the engine sends them to their ranks.
    auto const ranks = static_cast<std::size_t>(comm_.size()), rank = static_cast<std::size_t>(comm_.rank());
    for (std::size_t k = 0; k < list.size(); ++k) {
        auto& one = list[k];
        if (k % ranks != rank) continue;
        one.density = density_of(case_, one);
        add_granule(granules_, one);
    }
    granules_.owned = granules_.rows();
    partition_ = partition(granules_.position.values);
}

void Simulation::settle()
{
    // The granules fall under gravity as in a still, thick gas that slows them by this rate, 1/s, until they rest.
    constexpr int stride = 10;  // steps between two times of slowing
    double const rate = 5, slowed = std::exp(-rate * stride * granule_dt_);
    double const g = math::norm(case_.gravity);
    double const radius = largest_radius_;
    int const batch = 100;
    // Without a region what is poured falls from the upper third of the chamber.
    Vec3 low = case_.chamber.lower();
    low.z += 2 * case_.chamber.height() / 3;
    Feed pour{.how = {.region = case_.granules.region.value_or(RegionCase{low, case_.chamber.upper()})},
              .granules = std::exchange(poured_, {})};
    if (!pour.done() && !wall_room_) wall_room_ = std::make_unique<WallRoom>(case_);
    double poured_for = 0;
    for (int round = 0; round < 400; ++round) {
        bool const pouring = !pour.done();
        if (pouring) {
            round = 0;
            if (feed(pour, poured_for)) engine_->prepare(granules_);
            poured_for += batch * granule_dt_;
            base::require(poured_for < longest_pour,
                          "{} granules found no room in {} s: the region of the pour stays full",
                          pour.granules.size() - pour.placed, longest_pour);
        }
        for (int s = 0; s < batch; s += stride) {
            engine_->advance(granules_, granule_dt_, stride);
            for (std::size_t row = 0; !pouring && row < granules_.owned; ++row) granules_.velocity[row] *= slowed;
        }
        std::array<base::ExactSum, 1> squares;  // when granules rest must not depend on the ranks
        for (std::size_t row = 0; row < granules_.owned; ++row) squares[0].add(math::norm2(granules_.velocity[row]));
        comm_.sum(squares);
        double const mean = squares[0].value() / static_cast<double>(case_.granules.parcels);
        bool const stop = comm_.max(stop_requested() ? 1L : 0L) > 0;
        if (stop || (!pouring && round > 5 && mean < 0.01 * g * radius)) break;
    }
    for (std::size_t row = 0; row < granules_.rows(); ++row) {
        granules_.velocity[row] = {};
        granules_.spin[row] = {};
    }
    traffic_ = {};
}

void Simulation::settle_between_still_walls()
{
    auto const& walls = case_.walls;
    bool const cut_anew = !case_.gas.present && comm_.size() > 1;  // for where the granules have come to lie
    bool const moving = std::any_of(walls.begin(), walls.end(), [](auto const& body) { return !body.motions.empty(); });
    if (!moving) {
        settle();
        if (cut_anew) engine_->rebalance(granules_);
        engine_->prepare(granules_);
        return;
    }
    dem::Settings still = granule_settings(case_);
    for (auto& body : still.walls) body.motions.clear();
    auto run = std::exchange(engine_, std::make_unique<dem::Engine>(still, engine_->partition(), comm_));
    engine_->prepare(granules_);
    settle();
    // Each contact is known to one rank; its granules may have partners on others.
    auto const mine = engine_->save_contacts();
    auto bytes = comm_.gather(std::as_bytes(std::span(mine)));
    comm_.broadcast(bytes);
    std::vector<dem::ContactRecord> all(bytes.size() / sizeof(dem::ContactRecord));
    if (!bytes.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
    engine_ = std::move(run);
    engine_->resume(granules_, all);
    if (cut_anew) engine_->rebalance(granules_);
    engine_->prepare(granules_);
}
}
