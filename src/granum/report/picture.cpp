#include "granum/report/picture.hpp"

#include "granum/base/error.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>

namespace granum::report
{
namespace
{
//! Runs of x inside the outline at height z: pairs of ends, rising.
std::vector<double> crossings(std::vector<std::array<double, 2>> const& outline, double z)
{
    std::vector<double> out;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        auto const& a = outline[i];
        auto const& b = outline[(i + 1) % outline.size()];
        if (std::isnan(a[1]) || std::isnan(b[1])) continue;
        if ((a[1] <= z) != (b[1] <= z)) out.push_back(a[0] + (z - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    }
    std::sort(out.begin(), out.end());
    return out;
}
}

ValueRange typical_range(std::span<double const> values)
{
    std::vector<double> sorted;
    for (double const value : values)
        if (std::isfinite(value)) sorted.push_back(value);
    if (sorted.empty()) return {};
    std::sort(sorted.begin(), sorted.end());
    auto at = [&](double share) {
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
    };
    return {at(0.01), at(0.99)};
}

Window window_of(io::Snapshot const& snapshot)
{
    Window out{1e30, 1e30, -1e30, -1e30};
    for (auto const& corner : snapshot.outline) {
        out.x0 = std::min(out.x0, corner[0]), out.x1 = std::max(out.x1, corner[0]);
        out.z0 = std::min(out.z0, corner[1]), out.z1 = std::max(out.z1, corner[1]);
    }
    std::vector<double> tops;
    auto const& granules = snapshot.granules;
    for (auto const& x : granules.position) tops.push_back(x.z);
    if (snapshot.outline.empty()) {
        for (auto const& x : granules.position) {
            out.x0 = std::min(out.x0, x.x), out.x1 = std::max(out.x1, x.x);
            out.z0 = std::min(out.z0, x.z), out.z1 = std::max(out.z1, x.z);
        }
        if (!(out.x1 > out.x0)) out = {};
    }
    double top = typical_range(tops).high;
    for (auto const& nozzle : snapshot.nozzles) top = std::max(top, nozzle.z);
    if (!tops.empty())
        out.z1 = std::min(out.z1, std::max(out.z0 + 1.15 * (top - out.z0), out.z0 + 0.5 * (out.x1 - out.x0)));
    // A sloping wall is widest at the top: only what is in sight counts.
    if (!snapshot.outline.empty()) {
        double low = 1e30, high = -1e30;
        for (int step = 0; step <= 50; ++step) {
            double const z = out.z0 + (out.z1 - out.z0) * (0.001 + 0.998 * step / 50);
            for (double const x : crossings(snapshot.outline, z)) low = std::min(low, x), high = std::max(high, x);
        }
        if (high > low) out.x0 = low, out.x1 = high;
    }
    double const margin = 0.015 * std::max(out.x1 - out.x0, out.z1 - out.z0);
    return {out.x0 - margin, out.z0 - margin, out.x1 + margin, out.z1 + margin};
}

Picture::Picture(Window const& window, int height) : window_(window), height_(std::max(16, height))
{
    double const aspect = (window.x1 - window.x0) / (window.z1 - window.z0);
    width_ = std::clamp(static_cast<int>(std::lround(height_ * aspect)), 16, 8 * height_);
    scale_ = fine * height_ / (window.z1 - window.z0);
    dots_.resize(static_cast<std::size_t>(fine * width_) * static_cast<std::size_t>(fine * height_));
}

void Picture::draw_granules(io::Snapshot const& snapshot, std::span<double const> values, ValueRange const& range,
                            ColourMap const& map)
{
    auto const& granules = snapshot.granules;
    double deepest = 1e-9;
    for (auto const& x : granules.position) deepest = std::max(deepest, x.y - snapshot.mid_plane);
    for (std::size_t g = 0; g < std::min({granules.position.size(), granules.radius.size(), values.size()}); ++g) {
        auto const& x = granules.position[g];
        if (!math::finite(x) || x.y < snapshot.mid_plane) continue;
        Colour const colour = map(range.share(values[g]));
        double const radius = std::max(0.7, granules.radius[g] * scale_), column = column_of(x.x), row = row_of(x.z);
        double const distance = (x.y - snapshot.mid_plane) * scale_;
        double const mist = 0.3 * (x.y - snapshot.mid_plane) / deepest;
        for (int r = std::max(0, static_cast<int>(row - radius));
             r <= std::min(fine * height_ - 1, static_cast<int>(row + radius)); ++r)
            for (int c = std::max(0, static_cast<int>(column - radius));
                 c <= std::min(fine * width_ - 1, static_cast<int>(column + radius)); ++c) {
                double const a = (c + 0.5 - column) / radius, b = (r + 0.5 - row) / radius;
                double const rest = 1 - a * a - b * b;
                if (rest < 0) continue;
                double const towards = std::sqrt(rest);
                auto& here = dot(c, r);
                auto const depth = static_cast<float>(distance - towards * radius);
                if (depth >= here.depth) continue;
                // Light from the upper left in front; the rest of the ball is never black, so its colour can be read.
                double const light = std::clamp(-0.35 * a - 0.45 * b + 0.82 * towards, 0.0, 1.0);
                double const shade = 0.62 + 0.42 * light;
                auto mix = [&](double part) {
                    return static_cast<float>(std::min(1.0, part * shade) * (1 - mist) + mist);
                };
                here = {mix(colour.red), mix(colour.green), mix(colour.blue), depth};
            }
    }
}

void Picture::draw_gas(io::Snapshot const& snapshot, std::span<double const> values, ValueRange const& range,
                       ColourMap const& map)
{
    auto const& gas = snapshot.gas;
    if (gas.nx < 1 || gas.nz < 1 || !(gas.dx > 0) || !(gas.dz > 0)) return;
    if (values.size() != static_cast<std::size_t>(gas.nx) * static_cast<std::size_t>(gas.nz)) return;
    auto value_at = [&](int i, int k, double& value) {
        auto const cell = static_cast<std::size_t>(std::clamp(k, 0, gas.nz - 1)) * static_cast<std::size_t>(gas.nx) +
                          static_cast<std::size_t>(std::clamp(i, 0, gas.nx - 1));
        value = values[cell];
        return std::isfinite(value) && (gas.open.empty() || gas.open[cell] > 0);
    };
    for (int r = 0; r < fine * height_; ++r) {
        double const z = window_.z1 - (r + 0.5) / scale_;
        if (z < gas.z0 || z > gas.z0 + gas.nz * gas.dz) continue;
        auto ends = crossings(snapshot.outline, z);
        if (snapshot.outline.empty()) ends = {gas.x0, gas.x0 + gas.nx * gas.dx};
        for (std::size_t run = 0; run + 1 < ends.size(); run += 2)
            for (int c = std::max(0, static_cast<int>(column_of(ends[run])));
                 c < std::min<double>(fine * width_, column_of(ends[run + 1])); ++c) {
                double const x = window_.x0 + (c + 0.5) / scale_;
                double const u = (x - gas.x0) / gas.dx - 0.5, w = (z - gas.z0) / gas.dz - 0.5;
                int const i = static_cast<int>(std::floor(u)), k = static_cast<int>(std::floor(w));
                double sum = 0, weight = 0;
                for (int corner = 0; corner < 4; ++corner) {
                    int const di = corner & 1, dk = corner >> 1;
                    double const share = std::abs(1 - di - (u - i)) * std::abs(1 - dk - (w - k));
                    double value = 0;
                    if (!value_at(i + di, k + dk, value)) continue;
                    sum += (share + 1e-9) * value, weight += share + 1e-9;
                }
                if (weight <= 0) continue;
                Colour const colour = map(range.share(sum / weight));
                dot(c, r) = {static_cast<float>(colour.red), static_cast<float>(colour.green),
                             static_cast<float>(colour.blue), 0};
            }
    }
}

void Picture::draw_disc(double column, double row, double radius, Colour const& colour, double opacity)
{
    for (int r = std::max(0, static_cast<int>(row - radius));
         r <= std::min(fine * height_ - 1, static_cast<int>(row + radius)); ++r)
        for (int c = std::max(0, static_cast<int>(column - radius));
             c <= std::min(fine * width_ - 1, static_cast<int>(column + radius)); ++c) {
            if (std::hypot(c + 0.5 - column, r + 0.5 - row) > radius) continue;
            auto& here = dot(c, r);
            auto mix = [&](float old, double part) { return static_cast<float>((1 - opacity) * old + opacity * part); };
            here = {mix(here.red, colour.red), mix(here.green, colour.green), mix(here.blue, colour.blue), here.depth};
        }
}

void Picture::draw_droplets(io::Snapshot const& snapshot, Colour const& colour)
{
    double const radius = std::max(1.0, 0.0022 * fine * height_);
    for (auto const& x : snapshot.droplets.position)
        if (math::finite(x)) draw_disc(column_of(x.x), row_of(x.z), radius, colour, 0.75);
}

void Picture::draw_outline(io::Snapshot const& snapshot)
{
    auto const& outline = snapshot.outline;
    double const radius = std::max(1.2, 0.0022 * fine * height_);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        auto const& a = outline[i];
        auto const& b = outline[(i + 1) % outline.size()];
        if (std::isnan(a[1]) || std::isnan(b[1])) continue;
        double const length = std::hypot(b[0] - a[0], b[1] - a[1]) * scale_;
        int const steps = std::clamp(static_cast<int>(length), 1, 20000);
        for (int s = 0; s <= steps; ++s) {
            double const share = static_cast<double>(s) / steps;
            draw_disc(column_of(a[0] + share * (b[0] - a[0])), row_of(a[1] + share * (b[1] - a[1])), radius,
                      {0.2, 0.22, 0.25}, 1);
        }
    }
    for (auto const& nozzle : snapshot.nozzles)
        for (int s = 0; s < 12; ++s)
            draw_disc(column_of(nozzle.x), row_of(nozzle.z) - s * 0.6 * radius, radius * (0.8 + 0.12 * s),
                      {0.2, 0.22, 0.25}, 1);
}

std::array<std::uint8_t, 3> Picture::pixel(int column, int row) const
{
    double sum[3] = {};
    for (int b = 0; b < fine; ++b)
        for (int a = 0; a < fine; ++a) {
            auto const& d = dots_[static_cast<std::size_t>(fine * row + b) * static_cast<std::size_t>(fine * width_) +
                                  static_cast<std::size_t>(fine * column + a)];
            sum[0] += d.red, sum[1] += d.green, sum[2] += d.blue;
        }
    auto byte = [](double part) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part / (fine * fine), 0.0, 1.0)));
    };
    return {byte(sum[0]), byte(sum[1]), byte(sum[2])};
}

std::vector<std::byte> Picture::png() const
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int row = 0; row < height_; ++row)
        for (int column = 0; column < width_; ++column) {
            auto const colours = pixel(column, row);
            bytes.insert(bytes.end(), colours.begin(), colours.end());
        }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width_);
    image.height = static_cast<png_uint_32>(height_);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> out(size);
    if (png_image_write_to_memory(&image, out.data(), &size, 0, bytes.data(), 0, nullptr) == 0)
        throw base::IoError(fmt::format("a picture of {} x {} cannot be made: {}", width_, height_, image.message));
    out.resize(size);
    return out;
}
}
