// Pictures of the bed, with their axes and colour bars as text around them.
#include "granum/io/base64.hpp"
#include "granum/io/text_file.hpp"
#include "granum/math/constants.hpp"
#include "granum/report/chart.hpp"
#include "granum/report/html.hpp"
#include "granum/report/picture.hpp"
#include "granum/report/sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace granum::report
{
namespace
{
constexpr int report_height = 760, readme_height = 1200;
constexpr Colour droplet_on_temperature{0.05, 0.55, 0.75}, droplet_on_moisture{0.85, 0.15, 0.1};

void save(RunFolder const& run, std::string const& name, std::vector<std::byte> const& png)
{
    auto const folder = std::filesystem::path(run.path) / "pictures";
    std::filesystem::create_directories(folder);
    io::replace_text(folder / name, {reinterpret_cast<char const*>(png.data()), png.size()});
}

//! Widens a range that is too narrow to show with colours.
ValueRange at_least(ValueRange range, double width)
{
    if (range.high - range.low >= width) return range;
    double const centre = 0.5 * (range.low + range.high);
    return {centre - width / 2, centre + width / 2};
}

std::string colour_bar(std::string const& id, ColourMap const& map, ValueRange const& range, std::string const& label,
                       double x0, double width, double y)
{
    std::string out = fmt::format("<defs><linearGradient id=\"{}\">", id);
    for (int stop = 0; stop <= 10; ++stop) {
        auto const colour = map(stop / 10.0);
        out += fmt::format("<stop offset=\"{}%\" stop-color=\"rgb({:.0f},{:.0f},{:.0f})\"/>", 10 * stop,
                           255 * colour.red, 255 * colour.green, 255 * colour.blue);
    }
    out += fmt::format(
        "</linearGradient></defs><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"12\" fill=\"url(#{})\" "
        "stroke=\"#555\" stroke-width=\"0.6\"/>",
        x0, y, width, id);
    auto const marks = ticks(range.low, range.high, 4);
    double const step = marks.size() > 1 ? marks[1] - marks[0] : 1;
    int const decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
    for (double const value : marks) {
        double const at = x0 + width * range.share(value);
        out += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" class=\"axis\"/>", at,
                           y + 12, y + 16);
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.{}f}</text>", at, y + 28,
                           std::abs(value) < 1e-12 ? 0.0 : value, decimals);
    }
    return out + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" class=\"strong\">{}</text>",
                             x0 + width / 2, y + 46, escape(label));
}

//! The picture with heights and widths in mm and its colour bar.
std::string framed(Picture const& picture, std::vector<std::byte> const& png, std::string const& id,
                   ColourMap const& map, ValueRange const& range, std::string const& label)
{
    constexpr double margin_left = 42, margin_top = 6, margin_right = 10, image_width = 310;
    double const image_height = image_width * picture.height() / picture.width();
    double const bar_y = margin_top + image_height + 40, height = bar_y + 52;
    auto const& window = picture.window();
    std::string out = fmt::format("<svg class=\"picture\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\"><title>{}</title>",
                                  margin_left + image_width + margin_right, height, escape(label));
    out += fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{:.2f}\" href=\"data:image/png;base64,{}\"/>",
                       margin_left, margin_top, image_width, image_height, io::base64(png));
    double const per_metre = image_width / (window.x1 - window.x0);
    for (double const x : ticks(1000 * window.x0, 1000 * window.x1, 5)) {
        double const at = margin_left + (x / 1000 - window.x0) * per_metre;
        out += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" class=\"axis\"/>", at,
                           margin_top + image_height, margin_top + image_height + 4);
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.0f}</text>", at,
                           margin_top + image_height + 17, x);
    }
    for (double const z : ticks(1000 * window.z0, 1000 * window.z1, 6)) {
        double const at = margin_top + (window.z1 - z / 1000) * per_metre;
        out += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" class=\"axis\"/>",
                           margin_left - 4, margin_left, at, at);
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.0f}</text>", margin_left - 7, at + 4,
                           z);
    }
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">width and height in mm</text>",
                       margin_left + image_width / 2, margin_top + image_height + 31);
    return out + colour_bar(id, map, range, label, margin_left + 10, image_width - 20, bar_y) + "</svg>";
}

