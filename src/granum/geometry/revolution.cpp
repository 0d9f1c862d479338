#include "granum/geometry/revolution.hpp"

#include "granum/geometry/axis.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
//! Twice the area that an outline goes round against the clock.
double twice_area(std::vector<ProfilePoint> const& outline)
{
    double sum = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        auto const &a = outline[k], &b = outline[(k + 1) % outline.size()];
        sum += a.radius * b.height - b.radius * a.height;
    }
    return sum;
}

//! On which side of the line from a to b the point c is.
double side(ProfilePoint const& a, ProfilePoint const& b, ProfilePoint const& c)
{
    return (b.radius - a.radius) * (c.height - a.height) - (b.height - a.height) * (c.radius - a.radius);
}

bool cross_each_other(ProfilePoint const& a, ProfilePoint const& b, ProfilePoint const& c, ProfilePoint const& d)
{
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}
}

Revolution::Revolution(Vec3 const& base, Vec3 const& axis, std::vector<ProfilePoint> outline)
    : base_(base), axis_(axis), outline_(std::move(outline))
{
    auto const same = [](ProfilePoint const& a, ProfilePoint const& b) {
        return a.height == b.height && a.radius == b.radius;
    };
    outline_.erase(std::unique(outline_.begin(), outline_.end(), same), outline_.end());
    while (outline_.size() > 1 && same(outline_.front(), outline_.back())) outline_.pop_back();
    if (twice_area(outline_) < 0) std::reverse(outline_.begin(), outline_.end());
    for (std::size_t k = 0; k < outline_.size(); ++k) {
        auto const &from = outline_[k], &to = outline_[(k + 1) % outline_.size()];
        double const across = to.radius - from.radius, rise = to.height - from.height;
        double const length = std::sqrt(across * across + rise * rise);
        pieces_.push_back({from.radius, from.height, across, rise, 1 / (length * length), rise / length,
                           -across / length, from.radius > 0 || to.radius > 0});
    }
}

SurfaceDistance Revolution::distance(Vec3 const& x) const
{
    auto const [height, radius, outward] = around(base_, axis_, x);
    double best2 = Bounds::big, off_across = 0, off_rise = 0;
    Piece const* best = nullptr;
    bool inside = false, on_face = false;
    for (auto const& piece : pieces_) {
        double const off_r = radius - piece.radius, off_h = height - piece.height;
        // How often the outline is crossed on the way outwards.
        bool const above = off_h < 0, end_above = off_h < piece.rise;
        if (above != end_above && off_r < off_h / piece.rise * piece.across) inside = !inside;
        if (!piece.surface) continue;
        double const part = (off_r * piece.across + off_h * piece.rise) * piece.per_length2;
        double const along = std::clamp(part, 0.0, 1.0);
        double const a = off_r - along * piece.across, h = off_h - along * piece.rise, d2 = a * a + h * h;
        if (d2 >= best2) continue;
        best2 = d2, off_across = a, off_rise = h, best = &piece;
        on_face = part > 0 && part < 1;
    }
    double const distance = std::sqrt(best2), sign = inside ? -1 : 1;
    double n_across = best->normal_across, n_rise = best->normal_rise;
    if (!on_face && distance > 1e-12 * (1 + std::abs(best->radius)))
        n_across = sign * off_across / distance, n_rise = sign * off_rise / distance;
    return {sign * distance, n_across * outward + n_rise * axis_};
}

Bounds Revolution::bounds() const
{
    Bounds out;
    for (auto const& point : outline_) out.widen_by_circle(base_ + point.height * axis_, axis_, point.radius);
    return out;
}

std::optional<std::string> Revolution::fault() const
{
    if (!finite(base_) || !(std::abs(norm(axis_) - 1) < 1e-9)) return "has no axis";
    double longest = 0;
    for (auto const& point : outline_) {
        if (!std::isfinite(point.height) || !std::isfinite(point.radius)) return "has a measure that is no number";
        if (point.radius < 0) return "has a radius below 0";
        longest = std::max({longest, point.radius, std::abs(point.height)});
    }
    if (outline_.size() < 3 || !(twice_area(outline_) > 1e-12 * longest * longest))
        return "encloses no volume: a length or a radius is 0";
    for (std::size_t i = 0; i < outline_.size(); ++i)
        for (std::size_t k = i + 1; k < outline_.size(); ++k) {
            auto const next = [&](std::size_t at) -> ProfilePoint const& {
                return outline_[(at + 1) % outline_.size()];
            };
            if (cross_each_other(outline_[i], next(i), outline_[k], next(k)))
                return "has an outline that crosses itself";
        }
    return std::nullopt;
}

Revolution cylinder(Vec3 const& base, Vec3 const& axis, double length, double radius)
{
    return cone_frustum(base, axis, length, radius, radius);
}

Revolution cone_frustum(Vec3 const& base, Vec3 const& axis, double length, double base_radius, double top_radius)
{
    return {base, axis, {{0, 0}, {0, base_radius}, {length, top_radius}, {length, 0}}};
}

Revolution tube(Vec3 const& base, Vec3 const& axis, double length, double inner_radius, double outer_radius)
{
    return {base, axis, {{0, inner_radius}, {0, outer_radius}, {length, outer_radius}, {length, inner_radius}}};
}

Revolution turned(std::vector<ProfilePoint> const& profile)
{
    std::vector<ProfilePoint> outline = profile;
    if (!profile.empty()) {
        outline.insert(outline.begin(), {profile.front().height, 0});
        outline.push_back({profile.back().height, 0});
    }
    return {{}, {0, 0, 1}, std::move(outline)};
}
}
