#include "granum/report/chart.hpp"

#include "granum/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace granum::report
{
namespace
{
constexpr double width = 520, height = 270, left = 70, right = 16, top = 34, bottom = 46;

//! Data range of one direction and its place on the paper.
struct Scale
{
    double low, high, from, to;
    bool logarithmic = false;

    double operator()(double value) const
    {
        double const share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
        return from + share * (to - from);
    }
};

struct Range
{
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void cover(double value)
    {
        if (!std::isfinite(value)) return;
        low = std::min(low, value), high = std::max(high, value);
    }
    bool any() const { return low <= high; }
};

char const* dashes(Stroke stroke)
{
    return stroke == Stroke::dashed   ? " stroke-dasharray=\"7 4\""
           : stroke == Stroke::dotted ? " stroke-dasharray=\"2 3\""
                                      : "";
}

//! Text of a tick, with the decimals that its step needs.
std::string tick_text(double value, double step)
{
    if (std::abs(value) < 1e-9 * step) return "0";
    double const size = std::max(std::abs(value), step);
    if (size >= 1e6 || size < 1e-4) return fmt::format("{:.2g}", value);
    int const decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 8);
    return fmt::format("{:.{}f}", value, decimals);
}

//! 1, 2, 5 of each decade in [low, high]; only the 1s where that would be too many.
std::vector<double> decade_ticks(double low, double high)
{
    std::vector<double> out;
    bool const sparse = std::log10(high / low) > 3;
    for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
        for (double const factor : {1.0, 2.0, 5.0})
            if ((factor == 1 || !sparse) && decade * factor >= low * 0.999 && decade * factor <= high * 1.001)
                out.push_back(decade * factor);
    return out;
}

//! Frame, grid, ticks and labels of a chart.
std::string frame(Scale const& x, Scale const& y, std::string const& x_label, std::string const& y_label)
{
    std::string out;
    auto const y_ticks = ticks(y.low, y.high, 5);
    double const y_step = y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : 1;
    for (double const value : y_ticks) {
        double const at = y(value);
        out += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" class=\"grid\"/>", x.from,
                           x.to, at, at);
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", x.from - 6, at + 4,
                           tick_text(value, y_step));
    }
    auto const x_ticks = x.logarithmic ? decade_ticks(x.low, x.high) : ticks(x.low, x.high, 6);
    double const x_step = x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1;
    for (double const value : x_ticks) {
        double const at = x(value);
        out += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" class=\"axis\"/>", at,
                           y.from, y.from + 4);
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>", at, y.from + 17,
                           x.logarithmic ? fmt::format("{:g}", value) : tick_text(value, x_step));
    }
    out += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\" class=\"axis\" fill=\"none\"/>", x.from, y.to, y.from,
                       x.to);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>", (x.from + x.to) / 2,
                       height - 8, escape(x_label));
    out += fmt::format("<text transform=\"translate(12 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                       (y.from + y.to) / 2, escape(y_label));
    return out;
}

struct LegendEntry
{
    std::string label, colour;
    Stroke stroke;
};

constexpr double row_height = 18;

//! Samples of the lines and their names above the chart, in as many rows as they need; the last is at its place, the
//! others above it, and `rows` tells how many.
std::string legend(std::vector<LegendEntry> const& entries, int& rows)
{
    auto const length = [](LegendEntry const& entry) {
        return 31 + 6.3 * static_cast<double>(entry.label.size()) + 18;
    };
    std::vector<std::pair<double, int>> places;
    double at = left;
    rows = 1;
    for (auto const& entry : entries) {
        if (at > left && at + length(entry) > width) at = left, ++rows;
        places.emplace_back(at, rows);
        at += length(entry);
    }
    std::string out;
    for (std::size_t k = 0; k < entries.size(); ++k) {
        auto const [x, row] = places[k];
        double const y = 16 - row_height * (rows - row);
        out += fmt::format(
            "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
            "stroke-width=\"2\"{}/>",
            x, x + 26, y, y, entries[k].colour, dashes(entries[k].stroke));
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x + 31, y + 4, escape(entries[k].label));
    }
    return out;
}

