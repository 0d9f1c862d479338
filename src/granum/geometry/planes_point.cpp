#include "granum/geometry/planes_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace granum::geometry
{
namespace
{
constexpr double least = 0.05;  // of the largest eigenvalue: tan^2 of half the angle between two planes

using Matrix = std::array<std::array<double, 3>, 3>;

//! Turns the symmetric matrix into a diagonal one and gives its directions. Jacobi's rotations.
std::array<Vec3, 3> eigenvectors(Matrix& a)
{
    std::array<Vec3, 3> v{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (int sweep = 0; sweep < 12; ++sweep)
        for (std::size_t p = 0; p < 2; ++p)
            for (std::size_t q = p + 1; q < 3; ++q) {
                if (a[p][q] == 0) continue;
                double const half = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                double const t = (half < 0 ? -1 : 1) / (std::abs(half) + std::sqrt(half * half + 1));
                double const c = 1 / std::sqrt(t * t + 1), s = t * c;
                for (std::size_t k = 0; k < 3; ++k) {
                    double const kp = a[k][p], kq = a[k][q];
                    a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    double const pk = a[p][k], qk = a[q][k];
                    a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
                }
                Vec3 const vp = v[p], vq = v[q];
                v[p] = c * vp - s * vq, v[q] = s * vp + c * vq;
            }
    return v;
}
}

Vec3 planes_point(std::span<TangentPlane const> planes, Vec3 const& start, int most)
{
    Matrix sum{};
    Vec3 right;
    for (auto const& [point, normal] : planes) {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) sum[i][k] += normal[i] * normal[k];
        right += dot(normal, point - start) * normal;
    }
    auto const directions = eigenvectors(sum);
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) { return sum[i][i] > sum[k][k]; });
    Vec3 out = start;
    for (int k = 0; k < most; ++k) {
        std::size_t const at = order[static_cast<std::size_t>(k)];
        if (!(sum[at][at] > least * sum[order[0]][order[0]])) break;
        out += (dot(directions[at], right) / sum[at][at]) * directions[at];
    }
    return out;
}
}
