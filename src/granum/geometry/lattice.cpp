#include "granum/geometry/lattice.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
namespace
{
constexpr int most_cubes = 1 << 20;  // in one direction
}

Lattice::Lattice(Region const& region, double edge) : region_(region), edge_(edge)
{
    auto const refuse = [](std::string what) { throw base::CaseError({{"", 0, "", std::move(what), {}}}); };
    Vec3 const size = region.upper() - region.lower();
    if (!finite(size)) refuse("a region without bounds has no surface that can be drawn");
    if (!(edge > 0)) refuse("a surface needs a resolution above 0");
    // No round number, so that corners do not lie on walls.
    origin_ = region.lower() - edge * Vec3{0.5613, 0.5387, 0.5461};
    int largest = 1;
    for (std::size_t d = 0; d < 3; ++d) {
        if (size[d] / edge > most_cubes)
            refuse(fmt::format("a resolution of {:g} m is too fine for a region of {:g} m", edge, size[d]));
        cubes_[d] = static_cast<int>(size[d] / edge) + 2;
        largest = std::max(largest, cubes_[d]);
    }
    int block = 1;
    while (block < largest) block *= 2;
    look_for_wall({0, 0, 0}, block);
}

Vec3 Lattice::place(Spot const& corner, Vec3 const& within) const
{
    return origin_ + edge_ * Vec3{corner[0] + within.x, corner[1] + within.y, corner[2] + within.z};
}

void Lattice::look_for_wall(Spot const& low, int cubes)
{
    for (std::size_t d = 0; d < 3; ++d)
        if (low[d] >= cubes_[d]) return;
    double const half = 0.5 * cubes, reach = std::sqrt(3.0) * half * edge_;
    if (std::abs(region_.at(place(low, {half, half, half}), reach).distance) > reach) return;
    if (cubes == 1) {
        near_.push_back(low);
        return;
    }
    int const part = cubes / 2;
    for (int k = 0; k < 8; ++k)
        look_for_wall({low[0] + (k & 1) * part, low[1] + (k >> 1 & 1) * part, low[2] + (k >> 2) * part}, part);
}

std::uint64_t Lattice::key(Spot const& corner)
{
    // Corners begin at -1 where a cube beside the lattice is asked for.
    auto const part = [](int at) { return static_cast<std::uint64_t>(at + 1); };
    return part(corner[0]) | part(corner[1]) << 21 | part(corner[2]) << 42;
}

double Lattice::distance(Spot const& corner)
{
    auto const [at, fresh] = distance_.try_emplace(key(corner), 0.0);
    if (fresh) at->second = region_.distance(place(corner));
    return at->second;
}

TangentPlane const& Lattice::crossing(Spot const& corner, std::size_t axis)
{
    // Keys of at most 2^20 + 1 corners in each direction leave room for three axes in 64 bits.
    auto const [at, fresh] = crossing_.try_emplace(key(corner) * 3 + static_cast<std::uint64_t>(axis), TangentPlane{});
    if (!fresh) return at->second;
    Spot end = corner;
    ++end[axis];
    Vec3 low = place(corner), high = place(end);
    double from = distance(corner), to = distance(end);
    bool const opens = to > 0;
    WallDistance wall{};
    Vec3 x;
    for (int step = 0; step < 60; ++step) {
        // Regula falsi where the distance is a straight line, halving in turn where it is not.
        double const straight = from / (from - to);
        double const part = step % 3 == 2 || !(straight > 0 && straight < 1) ? 0.5 : straight;
        x = low + part * (high - low);
        wall = region_.at(x);
        if (std::abs(wall.distance) < 1e-7 * edge_) break;
        if ((wall.distance > 0) == opens)
            high = x, to = wall.distance;
        else
            low = x, from = wall.distance;
    }
    at->second = {x - wall.distance * wall.normal, wall.normal};
    return at->second;
}
}
