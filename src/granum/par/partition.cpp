#include "granum/par/partition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace granum::par
{
Partition::Partition(Space const& space) : space_(space), boxes_{space.box} {}

Partition::Partition(Space const& space, Slabs const& slabs) : space_(space)
{
    int const ranks = slabs.ranks();
    boxes_.resize(static_cast<std::size_t>(ranks));
    for (int rank = 0; rank + 1 < ranks; ++rank)
        cuts_.push_back({0, slabs.upper(rank), -1 - rank, rank + 2 < ranks ? rank + 1 : -1 - (rank + 1)});
    if (ranks == 1)
        boxes_[0] = space.box;
    else
        find_boxes(0, space.box);
}

Partition::Partition(Space const& space, std::vector<double> const& cuts) : space_(space)
{
    for (std::size_t k = 0; k + 3 < cuts.size(); k += 4)
        cuts_.push_back({static_cast<std::size_t>(cuts[k]), cuts[k + 1], static_cast<int>(cuts[k + 2]),
                         static_cast<int>(cuts[k + 3])});
    boxes_.assign(cuts_.size() + 1, space.box);
    find_boxes(cuts_.empty() ? -1 : 0, space.box);
}

std::vector<double> Partition::cuts() const
{
    std::vector<double> out;
    for (auto const& cut : cuts_)
        out.insert(out.end(), {static_cast<double>(cut.direction), cut.at, static_cast<double>(cut.first),
                               static_cast<double>(cut.behind)});
    return out;
}

void Partition::find_boxes(int cut, Box const& box)
{
    if (cut < 0) {
        boxes_[static_cast<std::size_t>(-1 - cut)] = box;
        return;
    }
    auto const here = cuts_[static_cast<std::size_t>(cut)];
    Box first = box, behind = box;
    first.upper[here.direction] = here.at;
    behind.lower[here.direction] = here.at;
    find_boxes(here.first, first);
    find_boxes(here.behind, behind);
}

int Partition::owner(Vec3 const& x) const
{
    int cut = cuts_.empty() ? -1 : 0;
    while (cut >= 0) {
        auto const& here = cuts_[static_cast<std::size_t>(cut)];
        cut = x[here.direction] < here.at ? here.first : here.behind;
    }
    return -1 - cut;
}

Vec3 Partition::off(Vec3 const& x, int rank) const
{
    auto const& part = box(rank);
    Vec3 out;
    for (std::size_t d = 0; d < 3; ++d) {
        double const low = part.lower[d], high = part.upper[d], length = space_.box.upper[d] - space_.box.lower[d];
        double off = std::max({low - x[d], x[d] - high, 0.0});
        if (space_.periodic[d]) {
            off = std::min(off, std::max({low - x[d] - length, x[d] + length - high, 0.0}));
            off = std::min(off, std::max({low - x[d] + length, x[d] - length - high, 0.0}));
        } else if ((x[d] < low && low == space_.box.lower[d]) || (x[d] > high && high == space_.box.upper[d])) {
            off = 0;
        }
        out[d] = off;
    }
    return out;
}

std::vector<int> Partition::near(int rank, double reach) const
{
    std::vector<int> out;
    auto const& mine = box(rank);
    for (int other = 0; other < ranks(); ++other) {
        if (other == rank) continue;
        auto const& part = box(other);
        bool close = true;
        for (std::size_t d = 0; d < 3; ++d) {
            double const length = space_.box.upper[d] - space_.box.lower[d];
            double gap = std::max({part.lower[d] - mine.upper[d], mine.lower[d] - part.upper[d], 0.0});
            if (space_.periodic[d])
                for (double const by : {length, -length})
                    gap = std::min(
                        gap, std::max({part.lower[d] + by - mine.upper[d], mine.lower[d] - part.upper[d] - by, 0.0}));
            close = close && gap < reach;
        }
        if (close) out.push_back(other);
    }
    return out;
}

// One level after the other: the ranks' points in a part are cut where the work below is the share of the first group,
// or on the face where both halves of a step are shared out best.
struct Partition::Balance
{
    Partition& partition;
    std::span<Vec3 const> points;
    std::span<double const> work;
    Communicator const& comm;
    std::array<std::vector<double>, 3> const* faces;
    std::vector<bool> const& second;

    //! A place to cut, and what the step then takes the slowest ranks: the sum over its halves, in the work of a group
    //! over its share of the ranks.
    struct Choice
    {
        std::size_t direction = 0;
        double at = 0, time = std::numeric_limits<double>::infinity();
    };

    // The best of all faces within a part. What lies in the two layers of cells at a cut is partly done on both sides.
    Choice best_face(std::vector<std::uint32_t> const& mine, Box const& box, double share) const
    {
        constexpr double twice = 0.25, better = 0.99;  // of two that are alike the first direction is taken
        Choice best;
        for (std::size_t d = 0; d < 3; ++d) {
            std::vector<double> cuts;
            for (double const face : (*faces)[d])
                if (face > box.lower[d] && face < box.upper[d]) cuts.push_back(face);
            if (cuts.empty()) continue;
            std::size_t const layers = cuts.size() + 1;
            std::vector<double> sums(2 * layers);
            for (auto const k : mine) {
                auto const layer = std::upper_bound(cuts.begin(), cuts.end(), points[k][d]) - cuts.begin();
                sums[2 * static_cast<std::size_t>(layer) + (second.empty() ? 0 : second[k])] += work[k];
            }
            comm.sum(sums);
            std::array<double, 2> all{}, below{};
            for (std::size_t k = 0; k < sums.size(); ++k) all[k % 2] += sums[k];
            Choice own;
            for (std::size_t k = 0; k < cuts.size(); ++k) {
                double time = 0;
                for (std::size_t half : {0, 1}) {
                    double const here = sums[2 * k + half], next = sums[2 * k + 2 + half];
                    below[half] += here;
                    time += std::max(below[half] / share, (all[half] - below[half]) / (1 - share));
                    time += twice * (here + next);
                }
                if (time < own.time) own = {d, cuts[k], time};
            }
            if (own.time < better * best.time) best = own;
        }
        return best;
    }

    // The face within a part (not at its ends) that is nearest to a cut; the cut itself where there is none.
    double on_face(std::size_t direction, Box const& box, double at) const
    {
        if (!faces) return at;
        double best = at, off = std::numeric_limits<double>::infinity();
        for (double const face : (*faces)[direction])
            if (face > box.lower[direction] && face < box.upper[direction] && std::abs(face - at) < off)
                best = face, off = std::abs(face - at);
        return best;
    }
    //! Whether a part can be cut in this direction.
    bool can_cut(std::size_t direction, Box const& box) const
    {
        if (!faces) return true;
        for (double const face : (*faces)[direction])
            if (face > box.lower[direction] && face < box.upper[direction]) return true;
        return false;
    }

    // What the points of all ranks fill of a part.
    Box bounds(std::vector<std::uint32_t> const& mine, Box const& box) const
    {
        if (comm.sum(static_cast<long>(mine.size())) == 0) return box;
        Box out{box.upper, box.lower};
        for (std::size_t d = 0; d < 3; ++d) {
            for (auto const k : mine) {
                out.lower[d] = std::min(out.lower[d], points[k][d]);
                out.upper[d] = std::max(out.upper[d], points[k][d]);
            }
            out.lower[d] = std::max(box.lower[d], -comm.max(-out.lower[d]));
            out.upper[d] = std::min(box.upper[d], comm.max(out.upper[d]));
        }
        return out;
    }

    // How far the work of all ranks lies apart in each direction, m: its standard deviation. A bed is wide and low in a
    // tall chamber whose cells are little work.
    Vec3 spread(std::vector<std::uint32_t> const& mine, Box const& box) const
    {
        std::array<double, 7> sums{};
        for (auto const k : mine) {
            sums[6] += work[k];
            for (std::size_t d = 0; d < 3; ++d) {
                double const x = points[k][d] - box.lower[d];
                sums[d] += work[k] * x;
                sums[3 + d] += work[k] * x * x;
            }
        }
        comm.sum(sums);
        if (sums[6] == 0) return box.upper - box.lower;
        Vec3 out;
        for (std::size_t d = 0; d < 3; ++d) {
            double const mean = sums[d] / sums[6];
            out[d] = std::sqrt(std::max(0.0, sums[3 + d] / sums[6] - mean * mean));
        }
        return out;
    }

    // A part is cut across the direction that its work is spread out in most, so that ranks have short borders. Returns
    // the number of the cut made, or -1 - rank.
    int divide(std::vector<std::uint32_t> mine, Box const& box, int first_rank, int ranks)
    {
        if (ranks == 1) return -1 - first_rank;
        int const first_group = ranks / 2;
        double total = 0;
        for (auto const k : mine) total += work[k];
        double const share = static_cast<double>(first_group) / ranks, all = comm.sum(total), goal = all * share;
        if (faces && all > 0) {
            auto const [direction, at, time] = best_face(mine, box, share);
            if (time < std::numeric_limits<double>::infinity())
                return cut(std::move(mine), box, direction, at, first_rank, ranks);
        }
        Box const filled = bounds(mine, box);
        Vec3 const apart = spread(mine, box);
        std::size_t direction = 0;
        for (std::size_t d = 1; d < 3; ++d)
            if (can_cut(d, box) && (!can_cut(direction, box) || apart[d] > 1.01 * apart[direction])) direction = d;
        double low = filled.lower[direction], high = filled.upper[direction];
        if (all == 0) low = high = low + share * (high - low);  // nothing to weigh: the length is shared out
        for (int halving = 0; all > 0 && halving < 40; ++halving) {
            double const middle = 0.5 * (low + high);
            double below = 0;
            for (auto const k : mine)
                if (points[k][direction] < middle) below += work[k];
            (comm.sum(below) < goal ? low : high) = middle;
        }
        return cut(std::move(mine), box, direction, on_face(direction, box, 0.5 * (low + high)), first_rank, ranks);
    }

    int cut(std::vector<std::uint32_t> mine, Box const& box, std::size_t direction, double at, int first_rank,
            int ranks)
    {
        int const first_group = ranks / 2;
        std::vector<std::uint32_t> first, behind;
        for (auto const k : mine) (points[k][direction] < at ? first : behind).push_back(k);
        auto const number = partition.cuts_.size();
        partition.cuts_.push_back({direction, at, 0, 0});
        Box first_box = box, behind_box = box;
        first_box.upper[direction] = behind_box.lower[direction] = at;
        int const first_cut = divide(std::move(first), first_box, first_rank, first_group);
        int const behind_cut = divide(std::move(behind), behind_box, first_rank + first_group, ranks - first_group);
        partition.cuts_[number].first = first_cut;
        partition.cuts_[number].behind = behind_cut;
        return static_cast<int>(number);
    }
};

Partition Partition::balanced(Space const& space, std::span<Vec3 const> points, std::span<double const> work,
                              Communicator const& comm, std::array<std::vector<double>, 3> const* faces,
                              std::vector<bool> const& second)
{
    Partition out;
    out.space_ = space;
    out.boxes_.assign(static_cast<std::size_t>(comm.size()), space.box);
    std::vector<std::uint32_t> all(points.size());
    for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
    Balance balance{out, points, work, comm, faces, second};
    if (comm.size() > 1) out.find_boxes(balance.divide(std::move(all), space.box, 0, comm.size()), space.box);
    return out;
}
}
