// Two spheres that touch or nearly touch, or a sphere and a flat wall, as the laws of conduction through the gas
// between them are given.
//
// The laws return a length S: heat k_gas S (T_j - T_i), with the gas's conductivity.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace granum::law::film
{
struct Pair
{
    double radius;              //!< of the one, m
    double other;               //!< of the other, m; infinite for a flat wall
    double gap;                 //!< between the surfaces, m; negative where they overlap
    double lens = 0.2;          //!< thickness of the gas that conducts, over the radius of the larger sphere
    double shortest = 2.75e-8;  //!< way through the gas that is never undercut, m: some mean free path

    bool wall() const { return std::isinf(radius) || std::isinf(other); }
    double smaller() const { return std::min(radius, other); }
    double larger() const { return std::max(radius, other); }
    double distance() const { return radius + other + gap; }  //!< of the centres; not for a wall

    //! Way through the gas at the distance `r` from the line of centres, without the bound, m.
    double way(double r) const
    {
        double const one = smaller();
        if (wall()) return one + gap - std::sqrt((one - r) * (one + r));
        return distance() - std::sqrt((one - r) * (one + r)) - std::sqrt((larger() - r) * (larger() + r));
    }

    //! Radius of the circle in which overlapping surfaces cut, m; nothing with a gap.
    double inner() const { return gap < 0 ? cut(smaller(), larger(), gap) : 0; }

    //! Radius of the circle to which the gas conducts, m: there the larger sphere with its gas (of a wall: the sphere
    //! with its gas) cuts the other's surface. At most the radius of the smaller; nothing where they do not cut.
    double outer() const
    {
        if (wall()) {
            double const reach = (1 + lens) * smaller(), height = smaller() + gap;
            return reach > height ? std::min(smaller(), std::sqrt((reach - height) * (reach + height))) : 0;
        }
        double const shell = lens * larger();
        // Beyond the smaller sphere's equator the circle would shrink again: all of the near half conducts.
        if (distance() * distance() + smaller() * smaller() <= std::pow(larger() + shell, 2)) return smaller();
        return gap < shell ? cut(smaller(), larger() + shell, gap - shell) : 0;
    }

  private:
    //! Radius of the circle in which spheres of radius `a` and `b` cut whose surfaces overlap by -`gap`.
    static double cut(double a, double b, double gap)
    {
        if (std::isinf(b)) return std::sqrt(-gap * (2 * a + gap));
        double const distance = a + b + gap;
        // Half the height of the triangle a, b, distance, by Heron's formula in the form that keeps small overlaps.
        double const product = -gap * (distance + a + b) * (distance + a - b) * (distance - a + b);
        return product > 0 ? std::sqrt(product) / (2 * distance) : 0;
    }
};
}
