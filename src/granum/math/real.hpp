// The arithmetic that formulas use which run on a double or on a register of doubles alike.
//
// A formula is a template over Real and calls these names without a namespace: for a double they are found here, for a
// class of registers beside that class. Comparisons of Reals give masks, combined by &, | and !; `select` takes them.
// Both of its values are computed in every lane, so a value that is not selected must still be finite.
#pragma once

#include <cmath>

namespace granum::math
{
//! a b + c.
inline double mul_add(double a, double b, double c)
{
    return a * b + c;
}
//! a b - c.
inline double mul_sub(double a, double b, double c)
{
    return a * b - c;
}
//! c - a b.
inline double neg_mul_add(double a, double b, double c)
{
    return c - a * b;
}
inline double sqrt(double x)
{
    return std::sqrt(x);
}
inline double reciprocal(double x)
{
    return 1 / x;
}
inline double reciprocal_sqrt(double x)
{
    return 1 / std::sqrt(x);
}
//! x^(-1/4).
inline double inverse_fourth_root(double x)
{
    return 1 / std::sqrt(std::sqrt(x));
}
inline double max(double a, double b)
{
    return a > b ? a : b;
}
inline double min(double a, double b)
{
    return a < b ? a : b;
}
inline double abs(double x)
{
    return std::fabs(x);
}
//! Whether the mask is set anywhere: for work that most often is not needed.
inline bool any(bool mask)
{
    return mask;
}
//! a where the mask is set, b elsewhere.
inline double select(bool mask, double a, double b)
{
    return mask ? a : b;
}
}
