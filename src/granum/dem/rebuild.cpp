// Making the neighbour list anew, and what goes with it: wrapping, migration, sorting, balancing.
#include "granum/base/error.hpp"
#include "granum/dem/engine_inside.hpp"
#include "granum/particle/rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace granum::dem
{
using base::Stage;

namespace
{
// Which row an id has: open addressing, since ids of a rank are scattered.
class RowIndex
{
  public:
    static constexpr std::uint32_t nowhere = ~0u;

    explicit RowIndex(std::vector<Id> const& ids) : ids_(ids), slots_(std::bit_ceil(2 * ids.size() + 2), nowhere)
    {
        for (std::uint32_t row = 0; row < ids.size(); ++row) {
            std::size_t at = start(ids[row]);
            while (slots_[at] != nowhere) at = (at + 1) & (slots_.size() - 1);
            slots_[at] = row;
        }
    }
    std::uint32_t operator()(Id id) const
    {
        std::size_t at = start(id);
        while (slots_[at] != nowhere && ids_[slots_[at]] != id) at = (at + 1) & (slots_.size() - 1);
        return slots_[at];
    }

  private:
    std::size_t start(Id id) const
    {
        return static_cast<std::size_t>((id * 0x9E3779B97F4A7C15u) >> 32) & (slots_.size() - 1);
    }
    std::vector<Id> const& ids_;
    std::vector<std::uint32_t> slots_;
};

constexpr long rebuilds_between_sorts = 30;
// Of the skin: pairs closer than that are near. Fewer fill their blocks better, more leave fewer contacts elsewhere.
constexpr double near_part = 0.07;
}

bool Engine::Inside::strayed() const
{
    for (std::size_t row = 0; row < frame.owned; ++row) {
        Vec3 const x = frame.position(row);
        for (std::size_t d = 0; d < 3; ++d)
            if (domain.periodic[d] && (x[d] < domain.lower[d] || x[d] >= domain.upper[d])) return true;
        if (comm.size() > 1 && halo.owner(x) != comm.rank()) return true;
    }
    return false;
}

// A wide skin makes the list long, a narrow one makes it often: the width that costs least by what is counted, from the
// steps that the last list served. A list costs as much as `list_cost` looks at a distant pair.
double Engine::Inside::next_skin(double mean_radius, double largest) const
{
    double width = settings.skin;
    if (width <= 0) {
        double const least = 0.05 * mean_radius, most = 0.8 * mean_radius;
        width = skin > 0 ? skin : 0.1 * mean_radius;
        if (skin > 0 && steps > built_step) {  // a list that served no step says nothing
            constexpr double list_cost = 120;
            double const steps_per_width = static_cast<double>(steps - built_step) / skin;
            // Pairs per granule and unit of width at a solids fraction of 0.5: 12 phi / R.
            double const pairs_per_width = 6 / mean_radius;
            width = std::sqrt(list_cost / (steps_per_width * pairs_per_width));
            width = std::clamp(width, 0.5 * skin, 2 * skin);
        }
        width = std::clamp(width, least, most);
    }
    for (std::size_t d = 0; d < 3; ++d)
        if (domain.periodic[d]) width = std::min(width, 0.24 * (domain.size()[d] - 4 * largest) - settings.sight);
    return width;
}

// How far each owned row may go before the next list: half the skin, and the few that are much faster than the others
// more in proportion, or these few would make lists of all. Answers the most of any rank, m. Collective.
double Engine::Inside::give_room(double mean_radius, double largest)
{
    constexpr double few = 0.01;  // of rows
    // Of a radius: with half of the widest skin less than one, so that no granule is ahead of its rank's part by half
    // of the narrowest gas cell.
    constexpr double most_ahead = 0.5;
    std::vector<double> speed2(frame.owned);
    for (std::size_t row = 0; row < frame.owned; ++row) speed2[row] = norm2(Frame::vec(frame.bodies[row].velocity));
    double usual2 = 0;
    if (!speed2.empty()) {
        auto const place = speed2.end() - 1 - static_cast<std::ptrdiff_t>(few * static_cast<double>(frame.owned));
        std::nth_element(speed2.begin(), place, speed2.end());
        usual2 = *place;
    }
    double const usual = std::sqrt(comm.max(usual2)), least = 0.5 * skin;
    double most = least + most_ahead * mean_radius;
    for (std::size_t d = 0; d < 3; ++d)
        if (domain.periodic[d])
            most = std::clamp(0.12 * (domain.size()[d] - 4 * largest) - 0.5 * settings.sight, least, most);
    double roomiest = least;
    for (std::size_t row = 0; row < frame.owned; ++row) {
        auto& body = frame.bodies[row];
        double const speed = norm(Frame::vec(body.velocity));
        double const room = speed > usual && usual > 0 ? std::min(most, least * speed / usual) : least;
        std::copy_n(body.position, 3, body.built);
        body.per_room2 = 1 / (room * room);
        roomiest = std::max(roomiest, room);
    }
    return comm.max(roomiest);
}

std::vector<ContactRecord> Engine::Inside::contacts_of(std::vector<std::uint32_t> const& rows,
                                                       std::span<ContactRecord const> saved) const
{
    std::vector<std::uint8_t> wanted(frame.rows(), 0);
    for (auto const row : rows) wanted[row] = 1;
    std::vector<ContactRecord> out;
    pairs.for_each_touching([&](std::uint32_t low, std::uint32_t high, History const& history) {
        if (wanted[low] || wanted[high]) out.push_back({frame.id[low], frame.id[high], history});
    });
    walls.for_each_touching([&](std::uint32_t row, Id partner, History const& history) {
        if (wanted[row]) out.push_back({frame.id[row], ContactRecord::wall_bit | partner, history});
    });
    out.insert(out.end(), saved.begin(), saved.end());
    return out;
}

std::vector<double> Engine::Inside::work() const
{
    std::vector<double> out(frame.owned, 1.0);
    pairs.for_each_touching([&](std::uint32_t low, std::uint32_t high, History const&) {
        for (auto const row : {low, high})
            if (row < frame.owned) out[row] += 0.5;
    });
    return out;
}

void Engine::Inside::balance(particle::Store& granules)
{
    frame.give(granules);
    std::vector<Vec3> points(frame.owned);
    for (std::size_t row = 0; row < frame.owned; ++row) points[row] = frame.position(row);
    halo.partition(par::Partition::balanced(halo.partition().space(), points, work(), comm));
    ++watch.rebalances;
    unbalanced_rebuilds = 0;
}

void Engine::Inside::rebuild(particle::Store& granules, std::span<ContactRecord const> saved)
{
    auto const timing = stopwatch.time(Stage::neighbours);
    find_non_finite();
    agree_on_failure();
    bool const many = comm.size() > 1;
    double largest = 0, sum = 0;
    for (std::size_t row = 0; row < frame.owned; ++row) {
        largest = std::max(largest, frame.radius(row));
        sum += frame.radius(row);
    }
    largest = comm.max(largest);
    double const count = static_cast<double>(comm.sum(static_cast<long>(frame.owned)));
    double const mean = count > 0 ? comm.sum(sum) / count : 1;
    constexpr std::array names{"x", "y", "z"};
    double const widest = 4 * largest + 5 * settings.sight;  // with room for a skin
    for (std::size_t d = 0; d < 3; ++d)
        base::require(
            !domain.periodic[d] || domain.size()[d] > widest,
            "the periodic domain is {:.4g} m wide along {}, but must be wider than two diameters of the "
            "largest granule and what they see besides ({:.4g} m), so that no granule meets another from both "
            "sides",
            domain.size()[d], names[d], widest);
    skin = next_skin(mean, largest);
    if (double const radius = settings.largest_radius > 0 ? settings.largest_radius : largest;
        rules.coarse_energy == 0 && radius > 0) {
        double const force = frame.unit_force * (frame.unit_power == 2 ? radius * radius : radius);
        double const coarse = kernel::power_of_two_below(force * radius) * 0x1p-30;
        rules.coarse_energy = 1.5 * 0x1p52 * coarse;
        rules.fine_energy = 1.5 * 0x1p52 * (coarse * 0x1p-28);
    }

    for (std::size_t row = 0; row < frame.owned; ++row) frame.wrap(domain, row);

    std::size_t const owned_before = frame.owned;
    std::vector<Id> const ids_before = many ? frame.id : std::vector<Id>{};
    std::vector<std::uint32_t> moved_to;  // of former owned rows; empty: they stay
    std::vector<ContactRecord> arrived;
    bool const sort = !std::exchange(sorted, true) || ++unsorted_rebuilds >= rebuilds_between_sorts;
    if (many) {
        if (settings.balance_every > 0 && ++unbalanced_rebuilds >= settings.balance_every) balance(granules);
        frame.give(granules);
        std::vector<std::uint32_t> kept;
        arrived = halo.migrate(
            granules, [&](auto const& rows) { return contacts_of(rows, saved); }, attachments, kept);
        if (kept.size() < owned_before || granules.owned > kept.size()) {
            moved_to.assign(owned_before, RowIndex::nowhere);
            for (std::uint32_t row = 0; row < kept.size(); ++row) moved_to[kept[row]] = row;
        }
        frame.take(granules);
    } else {
        frame.resize(frame.owned);
    }
    auto const& part = halo.partition().box(comm.rank());
    Vec3 const centre = 0.5 * (part.lower + part.upper);
    if (sort) {
        unsorted_rebuilds = 0;
        auto const order = search.sorted_rows(frame, domain, centre, 2 * largest + skin + settings.sight);
        frame.give(granules);
        reorder(granules, order);
        std::vector<std::uint32_t> place(order.size());
        for (std::uint32_t row = 0; row < order.size(); ++row) place[order[row]] = row;
        if (moved_to.empty()) {
            moved_to = place;
        } else {
            for (auto& row : moved_to)
                if (row != RowIndex::nowhere) row = place[row];
        }
        frame.take(granules);
    }
    double const roomiest = give_room(mean, largest), wide = skin + settings.sight;
    double const reach = 2 * (largest + roomiest) + settings.sight;
    if (many) halo.fill(frame, reach);

    layers.make(frame, domain, halo.partition(), comm.rank(), reach);
    watch.strips = static_cast<long>(layers.strips());
    search.find(frame, domain, centre, {wide, near_part * skin, 0.5 * skin}, candidates, *kernel);
    std::unique_ptr<RowIndex> index;
    if (many || !saved.empty()) index = std::make_unique<RowIndex>(frame.id);
    auto const row_now = [&](std::uint32_t row) {
        if (row < owned_before) {
            auto const now = moved_to.empty() ? row : moved_to[row];
            if (now != RowIndex::nowhere || !many) return now;
        }
        return many && row < ids_before.size() ? (*index)(ids_before[row]) : RowIndex::nowhere;
    };
    pairs.make(frame, layers, candidates, row_now, owned_before, rules, lost);
    walls.make(frame, layers, 0.5 * skin + settings.sight, largest + roomiest, row_now, rules, lost);
    auto const restore = [&](std::span<ContactRecord const> records) {
        for (auto const& record : records) {
            auto const low = (*index)(record.low);
            if (low == RowIndex::nowhere) continue;
            if ((record.high & ContactRecord::wall_bit) != 0) {
                if (low < frame.owned) walls.set(low, record.high & ~ContactRecord::wall_bit, record.history);
            } else if (auto const high = (*index)(record.high); high != RowIndex::nowhere) {
                pairs.set(low, high, record.history);
            }
        }
    };
    restore(arrived);
    restore(saved);

    built_radius.resize(frame.owned);
    for (std::size_t row = 0; row < frame.owned; ++row) built_radius[row] = frame.radius(row);
    built_step = steps;
    growth = 0;
    travelled = 0;
    ++watch.rebuilds;
}
}
