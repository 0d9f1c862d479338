#include "granum/report/map_page.hpp"

#include "granum/io/text_file.hpp"
#include "granum/map/trend.hpp"
#include "granum/report/chart.hpp"
#include "granum/report/html.hpp"
#include "granum/report/page.hpp"
#include "granum/report/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace granum::report
{
namespace
{
constexpr std::array colours{"#1b5e8c", "#c1440e", "#3a7d44", "#7a4f9a", "#8a6d00", "#00707a", "#a02c5d", "#555555"};

std::string with_unit(std::string const& name, std::string const& unit)
{
    return unit == "1" ? name : fmt::format("{} ({})", name, unit);
}

std::string comparison_table(map::Map const& map)
{
    std::string out =
        "<table class=\"narrow\"><tr><th>model</th><th class=\"num\">missed by (rms)</th><th class=\"num\">R²</th><th "
        "class=\"num\">missed over expected</th></tr>\n";
    for (auto const& one : map.comparisons)
        out += fmt::format(
            "<tr{}><td>{}</td><td class=\"num\">{} ± {}</td><td class=\"num\">{:.2f}</td><td "
            "class=\"num\">{:.2f}</td></tr>\n",
            one.model == map.comparisons[map.chosen].model ? " class=\"sum\"" : "", escape(one.model),
            number(one.rms, 3), number(one.error, 1), one.r2, std::sqrt(one.chi2));
    return out + "</table>\n";
}

//! Left-out runs: predicted over measured, with the deviation of the difference.
std::string parity(map::Map const& map)
{
    auto const& one = map.comparisons[map.chosen];
    CurveChart chart{.x = {with_unit(map.property + ", measured", map.unit)},
                     .y = {with_unit(map.property + ", predicted without that run", map.unit)}};
    double low = std::numeric_limits<double>::infinity(), high = -low;
    Curve bars{.label = "runs, ± one deviation", .colour = colours[1]};
    for (std::size_t k = 0; k < map.runs.size(); ++k) {
        double const x = map.runs[k].value, y = one.predicted[k], s = one.deviation[k];
        low = std::min({low, x, y - s}), high = std::max({high, x, y + s});
        double const tick = 0.01 * std::abs(x), gap = std::nan("");
        bars.x.insert(bars.x.end(), {x, x, gap, x - tick, x + tick, gap});
        bars.y.insert(bars.y.end(), {y - s, y + s, gap, y, y, gap});
    }
    chart.curves.push_back({.label = "predicted = measured",
                            .x = {low, high},
                            .y = {low, high},
                            .colour = "#777777",
                            .stroke = Stroke::dashed});
    chart.curves.push_back(std::move(bars));
    return svg(chart);
}

map::Additive const* additive_of(map::Map const& map)
{
    for (auto const& model : map.models)
        if (auto const* found = std::get_if<map::Additive>(&model)) return found;
    return nullptr;
}

//! Mean of the second variable over the runs.
double middle_of_second(map::Map const& map)
{
    double sum = 0;
    for (auto const& run : map.runs) {
        auto const total = run.features.total();
        sum += total.first[1] / total.solids / static_cast<double>(map.runs.size());
    }
    return map.known.axes.axes[1].logarithmic ? std::pow(10, sum) : sum;
}

std::string element_chart(map::Map const& map, map::Additive const& model)
{
    auto const& axes = map.known.axes.axes;
    CurveChart chart{.x = {axes[0].variable, axes[0].logarithmic},
                     .y = {with_unit(map.property + " of a layer element", map.unit)}};
    Curve middle{.label = "most likely"}, low{.label = "± two deviations", .stroke = Stroke::dotted}, high = low;
    high.label = "";
    std::vector<double> values(axes.size());
    if (axes.size() > 1) values[1] = middle_of_second(map);
    for (int k = 0; k < axes[0].nodes; ++k) {
        values[0] = axes[0].node(k);
        auto const one = model.element(values);
        double const s = 2 * std::sqrt(std::max(0.0, one.variance));
        for (auto [curve, y] : {std::pair{&middle, one.mean}, {&low, one.mean - s}, {&high, one.mean + s}})
            curve->x.push_back(values[0]), curve->y.push_back(std::clamp(y, map.known.low, map.known.high));
    }
    chart.curves = {middle, low, high};
    return svg(chart);
}

//! Shares of each run's layer along an axis.
std::string support_chart(map::Map const& map, std::size_t a)
{
    auto const& axes = map.known.axes.axes;
    CurveChart chart{.x = {axes[a].variable, axes[a].logarithmic}, .y = {"share of the layer at a node (%)"}};
    for (std::size_t r = 0; r < map.runs.size(); ++r) {
        auto const shares = map::histogram(map.runs[r].features.total());
        Curve curve{.label = map.runs[r].name,
                    .colour = colours[r % colours.size()],
                    .stroke = r < colours.size() ? Stroke::solid : Stroke::dashed};
        for (int k = 0; k < axes[a].nodes; ++k) {
            double sum = 0;
            for (Eigen::Index node = 0; node < shares.size(); ++node) {
                auto const along = a == 0 ? node % axes[0].nodes : node / axes[0].nodes;
                if (along == k) sum += shares[node];
            }
            curve.x.push_back(axes[a].node(k)), curve.y.push_back(100 * sum);
        }
        chart.curves.push_back(std::move(curve));
    }
    return svg(chart);
}

std::string runs_table(map::Map const& map)
{
    std::string out = "<table><tr><th>run</th><th class=\"num\">measured</th><th class=\"num\">drying potential</th>";
    for (auto const& name : map::score_names(map.known.axes)) out += "<th class=\"num\">" + escape(name) + "</th>";
    out += "</tr>\n";
    for (auto const& run : map.runs) {
        out += fmt::format("<tr><td>{}</td><td class=\"num\">{} ± {}</td><td class=\"num\">{:.3f}</td>",
                           escape(run.name), number(run.value), number(run.error, 2), run.potential);
        for (double const score : map::scores(run.features.total()))
            out += "<td class=\"num\">" + number(score) + "</td>";
        out += "</tr>\n";
    }
    return out + "</table>\n";
}
}

void write_map_page(map::Map const& map, std::string const& title, std::string const& path)
{
    std::string body = fmt::format(
        "<p class=\"brand\">GRANUM</p>\n<h1>{}</h1>\n<p class=\"how\">Map of {} from {} runs; predicts with "
        "{}.</p>\n",
        escape(title.empty() ? "Property map" : title), escape(map.property), map.runs.size(),
        escape(map.comparisons[map.chosen].model));
    if (auto const found = map::trend(map))
        body += fmt::format("<p>The {} {}.</p>\n", escape(map.property), escape(found->words()));
    body += section("models", "How the models do on runs they were not given",
                    comparison_table(map) + "<div class=\"charts\">" +
                        figure(parity(map), "Each run predicted from the others.") + "</div>");
    if (auto const* additive = additive_of(map)) {
        std::string charts =
            figure(element_chart(map, *additive),
                   map.known.axes.axes.size() > 1
                       ? "What one deposit does, by the additive model, at the runs' mean of the other variable."
                       : "What one deposit does, by the additive model.");
        for (std::size_t a = 0; a < map.known.axes.axes.size(); ++a)
            charts += figure(support_chart(map, a),
                             "Where the lab has been: a pilot whose deposits lie elsewhere is extrapolated.");
        body += section("elements", "What a deposit does", "<div class=\"charts\">" + charts + "</div>");
    }
    body += section("runs", "Runs", runs_table(map));
    io::replace_text(path, whole_page(fmt::format("{} – Granum map", title.empty() ? map.property : title), body));
}
}
