#include "granum/study/projection.hpp"

#include "granum/base/error.hpp"
#include "granum/io/snapshot_file.hpp"
#include "granum/io/summary_file.hpp"
#include "granum/io/text_file.hpp"
#include "granum/law/layer/renewal.hpp"
#include "granum/math/constants.hpp"
#include "granum/population/balance.hpp"
#include "granum/report/chart.hpp"
#include "granum/report/html.hpp"
#include "granum/report/page.hpp"
#include "granum/report/sections.hpp"
#include "granum/sim/case_reader.hpp"
#include "granum/sim/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace granum::study
{
namespace
{
namespace fs = std::filesystem;
using report::number;

constexpr double limit = 0.98;  // of a porosity: an interval may reach beyond

double needed(nlohmann::json const& summary, std::string const& folder, char const* key)
{
    auto const found = io::number_at(summary, key);
    if (!found)
        throw base::IoError(
            fmt::format("{}/summary.json: does not tell {}; a projection needs a run with a spray", folder, key));
    return *found;
}

//! The cores in classes of a few micrometres: up to what the layer of a batch makes of them, with room for a spread; of
//! a bed that is fed and taken from, whose granules stay for very different times, up to ten times their size.
//! Agglomerates of a batch find room up to four diameters more.
population::Classes cores(sim::Case const& data, std::optional<double> layer_volume, double nuclei, bool join)
{
    double smallest = 1e9, largest = 0, volume = 0;
    for (auto const& batch : data.granules.batches) {
        smallest = std::min(smallest, batch.sizes.smallest()), largest = std::max(largest, batch.sizes.largest());
        volume += batch.mass / batch.density;
    }
    double const top = (layer_volume ? 1.3 * largest * std::cbrt(1 + 3 * *layer_volume / volume) : 10 * largest) *
                       (join && layer_volume ? 4 : 1);
    double const low = nuclei > 0 ? std::min(0.98 * smallest, 0.9 * nuclei) : 0.98 * smallest;
    auto out = population::Classes::even(low, top, join ? 1200 : layer_volume ? 800 : 3000);
    constexpr int draws = 2000;
    for (auto const& batch : data.granules.batches) {
        double const count = batch.mass / (batch.density * math::pi / 6 * batch.sizes.mean_cube());
        for (int k = 0; k < draws; ++k) out.add(batch.sizes.diameter((k + 0.5) / draws), count / draws);
    }
    return out;
}
}

Projection project(std::string const& folder, double hours, std::optional<Continuous> const& continuous,
                   Besides const& besides, int rows)
{
    Nuclei const& nuclei = besides.nuclei;
    auto const data = sim::read_case(sim::case_file_of(folder)).data;
    auto const summary = io::read_summary(folder);
    Projection out;
    out.porosity = needed(summary, folder, "product.porosity.mean");
    out.porosity_low = std::max(0.0, needed(summary, folder, "product.porosity.interval_low"));
    out.porosity_high = std::min(limit, needed(summary, folder, "product.porosity.interval_high"));
    out.moisture = needed(summary, folder, "product.residual_moisture");
    double const sprayed = needed(summary, folder, "spray.sprayed_kg");
    out.overspray =
        (needed(summary, folder, "spray.overspray_kg") + needed(summary, folder, "spray.on_walls_kg")) / sprayed;
    out.abraded = io::number_at(summary, "spray.abraded_kg").value_or(0) / sprayed;
    out.solids_rate = data.spray.rate * data.spray.solids_fraction;
    double const kept = out.solids_rate * (1 - out.overspray - out.abraded), end = 3600 * hours;
    double const simulated = needed(summary, folder, "run.simulated_s");
    out.agglomeration = besides.agglomeration;
    out.growth = size_growth(io::read_snapshot(folder + "/snapshots.h5").granules);
    double const variation = io::number_at(summary, "product.surface.variation_between").value_or(std::nan(""));
    double core_mass = 0;
    for (auto const& batch : data.granules.batches) core_mass += batch.mass;

    auto const rates_for = [&](double porosity, double held) {
        population::Rates rates{.layer = kept / (data.spray.solids_density * (1 - porosity))};
        if (nuclei.kept > 0) {
            double const volume =
                nuclei.kept * out.overspray * out.solids_rate / (data.spray.solids_density * (1 - porosity));
            rates.nuclei = out.nuclei_rate = volume / (math::pi / 6 * std::pow(nuclei.diameter, 3));
            rates.nuclei_diameter = nuclei.diameter;
        }
        if (out.growth.known && std::abs(out.growth.exponent) > 2 * out.growth.error)
            rates.growth = [p = out.growth.exponent, d0 = data.granules.diameter](double d) {
                return std::pow(d / d0, p);
            };
        if (!continuous) return rates;
        double const each = math::pi / 6 * std::pow(data.granules.diameter, 3) * data.granules.density;
        rates.feed = continuous->feed / each, rates.feed_diameter = data.granules.diameter;
        rates.discharge = [c = *continuous](double d) { return 1 / (1 + std::pow(c.diameter / d, c.sharpness)); };
        rates.hold_up = held;
        return rates;
    };
    double const porosities[] = {out.porosity, out.porosity_low, out.porosity_high};
    std::vector<population::Classes> states;
    std::vector<population::Rates> rates;
    for (double const porosity : porosities) {
        auto const layer = kept * end / (data.spray.solids_density * (1 - porosity));
        states.push_back(
            cores(data, continuous ? std::nullopt : std::optional(layer), nuclei.diameter, besides.agglomeration > 0));
        rates.push_back(rates_for(porosity, states.back().total_volume()));
        // Unions per second of N granules are half the rate of a pair times N squared.
        if (besides.agglomeration > 0)
            rates.back().agglomeration = [rate = 2 * besides.agglomeration / states.back().total()](double, double) {
                return rate;
            };
    }
    double const start = states[0].mean_diameter(), density = data.spray.solids_density * (1 - out.porosity);
    for (int row = 0; row < rows; ++row) {
        double const time = end * row / (rows - 1), step = row == 0 ? 0 : end / (rows - 1);
        double discharged = 0;
        for (std::size_t k = 0; k < states.size(); ++k) {
            if (step == 0) continue;
            auto const passed = population::advance(states[k], rates[k], step);
            if (k == 0) discharged = passed.discharged / step;
        }
        auto const& own = states[0];
        Projected one{.time = time};
        one.d10 = own.percentile(0.1), one.d50 = own.percentile(0.5), one.d90 = own.percentile(0.9);
        // A denser layer makes smaller granules.
        one.d50_low = states[1].percentile(0.5), one.d50_high = states[2].percentile(0.5);
        if (!continuous) {
            one.layer = besides.agglomeration > 0 ? std::nan("") : 0.5 * (own.mean_diameter() - start);
            one.mass = core_mass + (kept + nuclei.kept * out.overspray * out.solids_rate) * time;
            one.variation = time > simulated ? law::layer::later_variation(variation, simulated, time) : variation;
        } else {
            double const mean_density = data.granules.density;
            one.mass = own.total_volume() * std::min(mean_density, density);
            one.discharged = discharged * std::min(mean_density, density);
        }
        out.rows.push_back(one);
    }
    return out;
}

namespace
{
std::string growth_words(SizeGrowth const& growth)
{
    if (!growth.known) return "The size of a granule does not matter for its growth: the run's are too alike to tell.";
    auto const found =
        fmt::format("layer per surface goes with the {:.2f} +- {:.2f}th power of the diameter in the run",
                    growth.exponent, growth.error);
    return std::abs(growth.exponent) > 2 * growth.error
               ? "Granules grow by their size: " + found + "."
               : "The size of a granule does not matter for its growth: " + found + ".";
}
}

void write(Projection const& p, std::string const& folder)
{
    std::string csv = "time,d10,d50,d90,d50_low,d50_high,layer,mass,discharged,variation\ns,m,m,m,m,m,m,kg,kg/s,1\n";
    report::CurveChart sizes{.x = {"time (min)"}, .y = {"diameter (um)"}},
        layers{.x = {"time (min)"}, .y = {"mean layer (um)"}},
        spreads{.x = {"time (min)"}, .y = {"variation of layer mass among granules"}};
    report::Curve d10{.label = "d10", .colour = "#3a7d44"}, d50{.label = "d50"},
        d90{.label = "d90", .colour = "#c1440e"},
        low{.label = "d50 with the porosity's interval", .stroke = report::Stroke::dotted},
        high{.label = "", .stroke = report::Stroke::dotted}, layer{.label = "layer"}, spread{.label = "variation"};
    for (auto const& r : p.rows) {
        csv += fmt::format("{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.6g}\n", r.time, r.d10,
                           r.d50, r.d90, r.d50_low, r.d50_high, r.layer, r.mass, r.discharged, r.variation);
        double const t = r.time / 60;
        for (auto [curve, y] : {std::pair{&d10, 1e6 * r.d10},
                                {&d50, 1e6 * r.d50},
                                {&d90, 1e6 * r.d90},
                                {&low, 1e6 * r.d50_low},
                                {&high, 1e6 * r.d50_high},
                                {&layer, 1e6 * r.layer},
                                {&spread, r.variation}})
            curve->x.push_back(t), curve->y.push_back(y);
    }
    sizes.curves = {d10, d50, d90, low, high}, layers.curves = {layer};
    spread.x.erase(spread.x.begin()), spread.y.erase(spread.y.begin());
    spreads.curves = {spread};
    auto const& end = p.rows.back();
    bool const batch = end.discharged == 0;
    std::string body = fmt::format(
        "<p class=\"brand\">GRANUM</p>\n<h1>Projected to {:.3g} h</h1>\n<p class=\"statement\">d10 {} um, d50 {} um "
        "({} to {} um), d90 {} "
        "um; residual moisture {} kg/kg.</p>\n<p>The run's layer porosity of {:.3f} (95 % interval {:.3f} to {:.3f}), "
        "its overspray of {:.2f} % "
        "and its air stay as they are. {}{}{}{} The spread of the layer's mass falls with the root of time, as in a "
        "well-mixed "
        "bed.</p>\n",
        end.time / 3600, number(1e6 * end.d10), number(1e6 * end.d50), number(1e6 * end.d50_low),
        number(1e6 * end.d50_high), number(1e6 * end.d90), number(p.moisture, 2), p.porosity, p.porosity_low,
        p.porosity_high, 100 * p.overspray, growth_words(p.growth),
        p.nuclei_rate > 0 ? fmt::format(" {} new granules per second come from dust.", number(p.nuclei_rate, 3)) : "",
        p.abraded > 0
            ? fmt::format(" {:.2f} % is rubbed off again, as in the run; thicker layers lose more.", 100 * p.abraded)
            : "",
        p.agglomeration > 0
            ? fmt::format(" Any pair of granules joins as often as any other, {} % of them in the first "
                          "hour if all were as at the start.",
                          number(3.6e5 * p.agglomeration, 3))
            : "");
    std::string charts = report::figure(report::svg(sizes), "Size of the granules in the bed, by volume.");
    if (batch) {
        if (p.agglomeration == 0) charts += report::figure(report::svg(layers), "Mean thickness of the layer.");
        charts += report::figure(report::svg(spreads),
                                 "How unlike the granules' layers are: the run's own value, then falling as t^-1/2.");
    }
    body += report::section("curves", "Against time", "<div class=\"charts\">" + charts + "</div>");
    io::replace_text((fs::path(folder) / "project.csv").string(), csv);
    io::replace_text((fs::path(folder) / "project.html").string(), report::whole_page("Projection – Granum", body));
}
}
