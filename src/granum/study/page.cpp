// The table and the page of a campaign.
#include "granum/report/page.hpp"
#include "granum/io/text_file.hpp"
#include "granum/map/lab.hpp"
#include "granum/report/chart.hpp"
#include "granum/report/html.hpp"
#include "granum/report/sections.hpp"
#include "granum/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <string_view>

namespace granum::study
{
namespace
{
using report::escape;
using report::number;

constexpr std::array colours{"#1b5e8c", "#c1440e", "#3a7d44", "#7a4f9a", "#8a6d00",
                             "#00707a", "#a02c5d", "#555555", "#b06a00"};

using map::Mean;
using map::mean_of;

struct Column
{
    char const *name, *unit, *title;
    Mean (*of)(Outcome const&);
};

Mean exactly(double value)
{
    return {value, 0};
}

template <double Outcome::*Member>
Mean member(Outcome const& one)
{
    return exactly(one.*Member);
}

constexpr std::array columns{
    Column{"window_from", "s", "window from", [](Outcome const& o) { return exactly(o.deposits.window.from); }},
    Column{"window_to", "s", "window to", [](Outcome const& o) { return exactly(o.deposits.window.to); }},
    Column{"log10_drying_time", "1", "log10 of the drying time in s",
           [](Outcome const& o) {
               return Mean{o.deposits.window.mean, o.deposits.window.error};
           }},
    Column{"moisture_at_impact", "kg/kg", "moisture at impact",
           [](Outcome const& o) { return mean_of(o.deposits.deposits, "moisture_at_impact"); }},
    Column{"drying_potential", "1", "local potential at impact",
           [](Outcome const& o) { return mean_of(o.deposits.deposits, "drying_potential"); }},
    Column{"coverage", "1", "coverage at impact",
           [](Outcome const& o) { return mean_of(o.deposits.deposits, "coverage"); }},
    Column{"eta", "1", "eta of the outlet", member<&Outcome::eta>},
    Column{"balance_eta", "1", "of the balance", member<&Outcome::balance_eta>},
    Column{"outlet_temperature", "K", "outlet temperature", member<&Outcome::outlet_temperature>},
    Column{"balance_temperature", "K", "of the balance", member<&Outcome::balance_temperature>},
    Column{"outlet_humidity", "kg/kg", "outlet humidity", member<&Outcome::outlet_humidity>},
    Column{"balance_humidity", "kg/kg", "of the balance", member<&Outcome::balance_humidity>},
    Column{"solids_error", "1", "solids ledger", member<&Outcome::solids_error>},
    Column{"water_error", "1", "water ledger", member<&Outcome::water_error>},
    Column{"wall_time", "s", "wall time", member<&Outcome::wall>},
};

constexpr std::size_t first_condition = 2, conditions_count = 4, of_apparatus = 6;  // among them

std::string csv(std::vector<Outcome> const& outcomes, std::vector<map::Prediction> const& predictions,
                std::vector<map::Shift> const& shifts)
{
    std::string names = "point", units = "1", body;
    for (auto const& column : columns) {
        names += fmt::format(",{0},{0}_error", column.name);
        units += fmt::format(",{0},{0}", column.unit);
    }
    if (!predictions.empty()) names += ",predicted,predicted_low,predicted_high,extrapolation", units += ",1,1,1,1";
    if (!shifts.empty()) names += ",shift,shift_error", units += ",1,1";
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
        body += outcomes[k].point.name;
        for (auto const& column : columns) {
            auto const mean = column.of(outcomes[k]);
            body += fmt::format(",{:.8g},{:.3g}", mean.value, mean.error);
        }
        if (!predictions.empty()) {
            auto const& p = predictions[k];
            body += fmt::format(",{:.8g},{:.8g},{:.8g},{:.4g}", p.mean, p.low, p.high, p.extrapolation);
        }
        if (!shifts.empty()) body += fmt::format(",{:.8g},{:.3g}", shifts[k].mean, shifts[k].deviation);
        body += "\n";
    }
    return names + "\n" + units + "\n" + body;
}

//! A line for each point, a column for each of `some`.
std::string table(std::vector<Outcome> const& outcomes, std::span<Column const> some)
{
    std::string out = "<table><tr><th></th>";
    for (auto const& column : some)
        out += fmt::format("<th class=\"num\">{}{}</th>", escape(column.title),
                           std::string_view(column.unit) == "1" ? "" : fmt::format(" ({})", column.unit));
    out += "</tr>\n";
    for (auto const& one : outcomes) {
        out += fmt::format("<tr><td class=\"name\">{}{}</td>", escape(one.point.name), one.enough ? "" : " (short)");
        for (auto const& column : some) {
            auto const mean = column.of(one);
            out += "<td class=\"num\">" + number(mean.value) + (mean.error > 0 ? " ± " + number(mean.error, 1) : "") +
                   "</td>";
        }
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

//! How far each point is from the reference, the nearest first: the property where there is a map, else the drying
//! time; and the conditions of the deposits; with the errors of the differences.
std::string ranked(std::vector<Outcome> const& outcomes, std::size_t reference, std::vector<map::Shift> const& shifts,
                   std::string const& property)
{
    auto const& to = outcomes[reference];
    auto const distance = [&](std::size_t k) {
        return std::abs(shifts.empty() ? outcomes[k].deposits.window.mean - to.deposits.window.mean : shifts[k].mean);
    };
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < outcomes.size(); ++k)
        if (k != reference) order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
    auto const conditions = std::span(columns).subspan(first_condition, conditions_count);
    std::string out = "<table><tr><th></th>";
    if (!shifts.empty()) out += fmt::format("<th class=\"num\">{}</th>", escape(property));
    for (auto const& column : conditions) out += fmt::format("<th class=\"num\">{}</th>", escape(column.title));
    out += "</tr>\n";
    for (std::size_t const k : order) {
        out += "<tr><td class=\"name\">" + escape(outcomes[k].point.name) + "</td>";
        if (!shifts.empty())
            out += fmt::format("<td class=\"num\">{} ± {}</td>", number(shifts[k].mean, 2),
                               number(shifts[k].deviation, 1));
        for (auto const& column : conditions) {
            auto const here = column.of(outcomes[k]), there = column.of(to);
            double const error = std::hypot(here.error, there.error);
            out += fmt::format("<td class=\"num\">{} ± {}</td>", number(here.value - there.value, 2), number(error, 1));
        }
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

//! Distributions of one variable, point beside point: share of the layer in 24 bins over all of them.
std::string distributions(std::vector<Outcome> const& outcomes, std::string const& name, bool logarithmic,
                          std::string const& label)
{
    auto const coordinate = [&](double value) { return logarithmic ? std::log10(value) : value; };
    // A thousandth of the layer at either end of each point may lie anywhere and is put into the last bins.
    double low = 1e300, high = -1e300;
    for (auto const& one : outcomes) {
        auto const& deposits = one.deposits.deposits;
        std::vector<std::pair<double, double>> sorted;
        double total = 0, below = 0;
        for (std::size_t row = 0; row < deposits.solids.size(); ++row)
            if (double const x = coordinate(deposits.of(name)[row]); std::isfinite(x))
                sorted.emplace_back(x, deposits.solids[row]), total += deposits.solids[row];
        std::sort(sorted.begin(), sorted.end());
        for (auto const& [x, solids] : sorted) {
            below += solids;
            if (below < 1e-3 * total || below > (1 - 1e-3) * total) continue;
            low = std::min(low, x), high = std::max(high, x);
        }
    }
    if (!(low < high)) return "";
    constexpr int bins = 24;
    report::CurveChart chart{.x = {label, logarithmic}, .y = {"share of the layer (%)"}};
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
        auto const& deposits = outcomes[k].deposits.deposits;
        auto const& values = deposits.of(name);
        std::array<double, bins> share{};
        double total = 0;
        for (std::size_t row = 0; row < values.size(); ++row) {
            double const x = coordinate(values[row]);
            if (!std::isfinite(x)) continue;
            share[static_cast<std::size_t>(std::clamp(bins * (x - low) / (high - low), 0.0, bins - 1.0))] +=
                deposits.solids[row];
            total += deposits.solids[row];
        }
        report::Curve curve{.label = outcomes[k].point.name,
                            .colour = colours[k % colours.size()],
                            .stroke = k < colours.size() ? report::Stroke::solid : report::Stroke::dashed};
        for (int b = 0; b < bins; ++b) {
            double const x = low + (b + 0.5) * (high - low) / bins;
            curve.x.push_back(logarithmic ? std::pow(10, x) : x);
            curve.y.push_back(100 * share[static_cast<std::size_t>(b)] / total);
        }
        chart.curves.push_back(std::move(curve));
    }
    return report::svg(chart);
}

std::string predicted(map::Map const& map, std::vector<Outcome> const& outcomes,
                      std::vector<map::Prediction> const& predictions)
{
    std::string out = fmt::format(
        "<table class=\"narrow\"><tr><th>point</th><th class=\"num\">{}</th><th class=\"num\">95 % interval</th>"
        "<th class=\"num\">extrapolation index</th></tr>\n",
        escape(map.property));
    for (std::size_t k = 0; k < outcomes.size(); ++k)
        out += fmt::format(
            "<tr><td>{}</td><td class=\"num\">{}</td><td class=\"num\">{} to {}</td><td "
            "class=\"num\">{:.2f}{}</td></tr>\n",
            escape(outcomes[k].point.name), number(predictions[k].mean), number(predictions[k].low),
            number(predictions[k].high), predictions[k].extrapolation,
            predictions[k].extrapolation > 0.3 ? " (beyond the lab)" : "");
    return out + "</table>\n";
}
}

void write(Study const& study, std::vector<Outcome> const& outcomes, std::string const& folder)
{
    namespace fs = std::filesystem;
    std::vector<map::Prediction> predictions;
    std::vector<map::Shift> shifts;
    std::string more, property;
    auto const found = std::find_if(outcomes.begin(), outcomes.end(),
                                    [&](auto const& one) { return one.point.name == study.reference; });
    auto const reference = static_cast<std::size_t>(found - outcomes.begin());
    if (!study.map.empty()) {
        auto const map = map::read_map(study.map);
        property = map.property;
        std::vector<std::pair<map::Features, double>> all;
        for (auto const& one : outcomes)
            all.emplace_back(map::features(map.known.axes, one.deposits.deposits), one.deposits.potential);
        for (auto const& one : all) {
            predictions.push_back(map::predict(map, {one}));
            if (found != outcomes.end())
                shifts.push_back(&one == &all[reference] ? map::Shift{} : map::shift(map, all[reference], one));
        }
        more = report::section("predicted", "Predicted " + map.property, predicted(map, outcomes, predictions));
    }
    if (found != outcomes.end() && outcomes.size() > 1)
        more += report::section(
            "ranked", "Away from " + study.reference,
            fmt::format("<p class=\"how\">The nearest first.{}</p>\n",
                        shifts.empty() ? "" : " What the map knows badly of both alike does not count.") +
                ranked(outcomes, reference, shifts, property));
    std::string const charts =
        report::figure(distributions(outcomes, "drying_time", true, "drying time (s)"),
                       "How long deposits took to dry.") +
        report::figure(distributions(outcomes, "moisture_at_impact", false, "water per solids at impact (kg/kg)"),
                       "How wet droplets landed.") +
        report::figure(distributions(outcomes, "drying_potential", false, "local drying potential at impact"),
                       "Where they landed.") +
        report::figure(distributions(outcomes, "granule_temperature", false, "granule temperature at impact (K)"),
                       "On what they landed.");
    std::string const body =
        fmt::format("<p class=\"brand\">GRANUM</p>\n<h1>{}</h1>\n<p class=\"how\">{} operating points.</p>\n",
                    escape(study.title), outcomes.size()) +
        more +
        report::section("points", "Operating points",
                        table(outcomes, std::span(columns).first(of_apparatus)) +
                            table(outcomes, std::span(columns).subspan(of_apparatus))) +
        report::section("distributions", "Conditions of the deposits", "<div class=\"charts\">" + charts + "</div>");
    io::replace_text((fs::path(folder) / "study.csv").string(), csv(outcomes, predictions, shifts));
    io::replace_text((fs::path(folder) / "study.html").string(),
                     report::whole_page(study.title + " – Granum study", body));
}
}
