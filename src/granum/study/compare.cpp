#include "granum/study/compare.hpp"

#include "granum/base/error.hpp"
#include "granum/io/logged.hpp"
#include "granum/io/summary_file.hpp"
#include "granum/io/text_file.hpp"
#include "granum/math/constants.hpp"
#include "granum/math/steady.hpp"
#include "granum/report/chart.hpp"
#include "granum/report/html.hpp"
#include "granum/report/page.hpp"
#include "granum/report/sections.hpp"
#include "granum/sim/balance.hpp"
#include "granum/sim/case_reader.hpp"
#include "granum/sim/continuation.hpp"
#include "granum/study/offset_causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace granum::study
{
namespace
{
namespace fs = std::filesystem;
using io::Dimension;

//! A quantity that plants log, as a person reads it.
struct Logged
{
    char const* column;  //!< of timeseries.csv
    Dimension dimension;
    char const* label;
    char const* unit;
    double factor, zero;  //!< shown = factor * (SI - zero)
    double tolerance;     //!< SI: what good instruments differ by; and at least this share of the plant's mean:
    double share = 0.03;
};
constexpr std::array<Logged, 8> quantities{
    {{"inlet_temperature", Dimension::temperature, "inlet temperature", "°C", 1, math::zero_celsius, 1, 0},
     {"outlet_temperature", Dimension::temperature, "outlet temperature", "°C", 1, math::zero_celsius, 1, 0},
     {"bed_temperature", Dimension::temperature, "bed temperature", "°C", 1, math::zero_celsius, 1, 0},
     {"outlet_humidity", Dimension::one, "outlet humidity", "g/kg", 1000, 0, 3e-4},
     {"pressure_drop", Dimension::pressure, "bed pressure drop", "Pa", 1, 0, 10},
     {"spray_rate", Dimension::mass_flow, "spray rate", "g/min", 6e4, 0, 0},
     {"bed_moisture", Dimension::one, "moisture of the bed", "g/kg", 1000, 0, 1e-3},
     {"bed_height", Dimension::length, "bed height", "mm", 1000, 0, 2e-3, 0.05}}};

//! Words of the trade for the same.
constexpr std::array<std::pair<char const*, char const*>, 12> words{{{"inlet_air_temperature", "inlet_temperature"},
                                                                     {"supply_air_temperature", "inlet_temperature"},
                                                                     {"exhaust_temperature", "outlet_temperature"},
                                                                     {"exhaust_air_temperature", "outlet_temperature"},
                                                                     {"outlet_air_temperature", "outlet_temperature"},
                                                                     {"product_temperature", "bed_temperature"},
                                                                     {"exhaust_humidity", "outlet_humidity"},
                                                                     {"exhaust_air_humidity", "outlet_humidity"},
                                                                     {"outlet_air_humidity", "outlet_humidity"},
                                                                     {"bed_pressure_drop", "pressure_drop"},
                                                                     {"product_moisture", "bed_moisture"},
                                                                     {"spraying_rate", "spray_rate"}}};

Logged const& logged(std::string_view column)
{
    return *std::find_if(quantities.begin(), quantities.end(), [&](auto const& q) { return column == q.column; });
}

io::Series read_plant(std::string const& path, std::vector<std::string>& left)
{
    std::map<std::string, Dimension> known{{"time", Dimension::time}};
    for (auto const& q : quantities) known[q.column] = q.dimension;
    for (auto const& [word, column] : words) known[word] = logged(column).dimension;
    auto out = io::read_logged(path, known, left);
    for (auto& column : out.columns)
        for (auto const& [word, name] : words)
            if (column.name == word) column.name = name;
    return out;
}

//! The curve at `x`, straight between its points; NaN beyond its ends.
double at(std::vector<double> const& time, std::vector<double> const& values, double x)
{
    auto const after = std::lower_bound(time.begin(), time.end(), x);
    if (after == time.end()) return std::numeric_limits<double>::quiet_NaN();
    auto const k = static_cast<std::size_t>(after - time.begin());
    if (*after == x) return values[k];
    if (k == 0) return std::numeric_limits<double>::quiet_NaN();
    double const part = (x - time[k - 1]) / (time[k] - time[k - 1]);
    return (1 - part) * values[k - 1] + part * values[k];
}

//! Rows of the plant with a value, from the run's zero of time.
void take_plant(Compared& one, std::vector<double> const& time, std::vector<double> const& values, double shift,
                std::string const& path)
{
    for (std::size_t k = 0; k < time.size(); ++k) {
        if (!std::isfinite(time[k]) || !std::isfinite(values[k])) continue;
        if (!one.plant_time.empty() && time[k] - shift <= one.plant_time.back())
            throw base::CaseError({{path, 0, "time", fmt::format("does not rise at {:.6g} s", time[k]), {}}});
        one.plant_time.push_back(time[k] - shift), one.plant.push_back(values[k]);
    }
}

void judge(Compared& one)
{
    auto const& what = logged(one.name);
    std::vector<double> ours, plants, differences;
    for (std::size_t k = 0; k < one.time.size(); ++k) {
        double const plant = at(one.plant_time, one.plant, one.time[k]);
        if (!std::isfinite(plant) || !std::isfinite(one.ours[k])) continue;
        ours.push_back(one.ours[k]), plants.push_back(plant), differences.push_back(one.ours[k] - plant);
    }
    if (differences.empty()) return;
    double squares = 0;
    for (double const d : differences) squares += d * d;
    one.deviation = std::sqrt(squares / static_cast<double>(differences.size()));
    auto const steady = math::steady_part(differences);
    auto const mean_from = [&](std::vector<double> const& values) {
        double sum = 0;
        for (std::size_t k = steady.start; k < values.size(); ++k) sum += values[k];
        return sum / static_cast<double>(values.size() - steady.start);
    };
    one.mean = mean_from(ours), one.plant_mean = mean_from(plants);
    one.offset = steady.mean, one.error = steady.error, one.settled = steady.settled;
    one.tolerance = std::max(what.tolerance, what.share * std::abs(one.plant_mean));
    one.agrees = std::abs(one.offset) <= std::max(one.tolerance, 2 * one.error);
}

std::vector<std::string> causes_of(Comparison const& comparison, std::string const& folder)
{
    auto const data = sim::read_case(sim::case_file_of(folder)).data;
    auto const summary = io::read_summary(folder);
    RunState run;
    if (data.gas.present && !data.gas.inlets.empty()) run.dry_flow = sim::balance(data).dry_mass_flow;
    double const weight = io::number_at(summary, "bed.weight_over_area_Pa").value_or(0);
    if (weight > 0) run.area = data.granules.mass * 9.81 / weight;
    double const sprayed = io::number_at(summary, "water.sprayed_last_two_thirds_kg").value_or(0);
    double const evaporated = io::number_at(summary, "water.evaporated_last_two_thirds_kg").value_or(0);
    run.water_accumulates = evaporated < 0.97 * sprayed;
    run.temperature = io::number_at(summary, "result.outlet_temperature_K").value_or(0);
    run.humidity = io::number_at(summary, "result.outlet_humidity").value_or(0);
    Offsets offsets;
    auto const take = [&](char const* name, std::optional<double>& into) {
        for (auto const& one : comparison.quantities)
            if (one.name == name && !one.agrees) into = one.offset;
    };
    take("inlet_temperature", offsets.inlet_temperature), take("spray_rate", offsets.spray_rate);
    take("outlet_temperature", offsets.outlet_temperature), take("outlet_humidity", offsets.outlet_humidity);
    take("bed_temperature", offsets.bed_temperature), take("pressure_drop", offsets.pressure_drop);
    take("bed_moisture", offsets.bed_moisture);
    return likely_causes(offsets, run);
}
}

std::string Comparison::not_read() const
{
    std::string out;
    for (auto const& name : left) out += (out.empty() ? "" : ", ") + name;
    return out;
}

std::string shown(std::string const& name, double value, bool difference)
{
    auto const& what = logged(name);
    std::string const unit = difference && std::string_view(what.unit) == "°C" ? "K" : what.unit;
    return report::quantity(what.factor * (difference ? value : value - what.zero), unit, difference ? 2 : 4);
}

Comparison compare(std::string const& folder, std::string const& plant, double shift)
{
    if (!fs::is_directory(folder)) throw base::CaseError({{folder, 0, "", "there is no such run folder", {}}});
    if (!fs::exists(plant)) throw base::CaseError({{plant, 0, "", "there is no such file", {}}});
    Comparison out{.folder = folder, .plant = plant, .quantities = {}, .causes = {}, .left = {}};
    auto const ours = io::read_series(folder + "/timeseries.csv");
    auto const theirs = read_plant(plant, out.left);
    auto const* const plant_time = theirs.find("time");
    auto const* const time = ours.find("time");
    if (!plant_time) throw base::CaseError({{plant, 0, "time", "is no column of the first row", {"e.g. time [min]"}}});
    if (!time || time->empty()) throw base::IoError(fmt::format("{}/timeseries.csv: holds no time", folder));
    std::string known;
    for (auto const& q : quantities) {
        known += (known.empty() ? "" : ", ") + std::string(q.column);
        auto const* const values = theirs.find(q.column);
        auto const* const own = ours.find(q.column);
        if (!values || !own) continue;
        Compared one{.name = q.column, .time = *time, .ours = *own, .plant_time = {}, .plant = {}};
        take_plant(one, *plant_time, *values, shift, plant);
        if (!one.plant.empty()) out.quantities.push_back(std::move(one));
    }
    if (out.quantities.empty())
        throw base::CaseError({{plant, 0, "", "shares no quantity with the run", {"known: " + known}}});
    out.from = time->back(), out.to = time->front();
    for (auto const& one : out.quantities) {
        out.from = std::min(out.from, std::max(time->front(), one.plant_time.front()));
        out.to = std::max(out.to, std::min(time->back(), one.plant_time.back()));
    }
    if (!(out.from < out.to))
        throw base::CaseError({{plant,
                                0,
                                "time",
                                fmt::format("{:.4g} to {:.4g} s does not meet the run's {:.4g} to {:.4g} s",
                                            out.quantities.front().plant_time.front(),
                                            out.quantities.front().plant_time.back(), time->front(), time->back()),
                                {"--shift TIME says when in the log the run begins, e.g. --shift \"20 min\""}}});
    for (auto& one : out.quantities) judge(one);
    out.causes = causes_of(out, folder);
    return out;
}

void write(Comparison const& c)
{
    std::string csv = "quantity,run,plant,offset,error,deviation,tolerance,agrees\n";
    std::string table =
        "<table><thead><tr><th>quantity</th><th>run</th><th>plant</th><th>offset</th><th>tolerance</th>"
        "<th>root mean square</th><th></th></tr></thead><tbody>";
    std::string charts;
    bool agree = true;
    for (auto const& one : c.quantities) {
        auto const& what = logged(one.name);
        csv += fmt::format("{},{:.8g},{:.8g},{:.8g},{:.3g},{:.4g},{:.4g},{}\n", one.name, one.mean, one.plant_mean,
                           one.offset, one.error, one.deviation, one.tolerance, one.agrees ? 1 : 0);
        agree = agree && one.agrees;
        table +=
            fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{} ± {}</td><td>{}</td><td>{}</td><td>{}{}</td></tr>",
                        what.label, shown(one.name, one.mean), shown(one.name, one.plant_mean),
                        shown(one.name, one.offset, true), shown(one.name, one.error, true),
                        shown(one.name, one.tolerance, true), shown(one.name, one.deviation, true),
                        one.agrees ? "agrees" : "<b>differs</b>", one.settled ? "" : ", not yet steady");
        report::CurveChart chart{.x = {"time of the run (s)"}, .y = {fmt::format("{} ({})", what.label, what.unit)}};
        report::Curve run{.label = "run", .x = one.time}, plant{.label = "plant", .colour = "#c0582b"};
        plant.stroke = report::Stroke::dashed;
        for (double const v : one.ours) run.y.push_back(what.factor * (v - what.zero));
        for (std::size_t k = 0; k < one.plant.size(); ++k) {
            // As much of the plant before and after as helps to see where it comes from.
            double const margin = 0.1 * (one.time.back() - one.time.front());
            if (one.plant_time[k] < one.time.front() - margin || one.plant_time[k] > one.time.back() + margin) continue;
            plant.x.push_back(one.plant_time[k]), plant.y.push_back(what.factor * (one.plant[k] - what.zero));
        }
        chart.curves = {run, plant};
        charts += report::figure(report::svg(chart), "");
    }
    std::string body = fmt::format(
        "<p class=\"brand\">GRANUM</p>\n<h1>The run beside the plant</h1>\n<p class=\"statement\">{}</p>\n<p>{} and "
        "{}, "
        "{:.4g} to {:.4g} s of the run. Offsets are means over the steady part of the difference, run less plant, with "
        "their standard error.</p>\n",
        agree ? "All that was logged agrees." : "Not all that was logged agrees.", report::escape(c.folder),
        report::escape(c.plant), c.from, c.to);
    body += report::section("offsets", "Offsets", table + "</tbody></table>");
    if (!c.causes.empty()) {
        std::string list = "<ul>";
        for (auto const& cause : c.causes) list += "<li>" + report::escape(cause) + "</li>";
        body += report::section("causes", "What is likely behind them", list + "</ul>");
    }
    body += report::section("curves", "Against time", "<div class=\"charts\">" + charts + "</div>");
    if (!c.left.empty()) body += fmt::format("<p>Not read: {}.</p>", report::escape(c.not_read()));
    io::replace_text((fs::path(c.folder) / "compare.csv").string(), csv);
    io::replace_text((fs::path(c.folder) / "compare.html").string(),
                     report::whole_page("Beside the plant – Granum", body));
}
}
