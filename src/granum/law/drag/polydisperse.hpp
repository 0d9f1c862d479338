// Drag on each size of a mixture, from a law that was fitted to equal spheres.
//
// The published factor eps y + phi y^2, y = d / <d>, belongs to the total force on a granule, with the part of the
// pressure gradient that its volume carries. The drag proper of flow.hpp is without that part, and its factor is y:
// with the pressure gradient of the whole mixture the published total comes out. Source: van der Hoef, Beetstra,
// Kuipers, J. Fluid Mech. 528 (2005) 233 (recalled); that the drag proper takes y alone follows from it.
#pragma once

#include "granum/base/error.hpp"
#include "granum/law/drag/flow.hpp"

#include <cstddef>
#include <span>

namespace granum::law::drag
{
//! Sauter mean <d> of granules of these diameters (m) and numbers, m: the sphere with their volume per area.
inline double sauter_mean(std::span<double const> diameters, std::span<double const> numbers)
{
    GRANUM_EXPECT(diameters.size() == numbers.size());
    double volume = 0, area = 0;
    for (std::size_t i = 0; i < diameters.size(); ++i) {
        double const square = numbers[i] * diameters[i] * diameters[i];
        volume += square * diameters[i];
        area += square;
    }
    return volume / area;
}

//! F of the size `y` = d / <d> in a mixture, to be used with its own d: the drag proper on it is
//! 3 pi mu d eps (u - v) F. The Reynolds number of `mean` is that of <d>.
template <class Law>
double force_ratio_of_size(Law const& law, Flow const& mean, double y)
{
    return y * law(mean);
}

//! The published term 0.064 eps y^3 of random mixtures; with it equal spheres would not have the drag of equal spheres.
enum class CubicTerm
{
    left_out,
    kept
};

//! The total force on the size `y`, with its part of the pressure gradient, over 3 pi mu d (u - v) F(phi, <Re>).
inline double total_force_share(double y, double solid_fraction, CubicTerm cubic = CubicTerm::left_out)
{
    double const eps = 1 - solid_fraction;
    double const square = eps * y + solid_fraction * y * y;
    return cubic == CubicTerm::kept ? square + 0.064 * eps * y * y * y : square;
}
}
