// What is left of the drag where cells are too coarse to see the clusters and the gas that slips past them.
//
// Fitted to filtered runs of granules of Geldart's groups A and B in gas. Coarse granules in cells of up to four
// diameters need no such factor. The tables were compared with a public code that holds them; their pieces meet within
// rounding, but for two steps of a: from 21.51 to 2.46 at phi = 0.016 and from 1.88 to 1.79 at 0.4.
#pragma once

#include "granum/law/drag/flow.hpp"

#include <array>
#include <cmath>

namespace granum::law::drag
{
namespace filtered
{
//! A cubic in phi - start, up to `end`.
struct Piece
{
    double end;
    std::array<double, 4> coefficient;
    double start;
};

template <std::size_t size>
double piecewise(std::array<Piece, size> const& pieces, double phi)
{
    std::size_t i = 0;
    while (i + 1 < size && phi >= pieces[i].end) ++i;
    auto const& [c0, c1, c2, c3] = pieces[i].coefficient;
    double const x = phi - pieces[i].start;
    return c0 + x * (c1 + x * (c2 + x * c3));
}

//! The numbers a and h of the source at a solid fraction.
inline double a(double phi)
{
    static constexpr std::array<Piece, 6> pieces{{{0.016, {21.51, 0, 0, 0}, 0},
                                                  {0.100, {1.96, 29.40, 164.91, -1923}, 0},
                                                  {0.180, {4.63, 4.68, -412.04, 2254}, 0.10},
                                                  {0.250, {3.52, -17.99, 128.80, -603}, 0.18},
                                                  {0.400, {2.68, -8.20, 2.18, 112.33}, 0.25},
                                                  {1, {1.79, 0, 0, 0}, 0}}};
    return piecewise(pieces, phi);
}
inline double h(double phi)
{
    static constexpr std::array<Piece, 8> pieces{{{0.03, {0, 7.97, 0, 0}, 0},
                                                  {0.08, {0.239, 4.640, -4.410, 253.630}, 0.03},
                                                  {0.12, {0.492, 6.100, 33.630, -789.600}, 0.08},
                                                  {0.18, {0.739, 5.010, -61.100, 310.800}, 0.12},
                                                  {0.34, {0.887, 1.030, -5.170, 5.990}, 0.18},
                                                  {0.48, {0.943, -0.170, -2.290, -9.120}, 0.34},
                                                  {0.55, {0.850, -1.350, -6.130, -132.600}, 0.48},
                                                  {1, {0.680, -2.340, -225.200, 0}, 0.55}}};
    return piecewise(pieces, phi);
}
}

struct CoarseCell
{
    double solid_fraction;
    double width;              //!< cube root of the cell's volume, m
    double terminal_velocity;  //!< of a real granule, m/s
    double diameter;           //!< of a real granule, m
    double gravity;            //!< m/s2
    double parcel_ratio = 1;   //!< diameter of a parcel over that of a granule
    double parcel_rate = 0;    //!< k of the optional factor exp(k (1 - ratio)) for parcels; 0 leaves it out
};

//! Factor of the drag of any law, within [0.05, 1]. Source: Radl, Sundaresan, Chem. Eng. Sci. 117 (2014) 416.
inline double filtered_factor(CoarseCell const& cell)
{
    double const phi = Flow{cell.solid_fraction, 0}.phi();
    double const speed2 = cell.terminal_velocity * cell.terminal_velocity;
    double const froude = speed2 / (cell.gravity * cell.diameter);
    double const length = speed2 / cell.gravity / std::cbrt(froude * froude);
    double const clustered = 1 - filtered::h(phi) / (filtered::a(phi) * length / cell.width + 1);
    return std::clamp(clustered * std::exp(cell.parcel_rate * (1 - cell.parcel_ratio)), 0.05, 1.0);
}
}
