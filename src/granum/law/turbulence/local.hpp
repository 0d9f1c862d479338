// What the models of turbulence are given, the gas of one place, and what the two-equation models say of it.
#pragma once

#include <array>
#include <limits>

namespace granum::law::turbulence
{
//! Slopes du_d/dx_e of the mean velocity, [d][e], 1/s.
using Slopes = std::array<std::array<double, 3>, 3>;

struct Local
{
    Slopes slopes{};       //!< 1/s
    double viscosity = 0;  //!< kinematic, of the gas itself, m2/s
    double width = 0;      //!< of the cell: cube root of its volume, m
    double energy = 0;     //!< k, m2/s2
    double rate = 0;       //!< epsilon, m2/s3, or omega, 1/s: whichever the model transports
    double wall_distance = std::numeric_limits<double>::infinity();  //!< m
    double crossing = 0;                                             //!< grad k . grad rate

    //! 2 S:S of the symmetric gradient S without its isotropic part, 1/s2.
    double strain2() const
    {
        double const third = (slopes[0][0] + slopes[1][1] + slopes[2][2]) / 3;
        double sum = 0;
        for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t e = 0; e < 3; ++e) {
                double const s = 0.5 * (slopes[d][e] + slopes[e][d]) - (d == e ? third : 0);
                sum += s * s;
            }
        return 2 * sum;
    }
};

//! Sources and sinks of the two equations per mass: dk/dt = made - lost k, and so for the rate. None is negative.
struct Budget
{
    double made = 0, lost = 0;            //!< m2/s3, 1/s
    double rate_made = 0, rate_lost = 0;  //!< unit of the rate per s, 1/s
};

//! What the eddy viscosity is to be multiplied by in the diffusion of k and of the rate.
struct Spread
{
    double energy = 1, rate = 1;
};
}
