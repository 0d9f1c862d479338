// Pictures of the bed cut at its mid-plane, drawn here: granules as shaded balls, droplets, gas, the chamber's outline.
//
// Needs neither a display nor a graphics library, so that a report can be made on any machine.
#pragma once

#include "granum/io/snapshot_file.hpp"
#include "granum/report/colour_map.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace granum::report
{
//! Part of the mid-plane that a picture shows, m.
struct Window
{
    double x0 = 0, z0 = 0, x1 = 1, z1 = 1;
};

//! Numbers that colours stand for.
struct ValueRange
{
    double low = 0, high = 1;
    double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

//! Range between the 1st and 99th percentile, so that single granules do not take the whole scale.
ValueRange typical_range(std::span<double const> values);

//! The chamber up to a little above the highest granules and nozzles.
Window window_of(io::Snapshot const& snapshot);

class Picture
{
  public:
    //! A white picture `height` pixels high.
    Picture(Window const& window, int height);

    //! Granules whose centres lie behind the cut, coloured by `values`; nearer ones hide farther ones.
    void draw_granules(io::Snapshot const& snapshot, std::span<double const> values, ValueRange const& range,
                       ColourMap const& map);
    //! A field of the gas slice, interpolated between the centres of open cells, within the outline.
    void draw_gas(io::Snapshot const& snapshot, std::span<double const> values, ValueRange const& range,
                  ColourMap const& map);
    //! Every droplet, as a dot of `colour` in front of everything.
    void draw_droplets(io::Snapshot const& snapshot, Colour const& colour);
    void draw_outline(io::Snapshot const& snapshot);

    int width() const { return width_; }
    int height() const { return height_; }
    Window const& window() const { return window_; }
    //! Mean colour of a pixel, 0 to 255 each.
    std::array<std::uint8_t, 3> pixel(int column, int row) const;
    //! The picture as the bytes of a PNG file. Throws base::IoError if libpng refuses.
    std::vector<std::byte> png() const;

  private:
    struct Dot
    {
        float red = 1, green = 1, blue = 1, depth = 1e30f;
    };
    static constexpr int fine = 2;  //!< drawn finer by this factor in each direction, then averaged

    double column_of(double x) const { return (x - window_.x0) * scale_; }
    double row_of(double z) const { return (window_.z1 - z) * scale_; }
    Dot& dot(int column, int row)
    {
        return dots_[static_cast<std::size_t>(row) * static_cast<std::size_t>(fine * width_) +
                     static_cast<std::size_t>(column)];
    }
    void draw_disc(double column, double row, double radius, Colour const& colour, double opacity);

    Window window_;
    int width_, height_;
    double scale_;  //!< fine dots per m
    std::vector<Dot> dots_;
};
}
