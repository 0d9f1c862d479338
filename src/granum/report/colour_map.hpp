// Colours for numbers: maps whose lightness rises steadily, so that they read in grey and for the colour blind.
//
// Stops are samples of matplotlib's "plasma" and "viridis" (public domain, CC0); the third is our own, pale to dark.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace granum::report
{
struct Colour
{
    double red = 0, green = 0, blue = 0;  //!< 0 to 1
};

struct ColourMap
{
    std::array<std::uint32_t, 11> stops;  //!< 0xRRGGBB at 0, 0.1 ... 1

    //! Colour of a share from 0 to 1; beyond that the end's.
    Colour operator()(double share) const
    {
        double const at = 10 * std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0);
        auto const stop = std::min<std::size_t>(9, static_cast<std::size_t>(at));
        double const rest = at - static_cast<double>(stop);
        auto part = [&](int shift) {
            double const a = stops[stop] >> shift & 255, b = stops[stop + 1] >> shift & 255;
            return (a + rest * (b - a)) / 255;
        };
        return {part(16), part(8), part(0)};
    }
};

inline constexpr ColourMap plasma{
    {0x0d0887, 0x41049d, 0x6a00a8, 0x8f0da4, 0xb12a90, 0xcc4778, 0xe16462, 0xf2844b, 0xfca636, 0xfcce25, 0xf0f921}};
inline constexpr ColourMap viridis{
    {0x440154, 0x482475, 0x414487, 0x355f8d, 0x2a788e, 0x21918c, 0x22a884, 0x44bf70, 0x7ad151, 0xbddf26, 0xfde725}};
//! Dry sand to deep water.
inline constexpr ColourMap wetness{
    {0xeadfc4, 0xdcdcc6, 0xc6d8ca, 0xaad0d0, 0x8cc3d4, 0x6eb2d3, 0x529dcb, 0x3a85bd, 0x286ba8, 0x1a508b, 0x0b356b}};
}