//! Long curves are drawn through the lowest and highest value of each stretch, which looks the same.
std::string path_of(Curve const& curve, Scale const& x, Scale const& y)
{
    std::size_t const rows = std::min(curve.x.size(), curve.y.size());
    std::size_t const stretch = std::max<std::size_t>(1, rows / 400);
    std::string out;
    bool pen_down = false;
    auto go = [&](std::size_t row) {
        out += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', x(curve.x[row]), y(curve.y[row]));
        pen_down = true;
    };
    for (std::size_t start = 0; start < rows; start += stretch) {
        std::size_t low = rows, high = rows;
        for (std::size_t row = start; row < std::min(rows, start + stretch); ++row) {
            if (!std::isfinite(curve.x[row]) || !std::isfinite(curve.y[row])) continue;
            if (low == rows || curve.y[row] < curve.y[low]) low = row;
            if (high == rows || curve.y[row] > curve.y[high]) high = row;
        }
        if (low == rows) {
            pen_down = false;
            continue;
        }
        go(std::min(low, high));
        if (low != high) go(std::max(low, high));
    }
    return out;
}

//! An svg of what is drawn and its legend, as high as both need.
std::string whole_svg(std::string const& title, std::string const& drawn, std::vector<LegendEntry> const& entries)
{
    int rows = 1;
    auto const names = legend(entries, rows);
    double const more = row_height * (rows - 1);
    return fmt::format("<svg class=\"chart\" viewBox=\"0 {} {} {}\" role=\"img\"><title>{}</title>{}{}</svg>", -more,
                       width, height + more, escape(title), drawn, names);
}
}

std::vector<double> ticks(double low, double high, int count)
{
    double const raw = (high - low) / count;
    // A range of nothing but rounding has no ticks in it: counting them in its steps would not end.
    if (!(raw > 1e-12 * std::max(std::abs(low), std::abs(high))) || !std::isfinite(raw)) return {low};
    double const decade = std::pow(10, std::floor(std::log10(raw)));
    double const rest = raw / decade;
    double const step = decade * (rest < 1.5 ? 1 : rest < 3.5 ? 2 : rest < 7.5 ? 5 : 10);
    std::vector<double> out;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
        out.push_back(k * step + 0.0);  // + 0: never -0
    return out;
}

std::string svg(CurveChart const& chart)
{
    Range x, y;
    for (auto const& curve : chart.curves) {
        for (std::size_t row = 0; row < std::min(curve.x.size(), curve.y.size()); ++row) {
            if (!std::isfinite(curve.y[row]) || (chart.x.logarithmic && curve.x[row] <= 0)) continue;
            x.cover(curve.x[row]), y.cover(curve.y[row]);
        }
    }
    if (!y.any()) return "";
    for (auto const& level : chart.levels) y.cover(level.value);
    // A flat curve gets a range of 1 % of its value, so that noise does not look like an event.
    double const least = std::max(0.01 * std::max(std::abs(y.low), std::abs(y.high)), 1e-12);
    double const pad = std::max(0.06 * (y.high - y.low), 0.5 * (least - (y.high - y.low)));
    bool const from_zero = y.low >= 0 && y.low < 0.2 * y.high;
    Scale const across{x.low, x.high > x.low ? x.high : x.low + 1, left, width - right, chart.x.logarithmic};
    Scale const up{from_zero ? 0 : y.low - pad, y.high + pad, height - bottom, top};

    std::string out = frame(across, up, chart.x.label, chart.y.label);
    std::vector<LegendEntry> entries;
    for (auto const& curve : chart.curves) {
        out +=
            fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-linejoin=\"round\"{}/>",
                        path_of(curve, across, up), curve.colour, dashes(curve.stroke));
        if (!curve.label.empty()) entries.push_back({curve.label, curve.colour, curve.stroke});
    }
    for (auto const& level : chart.levels) {  // above the curves, on a pale band, or a noisy curve would hide them
        if (!std::isfinite(level.value)) continue;
        std::string const line = fmt::format("M{:.1f} {:.1f}H{:.1f}", across.from, up(level.value), across.to);
        out += fmt::format("<path d=\"{}\" stroke=\"#fff\" stroke-width=\"4\" stroke-opacity=\"0.75\"/>", line);
        out += fmt::format("<path d=\"{}\" stroke=\"#222\" stroke-width=\"1.8\"{}/>", line, dashes(Stroke::dashed));
    }
    for (auto const& level : chart.levels)
        if (std::isfinite(level.value)) entries.push_back({level.label, "#222", Stroke::dashed});
    return whole_svg(chart.y.label, out, entries);
}

