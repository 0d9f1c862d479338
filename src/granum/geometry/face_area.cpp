#include "granum/geometry/face_area.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace granum::geometry
{
namespace
{
constexpr int deepest = 4;  // halvings before the parts are taken as they are
constexpr int deepest_by_sign = 5;
constexpr int least_by_sign = 2;  // before equal corners count as one colour
}

double on_face_within(int direction, Vec3 const& low, Vec3 const& high)
{
    auto const d = static_cast<std::size_t>(direction), u = (d + 1) % 3, v = (d + 2) % 3;
    return 1e-4 * std::min(high[u] - low[u], high[v] - low[v]);
}

FaceArea::FaceArea(Region const& region, int direction, Vec3 const& low, Vec3 const& high)
    : region_(region),
      d_(static_cast<std::size_t>(direction)),
      u_((d_ + 1) % 3),
      v_((d_ + 2) % 3),
      near_(on_face_within(direction, low, high))
{
}

Vec3 FaceArea::place(Vec3 const& middle, double u, double v) const
{
    Vec3 out = middle;
    out[u_] += u, out[v_] += v;
    return out;
}

Vec3 FaceArea::half(double half_u, double half_v) const
{
    return place({}, half_u, half_v);
}

Line FaceArea::line(Linear const& plane) const
{
    return {plane.offset, plane.slope[u_], plane.slope[v_]};
}

bool FaceArea::on_face(Linear const& plane) const
{
    return std::abs(plane.offset) <= near_ && std::hypot(plane.slope[u_], plane.slope[v_]) < 0.1;
}

double FaceArea::part_of(WallModel const& model, Vec3 const& half) const
{
    std::array const lines{line(model.first), line(model.second)};
    double const one = rectangle_part(half[u_], half[v_], std::span(lines).first(1)).area;
    if (model.kind == WallModel::Kind::one) return one;
    double const both = rectangle_part(half[u_], half[v_], lines).area;
    if (model.kind == WallModel::Kind::both) return both;
    return one + rectangle_part(half[u_], half[v_], std::span(lines).last(1)).area - both;
}

double FaceArea::open(Vec3 const& middle, double half_u, double half_v)
{
    Sample const own = sample(region_, middle, {});
    seen_.push_back(own);
    seen_.back().at = middle;
    return halved(middle, half_u, half_v, own, 0);
}

double FaceArea::halved(Vec3 const& middle, double half_u, double half_v, Sample const& own, int level)
{
    Vec3 const half = this->half(half_u, half_v);
    double const reach = norm(half);
    if (own.distance >= reach) return 4 * half_u * half_v;
    if (own.distance <= -reach) return 0;
    std::array<Sample, 5> samples;
    samples[0] = own;
    bool lies_on_wall = on_face(own.plane());
    for (std::size_t k = 0; k < 4; ++k) {
        Vec3 const at =
            this->half((k & 1) != 0 ? 0.5 * half_u : -0.5 * half_u, (k & 2) != 0 ? 0.5 * half_v : -0.5 * half_v);
        samples[k + 1] = sample(region_, middle, at);
        lies_on_wall = lies_on_wall || on_face(Linear{samples[k + 1].distance, samples[k + 1].normal});
        if (level < 2) {
            seen_.push_back(samples[k + 1]);
            seen_.back().at += middle;
        }
    }
    std::optional<WallModel> model;
    if (level > 0 && !lies_on_wall) {
        // The flatter the wall meets the face, the farther a small error of the distance moves the line where they
        // meet.
        double const across = std::hypot(own.normal[u_], own.normal[v_]), flat = std::max(across, 0.05);
        model = fit(region_, middle, half, samples, tolerance_for(2 * std::min(half_u, half_v) * flat));
        lies_on_wall =
            model && (on_face(model->first) || (model->kind != WallModel::Kind::one && on_face(model->second)));
    }
    // A wall that lies on the face says nothing of where it ends.
    if (lies_on_wall) return by_signs(middle, half_u, half_v, corners(middle, half_u, half_v), level);
    if (model) return part_of(*model, half);
    double sum = 0;
    for (std::size_t k = 1; k < 5; ++k) {
        Sample part = samples[k];
        Vec3 const at = part.at;
        part.at = {};
        if (level < deepest) {
            sum += halved(middle + at, 0.5 * half_u, 0.5 * half_v, part, level + 1);
        } else {
            Line const edge = line(part.plane());
            sum += rectangle_part(0.5 * half_u, 0.5 * half_v, std::span(&edge, 1)).area;
        }
    }
    return sum;
}

bool FaceArea::open_at(Vec3 const& x) const
{
    double const distance = region_.distance(x);
    if (std::abs(distance) > near_) return distance > 0;
    Vec3 aside;
    aside[d_] = 2 * near_;
    return region_.distance(x + aside) > 0 && region_.distance(x - aside) > 0;
}

std::array<bool, 4> FaceArea::corners(Vec3 const& middle, double half_u, double half_v) const
{
    return {open_at(place(middle, -half_u, -half_v)), open_at(place(middle, half_u, -half_v)),
            open_at(place(middle, half_u, half_v)), open_at(place(middle, -half_u, half_v))};
}

double FaceArea::by_signs(Vec3 const& middle, double half_u, double half_v, std::array<bool, 4> const& corners,
                          int level)
{
    bool const centre = open_at(middle);
    bool const same = std::all_of(corners.begin(), corners.end(), [&](bool one) { return one == centre; });
    if (same && level >= least_by_sign) return centre ? 4 * half_u * half_v : 0;
    if (level >= deepest_by_sign) return crossed(middle, half_u, half_v, corners);
    bool const south = open_at(place(middle, 0, -half_v)), east = open_at(place(middle, half_u, 0));
    bool const north = open_at(place(middle, 0, half_v)), west = open_at(place(middle, -half_u, 0));
    double const u = 0.5 * half_u, v = 0.5 * half_v;
    return by_signs(place(middle, -u, -v), u, v, {corners[0], south, centre, west}, level + 1) +
           by_signs(place(middle, u, -v), u, v, {south, corners[1], east, centre}, level + 1) +
           by_signs(place(middle, u, v), u, v, {centre, east, corners[2], north}, level + 1) +
           by_signs(place(middle, -u, v), u, v, {west, centre, north, corners[3]}, level + 1);
}

double FaceArea::crossed(Vec3 const& middle, double half_u, double half_v, std::array<bool, 4> const& corners) const
{
    static constexpr std::array<std::array<double, 2>, 4> at{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    std::array<std::array<double, 2>, 8> polygon;
    std::size_t size = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        auto const &a = at[k], &b = at[(k + 1) % 4];
        bool const opens = corners[k];
        if (opens) polygon[size++] = a;
        if (opens == corners[(k + 1) % 4]) continue;
        double low = 0, high = 1;  // of the way from a to b
        for (int step = 0; step < 10; ++step) {
            double const t = 0.5 * (low + high), u = a[0] + t * (b[0] - a[0]), v = a[1] + t * (b[1] - a[1]);
            (open_at(place(middle, u * half_u, v * half_v)) == opens ? low : high) = t;
        }
        double const t = 0.5 * (low + high);
        polygon[size++] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
    }
    double twice = 0;
    for (std::size_t k = 0; k < size; ++k) {
        auto const &a = polygon[k], &b = polygon[(k + 1) % size];
        twice += a[0] * b[1] - b[0] * a[1];
    }
    return 0.5 * twice * half_u * half_v;
}
}
