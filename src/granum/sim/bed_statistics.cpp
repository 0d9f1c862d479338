#include "granum/sim/bed_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

namespace granum::sim
{
namespace
{
constexpr double finest = 1e-9;        // overlap over radius where the histogram begins
double const width = std::log(1.01);   // of a class
constexpr std::size_t classes = 2084;  // to above 1
enum Sum : std::size_t
{
    overlap,
    translation,
    rotation,
    potential,
    elastic,
    dissipated,
    wall_work,
    sum_count
};
enum Number : std::size_t
{
    pairs,
    wall_pairs,
    beyond,
    rows,
    neighbours,
    number_count = neighbours + 16
};

std::size_t class_of(double share)
{
    double const at = std::log(std::max(share, finest) / finest) / width;
    return std::min(classes - 1, static_cast<std::size_t>(at));
}
}

BedStatistics bed_statistics(particle::Store const& granules, Mover& mover, par::Communicator const& comm,
                             double criterion)
{
    std::array<base::ExactSum, sum_count> sums;
    std::array<double, number_count> numbers{};
    std::vector<double> histogram(classes);
    double largest = 0;

    std::unordered_map<particle::Id, std::uint32_t> row_of;
    row_of.reserve(granules.owned);
    for (std::uint32_t row = 0; row < granules.owned; ++row) row_of.try_emplace(granules.id[row], row);
    std::vector<std::uint8_t> touching(granules.owned);
    auto contacts = mover.contacts();
    // A pair that touches across a periodic face may be seen from both of its sides.
    auto const key = [](dem::Contact const& contact) { return std::tuple(contact.wall, contact.low, contact.high); };
    std::sort(contacts.begin(), contacts.end(), [&](auto const& a, auto const& b) { return key(a) < key(b); });
    auto const same = [&](auto const& a, auto const& b) { return !a.wall && key(a) == key(b); };
    contacts.erase(std::unique(contacts.begin(), contacts.end(), same), contacts.end());
    for (auto const& contact : contacts) {
        // A pair split over two ranks is known to both: each counts for its own granule, the owner of the lower for
        // both.
        bool mine = contact.wall;
        auto const see = [&](particle::Id id, bool lower) {
            auto const found = row_of.find(id);
            if (contact.wall || found == row_of.end()) return;
            touching[found->second] = static_cast<std::uint8_t>(std::min(15, touching[found->second] + 1));
            mine = mine || lower;
        };
        see(contact.low, true);
        see(contact.high, false);
        if (!mine) continue;
        double const share = contact.overlap / contact.radius;
        numbers[contact.wall ? wall_pairs : pairs] += 1;
        numbers[beyond] += share > criterion;
        sums[overlap].add(share);
        histogram[class_of(share)] += 1;
        largest = std::max(largest, share);
    }
    math::Vec3 const gravity = mover.settings().gravity;
    for (std::size_t row = 0; row < granules.owned; ++row) {
        double const mass = granules.mass[row], radius = granules.radius[row];
        sums[translation].add(0.5 * mass * norm2(granules.velocity[row]));
        sums[rotation].add(0.2 * mass * radius * radius * norm2(granules.spin[row]));
        sums[potential].add(-mass * dot(gravity, granules.position[row]));
        numbers[neighbours + touching[row]] += 1;
    }
    numbers[rows] = static_cast<double>(granules.owned);
    auto const& watch = mover.watch();
    sums[elastic] = watch.elastic, sums[dissipated] = watch.dissipated, sums[wall_work] = watch.wall_work;
    comm.sum(sums);
    comm.sum(numbers);
    comm.sum(histogram);

    BedStatistics out;
    out.contacts = std::lround(numbers[pairs]);
    out.wall_contacts = std::lround(numbers[wall_pairs]);
    double const all = numbers[pairs] + numbers[wall_pairs];
    if (numbers[rows] > 0) {
        out.coordination = 2 * numbers[pairs] / numbers[rows];
        for (std::size_t k = 0; k < out.neighbours.size(); ++k)
            out.neighbours[k] = numbers[neighbours + k] / numbers[rows];
    }
    if (all > 0) {
        out.overlap_mean = sums[overlap].value() / all;
        out.overlap_beyond = numbers[beyond] / all;
        double below = 0;
        for (std::size_t k = 0; k < classes && below < 0.99 * all; ++k) {
            below += histogram[k];
            out.overlap_p99 = finest * std::exp(width * (static_cast<double>(k) + 0.5));
        }
    }
    // Hard spheres touch for no time: what there was is the deepest that rounding let two lie in each other.
    auto const* hard = mover.hard_watch();
    out.overlap_largest = hard ? hard->largest_overlap : comm.max(largest);
    out.collisions = hard ? hard->collisions : 0;
    out.overlap_p99 = std::min(out.overlap_p99, out.overlap_largest);
    out.translation = sums[translation].value(), out.rotation = sums[rotation].value();
    out.potential = sums[potential].value(), out.elastic = sums[elastic].value();
    out.dissipated = sums[dissipated].value(), out.wall_work = sums[wall_work].value();
    for (auto const& load : mover.wall_loads()) out.wall_force += load.force;
    return out;
}
}