std::vector<double> scaled(std::vector<double> values, double factor, double offset)
{
    for (auto& value : values) value = factor * value + offset;
    return values;
}
}

std::string pictures_section(RunFolder const& run)
{
    if (!run.snapshot)
        return section("pictures", "The bed", figure("", "Granules and gas in the middle of the chamber."));
    auto const& snapshot = *run.snapshot;
    auto const& granules = snapshot.granules;
    Window const window = window_of(snapshot);
    std::string out = fmt::format(
        "<p>The chamber cut at its middle, {} after the start. Granules behind the cut are shown, "
        "those farther away paler.</p><div class=\"pictures\">",
        quantity(snapshot.time, "s", 3));

    auto const celsius = scaled(granules.temperature, 1, -math::zero_celsius);
    if (!celsius.empty()) {
        ValueRange const range = at_least(typical_range(celsius), 0.5);
        auto draw = [&](int height) {
            Picture picture(window, height);
            picture.draw_granules(snapshot, celsius, range, plasma);
            picture.draw_droplets(snapshot, droplet_on_temperature);
            picture.draw_outline(snapshot);
            return picture;
        };
        auto const picture = draw(report_height);
        auto const png = picture.png();
        save(run, "temperature.png", png);
        save(run, "bed.png", draw(readme_height).png());
        out += figure(framed(picture, png, "bar-temperature", plasma, range, "granule temperature (°C)"),
                      "Granule temperature: cold granules show where liquid lands and dries.");
    }
    if (celsius.empty() && !granules.velocity.empty()) {
        std::vector<double> speed;
        for (auto const& v : granules.velocity) speed.push_back(norm(v));
        ValueRange range = typical_range(speed);
        range = {0, std::max(range.high, 1e-3)};
        Picture picture(window, report_height);
        picture.draw_granules(snapshot, speed, range, viridis);
        picture.draw_outline(snapshot);
        auto const png = picture.png();
        save(run, "speed.png", png);
        out += figure(framed(picture, png, "bar-granule-speed", viridis, range, "granule speed (m/s)"),
                      "Granule speed: the few fastest share the last colour.");
    }
    auto const moisture = scaled(granules.moisture, 1000, 0);
    if (!moisture.empty()) {
        ValueRange range = typical_range(moisture);
        range.low = std::min(0.0, range.low);
        range = range.high > 1e-6 ? range : ValueRange{0, 1};
        Picture picture(window, report_height);
        picture.draw_granules(snapshot, moisture, range, wetness);
        picture.draw_droplets(snapshot, droplet_on_moisture);
        picture.draw_outline(snapshot);
        auto const png = picture.png();
        save(run, "moisture.png", png);
        out += figure(framed(picture, png, "bar-moisture", wetness, range, "liquid water on granules (g per kg dry)"),
                      "Granule moisture, with droplets in flight as red dots: the dark region is the spray zone.");
    }
    if (!snapshot.gas.speed.empty()) {
        ValueRange range = typical_range(snapshot.gas.speed);
        range = {0, std::max(range.high, 1e-3)};
        Picture picture(window, report_height);
        picture.draw_gas(snapshot, snapshot.gas.speed, range, viridis);
        picture.draw_outline(snapshot);
        auto const png = picture.png();
        save(run, "gas_speed.png", png);
        out += figure(framed(picture, png, "bar-speed", viridis, range, "gas speed (m/s)"),
                      "Gas speed in the cut: bright streaks are bubbles and the jet of the nozzle; the few fastest "
                      "cells share the last colour.");
    }
    return section("pictures", "The bed", out + "</div>");
}
}
