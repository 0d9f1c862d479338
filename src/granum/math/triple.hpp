// A vector whose components are Reals: doubles, or registers of doubles that belong to as many contacts.
#pragma once

#include "granum/math/real.hpp"
#include "granum/math/vec3.hpp"

namespace granum::math
{
template <class Real>
struct Triple
{
    Real x, y, z;
};

template <class Real>
Triple<Real> operator+(Triple<Real> const& a, Triple<Real> const& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
Triple<Real> operator-(Triple<Real> const& a, Triple<Real> const& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
Triple<Real> operator-(Triple<Real> const& a)
{
    return {-a.x, -a.y, -a.z};
}
template <class Real>
Triple<Real> operator*(Real s, Triple<Real> const& a)
{
    return {s * a.x, s * a.y, s * a.z};
}
//! s a + b.
template <class Real>
Triple<Real> mul_add(Real s, Triple<Real> const& a, Triple<Real> const& b)
{
    return {mul_add(s, a.x, b.x), mul_add(s, a.y, b.y), mul_add(s, a.z, b.z)};
}
//! b - s a.
template <class Real>
Triple<Real> neg_mul_add(Real s, Triple<Real> const& a, Triple<Real> const& b)
{
    return {neg_mul_add(s, a.x, b.x), neg_mul_add(s, a.y, b.y), neg_mul_add(s, a.z, b.z)};
}
template <class Real>
Real dot(Triple<Real> const& a, Triple<Real> const& b)
{
    return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z));
}
template <class Real>
Triple<Real> cross(Triple<Real> const& a, Triple<Real> const& b)
{
    return {mul_sub(a.y, b.z, a.z * b.y), mul_sub(a.z, b.x, a.x * b.z), mul_sub(a.x, b.y, a.y * b.x)};
}
//! c - a x b.
template <class Real>
Triple<Real> minus_cross(Triple<Real> const& c, Triple<Real> const& a, Triple<Real> const& b)
{
    return {neg_mul_add(a.y, b.z, mul_add(a.z, b.y, c.x)), neg_mul_add(a.z, b.x, mul_add(a.x, b.z, c.y)),
            neg_mul_add(a.x, b.y, mul_add(a.y, b.x, c.z))};
}
template <class Real>
Real norm2(Triple<Real> const& a)
{
    return dot(a, a);
}

inline Triple<double> triple(Vec3 const& a)
{
    return {a.x, a.y, a.z};
}
inline Vec3 vec3(Triple<double> const& a)
{
    return {a.x, a.y, a.z};
}
}
