// Three numbers that belong together, with the algebra of vectors.
#pragma once

#include <cmath>
#include <cstddef>

namespace granum::math
{
struct Vec3
{
    double x = 0, y = 0, z = 0;

    constexpr double& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
    constexpr double operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
    constexpr Vec3& operator+=(Vec3 const& b)
    {
        x += b.x, y += b.y, z += b.z;
        return *this;
    }
    constexpr Vec3& operator-=(Vec3 const& b)
    {
        x -= b.x, y -= b.y, z -= b.z;
        return *this;
    }
    constexpr Vec3& operator*=(double s)
    {
        x *= s, y *= s, z *= s;
        return *this;
    }
    constexpr bool operator==(Vec3 const&) const = default;
};

constexpr Vec3 operator+(Vec3 a, Vec3 const& b)
{
    return a += b;
}
constexpr Vec3 operator-(Vec3 a, Vec3 const& b)
{
    return a -= b;
}
constexpr Vec3 operator-(Vec3 const& a)
{
    return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(double s, Vec3 a)
{
    return a *= s;
}
constexpr Vec3 operator*(Vec3 a, double s)
{
    return a *= s;
}
constexpr Vec3 operator/(Vec3 const& a, double s)
{
    return {a.x / s, a.y / s, a.z / s};
}
constexpr double dot(Vec3 const& a, Vec3 const& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 const& a, Vec3 const& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double norm2(Vec3 const& a)
{
    return dot(a, a);
}
inline double norm(Vec3 const& a)
{
    return std::sqrt(norm2(a));
}
inline bool finite(Vec3 const& a)
{
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
}
