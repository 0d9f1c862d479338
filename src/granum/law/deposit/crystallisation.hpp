// How what is dissolved in a deposit becomes crystals: a family of two laws. The supersaturation that a deposit
// reaches, the number of its crystals and their size are features of its event: drying faster makes more and smaller
// ones.
#pragma once

#include "granum/base/type_list.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::deposit
{
//! Crystals in one cap: moments of their length, and what they weigh.
struct Crystals
{
    double mass = 0;             //!< kg
    double count = 0;            //!< crystals
    double length = 0;           //!< sum of their lengths, m
    double area = 0;             //!< sum of the squares of their lengths, m2
    double supersaturation = 0;  //!< largest so far: dissolved over what the water can hold
};

//! One cap at the end of a step.
struct Solution
{
    double water, solids;   //!< kg, the solids with the crystals
    double foot;            //!< m2 of its base, where crystals are born
    double solubility;      //!< kg solids per kg water
    double solids_density;  //!< kg/m3
};

//! Whatever water cannot hold is crystalline at once.
struct AtSaturation
{
    static constexpr base::Card card{.name = "at-saturation",
                                     .title = "crystals at once, no supersaturation",
                                     .source = "equilibrium of solution and crystals",
                                     .valid = "salts that crystallise faster than they dry"};
};

//! Crystals are born on the base, J = k (S - 1)^b per area and time, and grow by G = g (S - 1)^c, all alike; what water
//! can hold again dissolves at once.
struct NucleationGrowth
{
    static constexpr base::Card card{
        .name = "nucleation-growth",
        .title = "nucleation on the base and growth, by moments",
        .source =
            "moments of the length: Randolph, Larson, Theory of Particulate Processes, 1988 (recalled); orders and "
            "growth rate: placeholders of this program, the rate of nucleation such that a droplet of 40 um that "
            "dries in 0.5 s comes to 1.3 times saturation",
        .valid = "solutions of one salt, crystals of one shape"};

    double nucleation = 3.34e22;  //!< 1/m2/s
    double nucleation_order = 4;
    double growth = 1e-6;  //!< m/s
    double growth_order = 1.5;
    double shape = 0.5;  //!< volume of a crystal over the cube of its length

    //! Advances the crystals of a cap by `dt` s in which it came to `at`.
    void advance(Crystals& crystals, Solution const& at, double dt) const
    {
        double const held = at.water * at.solubility;  // kg that water can hold
        double const supersaturation = (at.solids - crystals.mass) / held;
        crystals.supersaturation = std::max(crystals.supersaturation, supersaturation);
        if (supersaturation <= 1) {
            dissolve(crystals, std::max(0.0, at.solids - held));
            return;
        }
        double const born = nucleation * at.foot * std::pow(supersaturation - 1, nucleation_order);
        double const free = growth * std::pow(supersaturation - 1, growth_order);
        double const per_volume = at.solids_density * shape, most = at.solids - held - crystals.mass;
        // Where growth would come to saturation within the step it comes just there.
        double g = free, gained = gain(crystals, born, g, dt) * per_volume;
        if (gained > most) {
            double low = 0, high = free;
            for (int k = 0; k < 40; ++k) {
                g = 0.5 * (low + high);
                (gain(crystals, born, g, dt) * per_volume > most ? high : low) = g;
            }
            gained = most;
        }
        crystals.area += dt * (2 * g * crystals.length + g * dt * (g * crystals.count + born * g * dt / 3));
        crystals.length += g * dt * (crystals.count + 0.5 * born * dt);
        crystals.count += born * dt;
        crystals.mass += gained;
    }

  private:
    //! Cubes of lengths that are added in `dt`, birth and growth being constant, m3.
    static double gain(Crystals const& c, double born, double g, double dt)
    {
        double const x = g * dt;
        return x * (3 * c.area + x * (3 * c.length + x * (c.count + 0.25 * born * dt)));
    }
    //! All lengths shrink in proportion until crystals weigh `mass`.
    static void dissolve(Crystals& c, double mass)
    {
        if (c.mass <= mass) return;
        double const ratio = std::cbrt(mass / c.mass);
        c.length *= ratio, c.area *= ratio * ratio, c.mass = mass;
        if (mass == 0) c.count = 0;
    }
};

using Crystallisation = base::TypeList<AtSaturation, NucleationGrowth>;
using AnyCrystallisation = Crystallisation::Any;
}
