#include "granum/geometry/bounds.hpp"

#include <algorithm>
#include <cmath>

namespace granum::geometry
{
void Bounds::widen(Vec3 const& low, Vec3 const& high)
{
    for (std::size_t d = 0; d < 3; ++d) {
        lower[d] = std::min(lower[d], low[d]);
        upper[d] = std::max(upper[d], high[d]);
    }
}

void Bounds::widen_by_circle(Vec3 const& centre, Vec3 const& normal, double radius)
{
    Vec3 half;
    for (std::size_t d = 0; d < 3; ++d) half[d] = radius * std::sqrt(std::max(0.0, 1 - normal[d] * normal[d]));
    widen(centre - half, centre + half);
}

double Bounds::size() const
{
    return norm(upper - lower);
}

double Bounds::distance(Vec3 const& x) const
{
    double sum = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        double const off = std::max({lower[d] - x[d], x[d] - upper[d], 0.0});
        sum += off * off;
    }
    return std::sqrt(sum);
}

bool Bounds::holds(Bounds const& other) const
{
    for (std::size_t d = 0; d < 3; ++d)
        if (other.lower[d] < lower[d] || other.upper[d] > upper[d]) return false;
    return true;
}

Bounds overlap(Bounds const& a, Bounds const& b)
{
    Bounds out;
    for (std::size_t d = 0; d < 3; ++d) {
        out.lower[d] = std::max(a.lower[d], b.lower[d]);
        out.upper[d] = std::min(a.upper[d], b.upper[d]);
    }
    return out;
}
}
