#include "granum/geometry/thin_wall.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
ThinWall::ThinWall(Region const& region, int direction, Vec3 const& low, Vec3 const& high, Beside const& beside)
    : region_(region),
      d_(static_cast<std::size_t>(direction)),
      u_((d_ + 1) % 3),
      v_((d_ + 2) % 3),
      low_(low),
      high_(high),
      shortest_(std::min(high[u_] - low[u_], high[v_] - low[v_])),
      near_(on_face_within(direction, low, high))
{
    high_[d_] = low_[d_];
    auto const add = [&](double depth, double inwards) {
        if (!(depth > 0)) return;
        Vec3 cell_low = low_, cell_high = high_;
        (inwards > 0 ? cell_high : cell_low)[d_] += inwards * depth;
        auto const middle = open_place(region_, cell_low, cell_high);
        if (!middle) return;
        Cell cell{inwards, {*middle, region_.distance(*middle)}, {}};
        for (std::size_t k = 0; k < steps.size(); ++k) cell.stepped[k] = away(*middle, steps[k] * shortest_);
        cells_.push_back(cell);
    };
    add(beside.below, -1);
    add(beside.above, 1);
}

ThinWall::Place ThinWall::away(Vec3 const& x, double step) const
{
    Vec3 const there = x + step * region_.normal(x);
    return {there, region_.distance(there)};
}

bool ThinWall::sees(Place const& a, Place const& b) const
{
    return norm(b.at - a.at) < a.free + b.free || !region_.blocked(a.at, b.at);
}

bool ThinWall::reaches(Cell const& cell, Place const& place) const
{
    if (!(place.free > 0)) return false;
    if (sees(cell.middle, place)) return true;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        Place const stepped = away(place.at, steps[k] * shortest_);
        if (sees(cell.stepped[k], stepped) && sees(place, stepped) && sees(cell.middle, cell.stepped[k])) return true;
    }
    return false;
}

bool ThinWall::on_wall(Sample const& place) const
{
    return std::abs(place.distance) <= near_ && std::hypot(place.normal[u_], place.normal[v_]) < 0.1;
}

template <class Reach>
bool ThinWall::through(Sample const& from, Reach&& reach) const
{
    if (!on_wall(from))
        return std::all_of(cells_.begin(), cells_.end(), [&](Cell const& cell) {
            return reach(cell, Place{from.at, from.distance});
        });
    // On a wall or a seam: each cell looks at its own side, and the two sides at each other.
    std::optional<Place> other;
    for (auto const& cell : cells_) {
        Vec3 aside = from.at;
        aside[d_] += 2 * cell.inwards * near_;
        Place const place{aside, region_.distance(aside)};
        if (!(place.free > 0) || !reach(cell, place) || (other && !sees(*other, place))) return false;
        other = place;
    }
    return true;
}

bool ThinWall::all_seen(std::vector<Sample> const& places) const
{
    auto const open = [&](Sample const& one) { return one.distance > 0 || on_wall(one); };
    auto const seen = [&](Sample const& one) {
        return through(one, [&](Cell const& cell, Place const& place) { return sees(cell.middle, place); });
    };
    auto const [nearest, freest] = std::pair{
        std::min_element(places.begin(), places.end(),
                         [](Sample const& a, Sample const& b) { return std::abs(a.distance) < std::abs(b.distance); }),
        std::max_element(places.begin(), places.end(),
                         [](Sample const& a, Sample const& b) { return a.distance < b.distance; })};
    if (!open(*freest) || !seen(*freest)) return false;
    // Mostly there is one wall, nearly a plane, and all distances say so.
    Linear const plane = nearest->plane();
    auto const on_plane = [&](Vec3 const& x, double distance) {
        double const said = plane.at(x);
        return std::abs(said - distance) < 0.05 * shortest_ && (said > 0) == (distance > 0);
    };
    bool const simple =
        std::all_of(places.begin(), places.end(), [&](Sample const& one) { return on_plane(one.at, one.distance); }) &&
        std::all_of(cells_.begin(), cells_.end(),
                    [&](Cell const& cell) { return on_plane(cell.middle.at, cell.middle.free); });
    return simple ||
           std::all_of(places.begin(), places.end(), [&](Sample const& one) { return !open(one) || seen(one); });
}

std::optional<Sample> ThinWall::open_in(FaceArea const& face, Vec3 const& middle, double half_u, double half_v) const
{
    auto const look = [&](Vec3 const& x) {
        auto const wall = region_.at(x);
        return Sample{x, wall.distance, wall.normal};
    };
    Sample const own = look(middle);
    if (own.distance > 0 || on_wall(own)) return own;
    double const across = std::hypot(own.normal[u_], own.normal[v_]);
    if (across < 0.1) return std::nullopt;
    double const way = (-own.distance + 0.05 * std::min(half_u, half_v)) / (across * across);
    double const u = way * own.normal[u_], v = way * own.normal[v_];
    if (std::abs(u) > half_u || std::abs(v) > half_v) return std::nullopt;
    Sample const beside = look(face.place(middle, u, v));
    return beside.distance > 0 ? std::optional(beside) : std::nullopt;
}

double ThinWall::reached_area(FaceArea& face) const
{
    constexpr int parts = 4;
    double const half_u = (high_[u_] - low_[u_]) / (2 * parts), half_v = (high_[v_] - low_[v_]) / (2 * parts);
    double sum = 0;
    for (int j = 0; j < parts; ++j)
        for (int i = 0; i < parts; ++i) {
            Vec3 const middle = face.place(low_, (2 * i + 1) * half_u, (2 * j + 1) * half_v);
            double const area = face.open(middle, half_u, half_v);
            if (area <= 0) continue;
            auto const place = open_in(face, middle, half_u, half_v);
            auto const reach = [&](Cell const& cell, Place const& at) { return reaches(cell, at); };
            if (place && through(*place, reach)) sum += area;
        }
    return sum;
}
}
