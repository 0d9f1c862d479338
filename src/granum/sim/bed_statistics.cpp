#include "granum/sim/bed_statistics.hpp"

#include "granum/particle/rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
    pairs,
    wall_pairs,
    overlap,
    beyond,
    rows,
    translation,
    rotation,
    potential,
    elastic,
    dissipated,
    neighbours,
    count = neighbours + 16
};

//! To ten digits: the engine sums over contacts in the order of its memory, so that the last digits are not the same
//! after a restart.
double ten_digits(double x)
{
    if (x == 0 || !std::isfinite(x)) return x;
    double const unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - 9);
    return std::round(x / unit) * unit;
}

std::size_t class_of(double share)
{
    double const at = std::log(std::max(share, finest) / finest) / width;
    return std::min(classes - 1, static_cast<std::size_t>(at));
}
}

BedStatistics bed_statistics(particle::Store const& granules, Mover& mover, par::Communicator const& comm)
{
    std::array<double, Sum::count> sums{};
    std::vector<double> histogram(classes);
    double largest = 0;

    std::unordered_map<particle::Id, std::uint32_t> row_of;
    row_of.reserve(granules.rows());
    for (std::uint32_t row = 0; row < granules.rows(); ++row) row_of.try_emplace(granules.id[row], row);
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
        double radius = std::numeric_limits<double>::infinity();
        bool mine = contact.wall;
        auto const see = [&](particle::Id id, bool lower) {
            auto const found = row_of.find(id);
            if (found == row_of.end()) return;
            radius = std::min(radius, granules.radius[found->second]);
            if (found->second >= granules.owned) return;
            if (!contact.wall)
                touching[found->second] = static_cast<std::uint8_t>(std::min(15, touching[found->second] + 1));
            if (lower) mine = true;
        };
        see(contact.low, true);
        if (!contact.wall) see(contact.high, false);
        if (!mine || !std::isfinite(radius)) continue;
        double const share = contact.overlap / radius;
        sums[contact.wall ? wall_pairs : pairs] += 1;
        sums[overlap] += share;
        sums[beyond] += share > overlap_criterion;
        histogram[class_of(share)] += 1;
        largest = std::max(largest, share);
    }
    math::Vec3 const gravity = mover.settings().gravity;
    for (std::size_t const row :
         particle::rows_by_identity(granules)) {  // so that sums do not know the order in memory
        double const mass = granules.mass[row], radius = granules.radius[row];
        sums[translation] += 0.5 * mass * norm2(granules.velocity[row]);
        sums[rotation] += 0.2 * mass * radius * radius * norm2(granules.spin[row]);
        sums[potential] -= mass * dot(gravity, granules.position[row]);
        sums[neighbours + touching[row]] += 1;
    }
    sums[rows] = static_cast<double>(granules.owned);
    auto const& watch = mover.watch();
    sums[elastic] = watch.elastic;
    sums[dissipated] = watch.dissipated;
    comm.sum(sums);
    comm.sum(histogram);

    BedStatistics out;
    out.contacts = std::lround(sums[pairs]);
    out.wall_contacts = std::lround(sums[wall_pairs]);
    double const all = sums[pairs] + sums[wall_pairs];
    if (sums[rows] > 0) {
        out.coordination = 2 * sums[pairs] / sums[rows];
        for (std::size_t k = 0; k < out.neighbours.size(); ++k) out.neighbours[k] = sums[neighbours + k] / sums[rows];
    }
    if (all > 0) {
        out.overlap_mean = sums[overlap] / all;
        out.overlap_beyond = sums[beyond] / all;
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
    out.translation = sums[translation], out.rotation = sums[rotation];
    out.potential = sums[potential], out.elastic = ten_digits(sums[elastic]),
    out.dissipated = ten_digits(sums[dissipated]);
    for (auto const& load : mover.wall_loads()) out.wall_force += load.force;
    return out;
}
}