std::string svg(HistogramChart const& chart)
{
    auto usable = [&](std::size_t row) {
        return std::isfinite(chart.values[row]) && std::isfinite(chart.weights[row]) && chart.weights[row] > 0 &&
               (!chart.x.logarithmic || chart.values[row] > 0);
    };
    Range x;
    double total = 0;
    std::size_t const rows = std::min(chart.values.size(), chart.weights.size());
    for (std::size_t row = 0; row < rows; ++row)
        if (usable(row)) x.cover(chart.values[row]), total += chart.weights[row];
    if (!x.any() || !(total > 0)) return "";
    for (auto const& mark : chart.marks) x.cover(mark.value);
    if (chart.band) x.cover(chart.band->first), x.cover(chart.band->second);
    if (chart.x.logarithmic) {
        x.low /= 1.1, x.high *= 1.1;
    } else {
        double const wide = x.high - x.low, least = 1e-9 * std::abs(x.low);  // less is rounding
        double const pad = wide > least ? 0.03 * wide : std::max(0.05 * std::abs(x.low), 1e-9);
        x.low = x.low >= 0 && x.low < pad ? 0 : x.low - pad, x.high += pad;
    }
    Scale const across{x.low, x.high, left, width - right, chart.x.logarithmic};

    auto const bins = static_cast<std::size_t>(chart.bins);
    std::vector<double> share(bins);
    double const bar = (across.to - across.from) / chart.bins;
    for (std::size_t row = 0; row < rows; ++row) {
        if (!usable(row)) continue;
        auto const bin = static_cast<std::size_t>((across(chart.values[row]) - across.from) / bar);
        share[std::min(bin, bins - 1)] += 100 * chart.weights[row] / total;
    }
    double const tallest = *std::max_element(share.begin(), share.end());
    Scale const up{0, 1.08 * tallest, height - bottom, top};

    std::string out;
    std::vector<LegendEntry> entries;
    if (chart.band) {
        double const a = across(chart.band->first), b = across(chart.band->second);
        out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#f3e3c3\"/>", a,
                           top, std::max(1.0, b - a), height - bottom - top);
    }
    out += frame(across, up, chart.x.label, chart.y);
    for (std::size_t bin = 0; bin < bins; ++bin)
        if (share[bin] > 0)
            out += fmt::format(
                "<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"{:.1f}\" height=\"{:.2f}\" fill=\"#5b8db8\" "
                "stroke=\"#1f4e79\" "
                "stroke-width=\"0.7\"/>",
                across.from + bar * static_cast<double>(bin), up(share[bin]), bar, up(0) - up(share[bin]));
    constexpr std::array strokes{Stroke::solid, Stroke::dashed, Stroke::dotted};
    for (std::size_t m = 0; m < chart.marks.size(); ++m) {
        if (!std::isfinite(chart.marks[m].value)) continue;
        Stroke const stroke = strokes[m % strokes.size()];
        out += fmt::format(
            "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#a33\" stroke-width=\"2\"{3}/>",
            across(chart.marks[m].value), top, height - bottom, dashes(stroke));
        entries.push_back({chart.marks[m].label, "#a33", stroke});
    }
    return whole_svg(chart.x.label, out, entries);
}

std::string split_bar(std::vector<Share> const& shares)
{
    constexpr std::array colours{"#1f5f8b", "#e0a030", "#8a5a44", "#9aa5ad",
                                 "#5f8f4e", "#7a5c99", "#c06050", "#444444"};
    double total = 0;
    for (auto const& share : shares) total += std::max(0.0, share.value);
    if (!(total > 0)) return "";
    std::string bar = "<svg class=\"bar\" viewBox=\"0 0 1000 34\" preserveAspectRatio=\"none\" role=\"img\">";
    std::string names = "<ul class=\"key\">";
    double at = 0;
    for (std::size_t s = 0; s < shares.size(); ++s) {
        double const part = std::max(0.0, shares[s].value) / total;
        bar += fmt::format("<rect x=\"{:.2f}\" y=\"0\" width=\"{:.2f}\" height=\"34\" fill=\"{}\" stroke=\"#fff\"/>",
                           1000 * at, 1000 * part, colours[s % colours.size()]);
        names += fmt::format(
            "<li><svg viewBox=\"0 0 12 12\"><rect width=\"12\" height=\"12\" fill=\"{}\"/></svg>{} <b>{}%</b></li>",
            colours[s % colours.size()], escape(shares[s].label), number(100 * part, 3) + "\u202f");
        at += part;
    }
    return bar + "</svg>" + names + "</ul>";
}
}
