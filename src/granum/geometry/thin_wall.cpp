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

bool ThinWall::reaches(Cell const& cell, Vec3 const& x) const
{
    Place const place = off_wall(cell, x, region_.distance(x));
    if (!(place.free > 0)) return false;
    if (sees(cell.middle, place)) return true;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        Place const stepped = away(place.at, steps[k] * shortest_);
        if (sees(cell.stepped[k], stepped) && sees(place, stepped) && sees(cell.middle, cell.stepped[k])) return true;
    }
    return false;
}

ThinWall::Place ThinWall::off_wall(Cell const& cell, Vec3 const& x, double distance) const
{
    if (std::abs(distance) > near_) return {x, distance};
    Vec3 aside = x;
    aside[d_] += 2 * cell.inwards * near_;
    return {aside, region_.distance(aside)};
}

bool ThinWall::all_seen(std::vector<Sample> const& places) const
{
    // Mostly there is one wall, nearly a plane, and all distances say so.
    Sample const* nearest = nullptr;
    for (auto const& one : places)
        if (nearest == nullptr || std::abs(one.distance) < std::abs(nearest->distance)) nearest = &one;
    if (nearest == nullptr) return true;
    Linear const plane = nearest->plane();
    auto const on_plane = [&](Vec3 const& x, double distance) {
        double const said = plane.at(x);
        return std::abs(said - distance) < 0.05 * shortest_ && (said > 0) == (distance > 0);
    };
    bool const simple =
        std::all_of(places.begin(), places.end(), [&](Sample const& one) { return on_plane(one.at, one.distance); }) &&
        std::all_of(cells_.begin(), cells_.end(),
                    [&](Cell const& cell) { return on_plane(cell.middle.at, cell.middle.free); });
    if (simple) return true;
    bool any = false;
    for (auto const& one : places) {
        if (one.distance < -near_) continue;
        for (auto const& cell : cells_) {
            Place const place = off_wall(cell, one.at, one.distance);
            if (!(place.free > 0)) continue;
            if (!sees(cell.middle, place)) return false;
            any = true;
        }
    }
    return any;
}

std::optional<Vec3> ThinWall::open_in(FaceArea const& face, Vec3 const& middle, double half_u, double half_v) const
{
    auto const wall = region_.at(middle);
    if (wall.distance >= -near_) return middle;
    double const across = std::hypot(wall.normal[u_], wall.normal[v_]);
    if (across < 0.1) return std::nullopt;
    double const way = (-wall.distance + 0.05 * std::min(half_u, half_v)) / (across * across);
    double const u = way * wall.normal[u_], v = way * wall.normal[v_];
    Vec3 const aside = face.place(middle, u, v);
    if (std::abs(u) > half_u || std::abs(v) > half_v || region_.distance(aside) <= 0) return std::nullopt;
    return aside;
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
            if (place &&
                std::all_of(cells_.begin(), cells_.end(), [&](Cell const& cell) { return reaches(cell, *place); }))
                sum += area;
        }
    return sum;
}
}
