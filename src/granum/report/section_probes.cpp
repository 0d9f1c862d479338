// What the probes of the case saw: points over time, lines as means along their length.
#include "granum/io/csv.hpp"
#include "granum/math/constants.hpp"
#include "granum/report/chart.hpp"
#include "granum/report/html.hpp"
#include "granum/report/sections.hpp"

#include <fmt/format.h>

#include <cmath>

namespace granum::report
{
namespace
{
struct Shown
{
    char const* column;
    char const* label;
    double factor = 1, offset = 0;
};
constexpr std::array<Shown, 4> shown{{{"velocity_z", "upward velocity of the gas (m/s)"},
                                      {"temperature", "temperature of the gas (°C)", 1, -math::zero_celsius},
                                      {"humidity", "humidity of the gas (g/kg)", 1000},
                                      {"voidage", "voidage"}}};
constexpr std::array colours{"#1b5e8c", "#c0582b", "#3d7a3a", "#7a4a8c", "#8a6d1b", "#555555"};
constexpr std::array strokes{Stroke::solid, Stroke::dashed, Stroke::dotted};

//! Curves that can be told apart without colour.
void add(CurveChart& chart, std::string const& label, std::vector<double> x, std::vector<double> y, Shown const& what)
{
    for (double& value : y) value = what.factor * value + what.offset;
    std::size_t const k = chart.curves.size();
    chart.curves.push_back(
        {label, std::move(x), std::move(y), colours[k % colours.size()], strokes[k % strokes.size()]});
}

std::vector<double> numbers(nlohmann::json const& list)
{
    std::vector<double> out;
    for (auto const& one : list) out.push_back(one.is_number() ? one.get<double>() : std::nan(""));
    return out;
}

//! Distance of each point from the first, mm.
std::vector<double> along(nlohmann::json const& positions)
{
    std::vector<double> out;
    auto const first = numbers(positions.at(0));
    for (auto const& one : positions) {
        auto const x = numbers(one);
        out.push_back(1000 * std::hypot(x[0] - first[0], x[1] - first[1], x[2] - first[2]));
    }
    return out;
}
}

std::string probes_section(RunFolder const& run)
{
    auto const& probes = run.at("probes");
    if (!probes.is_array() || probes.empty()) return "";
    io::Series series;
    try {
        series = io::read_series(run.path + "/probes.csv");
    } catch (std::exception const&) {
        // What the summary has is shown below.
    }
    std::string points, lines;
    for (auto const& what : shown) {
        CurveChart over_time{.x = {"simulated time (s)"}, .y = {what.label}, .curves = {}, .levels = {}};
        CurveChart profile{.x = {"distance along the line (mm)"}, .y = {what.label}, .curves = {}, .levels = {}};
        for (auto const& probe : probes) {
            auto const name = probe.value("name", std::string());
            if (probe.at("position_m").size() > 1) {
                add(profile, name, along(probe.at("position_m")), numbers(probe.at(what.column).at("mean")), what);
            } else if (auto const* column = series.find(name + "_" + what.column)) {
                add(over_time, name, *series.find("time"), *column, what);
            }
        }
        if (!over_time.curves.empty()) points += figure(svg(over_time), "At the points of the probes.");
        if (!profile.curves.empty())
            lines += figure(svg(profile), "Along the lines of the probes: means over the last third of the run.");
    }
    return section("probes", "Probes", "<div class=\"charts\">" + points + lines + "</div>");
}
}
