// What happened over time, how the deposits dried, and the product that follows.
#include "granum/math/constants.hpp"
#include "granum/product/aggregate.hpp"
#include "granum/report/chart.hpp"
#include "granum/report/html.hpp"
#include "granum/report/sections.hpp"

#include <fmt/format.h>

#include <cmath>

namespace granum::report
{
namespace
{
struct Convert
{
    double factor = 1, offset = 0;
    double operator()(double value) const { return factor * value + offset; }
};
constexpr Convert same{}, to_celsius{1, -math::zero_celsius}, to_thousandth{1000, 0}, to_percent{100, 0};

std::vector<double> converted(std::vector<double> values, Convert const& convert)
{
    for (auto& value : values) value = convert(value);
    return values;
}

//! One curve of the time series with a level from the summary.
struct CurveSpec
{
    char const* label;
    std::vector<char const*> names;  //!< columns drawn, the first as the main one
    std::vector<char const*> legends;
    Convert convert;
    char const* level;  //!< dotted key of the reference; "" for none
    char const* level_legend;
    char const* unit;
    char const* caption;
};

std::vector<CurveSpec> const& curve_specs()
{
    static std::vector<CurveSpec> const all{
        {"bed temperature (°C)",
         {"bed_temperature"},
         {"simulated"},
         to_celsius,
         "balance.outlet_temperature_K",
         "air leaving, by the balance",
         "°C",
         "Mean temperature of the granules; in a well-mixed bed it settles near the temperature of the leaving air."},
        {"outlet temperature (°C)",
         {"outlet_temperature"},
         {"simulated"},
         to_celsius,
         "balance.outlet_temperature_K",
         "balance",
         "°C",
         "Temperature of the leaving air; a steady process holds the balance's value."},
        {"outlet humidity (g/kg)",
         {"outlet_humidity"},
         {"simulated"},
         to_thousandth,
         "balance.outlet_humidity",
         "balance",
         "g/kg",
         "Water in the leaving air per dry air; below the dashed line water gathers in the bed."},
        {"drying potential η",
         {"drying_potential"},
         {"of the apparatus"},
         same,
         "balance.eta",
         "balance",
         "",
         "What is left of the air's capacity to dry: 1 at the inlet, 0 when saturated."},
        {"bed pressure drop (Pa)",
         {"pressure_drop"},
         {"simulated"},
         same,
         "bed.weight_over_area_Pa",
         "weight over area",
         "Pa",
         "Pressure lost in the bed; swings come from bubbles, the mean carries the weight of a fluidised bed."},
        {"water (g)",
         {"sprayed_water", "evaporated_water"},
         {"sprayed", "evaporated"},
         to_thousandth,
         "",
         "",
         "g",
         "Water sprayed and evaporated since the start; parallel lines mean a steady process."},
        {"water on granules (g/kg)",
         {"bed_moisture"},
         {"simulated"},
         to_thousandth,
         "",
         "",
         "g/kg",
         "Liquid water in open deposits per dry mass of the bed; it levels off when drying keeps up with the spray."},
        {"bed height (mm)",
         {"bed_height"},
         {"simulated"},
         to_thousandth,
         "",
         "",
         "mm",
         "Height of the bed; it swings with the bubbles that break through."},
    };
    return all;
}

//! What there is to see where granules are alone.
std::vector<CurveSpec> const& packing_specs()
{
    static std::vector<CurveSpec> const all{
        {"energy of motion (J)",
         {"kinetic_energy", "rotation_energy"},
         {"translation", "rotation"},
         same,
         "",
         "",
         "J",
         "Kinetic energy of all granules; it falls to nothing where they come to rest."},
        {"energy (J)",
         {"potential_energy", "dissipated_energy"},
         {"potential", "dissipated"},
         same,
         "",
         "",
         "J",
         "What gravity gives ends as loss in contacts."},
        {"coordination number",
         {"coordination_number"},
         {"mean"},
         same,
         "",
         "",
         "",
         "How many other granules a granule touches, on the mean."},
        {"overlap (% of a radius)",
         {"overlap_p99", "overlap_mean"},
         {"99 % are below", "mean"},
         to_percent,
         "packing.overlap.criterion",
         "usual criterion",
         "%",
         "How deeply contacts overlap; a larger contact.youngs_modulus makes them stiffer and the step shorter."},
        {"force on the walls (N)",
         {"wall_force_z", "wall_force_x"},
         {"upward", "along x"},
         same,
         "",
         "",
         "N",
         "Sum of the forces of the granules on all walls; at rest minus their weight."},
        {"mass (g)",
         {"discharged_mass", "fed_mass"},
         {"discharged", "fed"},
         to_thousandth,
         "",
         "",
         "g",
         "What came in and what left since the start."},
    };
    return all;
}

std::string curve(RunFolder const& run, CurveSpec const& spec)
{
    constexpr std::array colours{"#1b5e8c", "#c0582b"};
    constexpr std::array strokes{Stroke::solid, Stroke::dotted};
    auto const* time = run.column({"time"});
    CurveChart chart{.x = {"simulated time (s)"}, .y = {spec.label}};
    for (std::size_t c = 0; time && c < spec.names.size(); ++c)
        if (auto const* column = run.column({spec.names[c]}))
            chart.curves.push_back(
                {spec.legends[c], *time, converted(*column, spec.convert), colours[c % 2], strokes[c % 2]});
    if (auto const level = *spec.level ? run.value(spec.level) : std::nullopt)
        chart.levels.push_back({fmt::format("{} {}", spec.level_legend, quantity(spec.convert(*level), spec.unit, 4)),
                                spec.convert(*level)});
    return figure(svg(chart), spec.caption);
}

//! Values of the events that count, with their solids as weights.
struct Weighted
{
    std::vector<double> values, weights;

    bool usable() const
    {
        double total = 0;
        for (double const weight : weights) total += weight;
        return !values.empty() && values.size() == weights.size() && total > 0 && std::isfinite(total);
    }
};

//! A chart of `data`, which must outlive it.
HistogramChart chart_of(Weighted const& data, std::string const& x,
                        std::string const& y = "share of the dried solids (%)")
{
    HistogramChart chart;
    chart.x.label = x;
    chart.y = y;
    chart.values = data.values;
    chart.weights = data.weights;
    return chart;
}

Weighted events_of(RunFolder const& run, char const* name, Convert const& convert = same)
{
    auto const rows = run.event_rows();
    auto const values = run.event_values(name, rows), solids = run.event_values("solids", rows);
    Weighted out;
    for (std::size_t row = 0; row < std::min(values.size(), solids.size()); ++row) {
        if (!std::isfinite(values[row]) || !(solids[row] > 0)) continue;
        out.values.push_back(convert(values[row]));
        out.weights.push_back(solids[row]);
    }
    return out;
}

std::string histogram(Weighted const& data, Axis const& axis, std::string const& unit, std::string const& caption)
{
    if (!data.usable()) return figure("", caption);
    auto const p = product::percentiles(data.values, data.weights);
    HistogramChart chart = chart_of(data, axis.label);
    chart.x.logarithmic = axis.logarithmic && p.p10 > 0 && p.p90 / p.p10 > 4;
    chart.marks = {{"median " + quantity(p.p50, unit, 3), p.p50}};
    return figure(svg(chart), fmt::format("{} From 10 to 90 % of the solids: {} to {}.", caption,
                                          quantity(p.p10, unit, 3), quantity(p.p90, unit, 3)));
}
}

std::string curves_section(RunFolder const& run)
{
    std::string out = "<div class=\"charts\">";
    for (auto const& spec : run.granules_alone() ? packing_specs() : curve_specs()) out += curve(run, spec);
    return section("curves", "The process over time", out + "</div>");
}

std::string events_section(RunFolder const& run)
{
    auto const rows = run.event_rows();
    if (rows.empty())
        return section("events", "How the deposits dried",
                       "<p class=\"empty\"><b>No events yet.</b> An event is written when a deposit has dried.</p>");
    std::string out =
        fmt::format("<p>{} dried deposits, each weighted with its solids{}.</p><div class=\"charts\">",
                    whole(static_cast<double>(rows.size())),
                    rows.size() < run.events.rows() ? ", without those that the start placed on the granules" : "");
    out += histogram(
        events_of(run, "drying_time"), {"drying time (s)", true}, "s",
        "Time from impact until the deposit is dry; a long tail means deposits that dry in humid, cold or still gas.");
    out += histogram(events_of(run, "drying_potential"), {"local drying potential at impact"}, "",
                     "Drying potential of the gas around the granule at impact; its spread is what a model of the "
                     "whole apparatus cannot see.");
    out += histogram(events_of(run, "mean_drying_potential"), {"local drying potential, mean while drying"}, "",
                     "The same, averaged over the time each deposit took to dry: what the porosity model is given.");
    out +=
        histogram(events_of(run, "moisture_at_impact"), {"water per solids at impact (kg/kg)"}, "kg/kg",
                  "State of the droplets when they hit; less water than in the feed means that they dried in flight.");
    out += histogram(events_of(run, "droplet_diameter", {1e6, 0}), {"droplet diameter at impact (µm)", true}, "µm",
                     "Size of the droplets that built the layer.");
    out += histogram(
        events_of(run, "normal_speed"), {"impact speed, normal (m/s)", true}, "m/s",
        "Speed of the droplets towards the surface they hit; fast large droplets spread more and may splash.");
    return section("events", "How the deposits dried", out + "</div>");
}

std::string porosity_section(RunFolder const& run)
{
    auto const mean = run.value("product.porosity.mean"), p10 = run.value("product.porosity.p10"),
               p90 = run.value("product.porosity.p90");
    auto add_summary = [&](HistogramChart& chart) {
        if (mean) chart.marks.push_back({fmt::format("mean {}", number(*mean, 3)), *mean});
        if (p10 && p90) chart.band = {*p10, *p90};
    };
    auto const elements = events_of(run, "porosity");
    std::string out = "<div class=\"charts\">";
    HistogramChart of_elements = chart_of(elements, "porosity of a layer element");
    add_summary(of_elements);
    out += figure(
        elements.usable() ? svg(of_elements) : "",
        "Porosity that the model gives each dried deposit; the shaded band is the 10 to 90 % interval of the batch.");

    Weighted granules;
    if (run.snapshot) {
        auto const& view = run.snapshot->granules;
        for (std::size_t g = 0; g < std::min(view.porosity.size(), view.layer_mass.size()); ++g) {
            if (!std::isfinite(view.porosity[g]) || !(view.layer_mass[g] > 0)) continue;
            granules.values.push_back(view.porosity[g]);
            granules.weights.push_back(view.layer_mass[g]);
        }
    }
    HistogramChart of_granules = chart_of(granules, "mean porosity of a granule's layer", "share of the layer (%)");
    add_summary(of_granules);
    out += figure(granules.usable() ? svg(of_granules) : "",
                  "The same, averaged over the layer of each granule; granules that visit the spray often average out, "
                  "so this narrows as the run goes on.");
    out += "</div><table class=\"narrow\"><tbody>";
    out += row("mean porosity of the layer", quantity(mean, "", 4)) +
           row("10 % of the layer is below", quantity(p10, "", 4)) +
           row("median", quantity(run.value("product.porosity.p50"), "", 4)) +
           row("90 % of the layer is below", quantity(p90, "", 4));
    auto const low = run.value("product.porosity.interval_low"), high = run.value("product.porosity.interval_high");
    if (low && high) out += row("95 % interval of the mean", number(*low, 3) + " to " + number(*high, 3));
    return section("porosity", "Predicted porosity", out + "</tbody></table>");
}

std::string product_section(RunFolder const& run)
{
    std::string out = "<div class=\"charts\">";
    Weighted sizes;
    std::optional<product::Percentiles> d;
    std::optional<double> moisture;
    if (run.snapshot) {
        auto const& view = run.snapshot->granules;
        double water = 0, dry = 0;
        for (std::size_t g = 0; g < view.diameter.size(); ++g) {
            double const count = g < view.count.size() ? view.count[g] : 1;
            double const volume = count * view.diameter[g] * view.diameter[g] * view.diameter[g];
            if (!std::isfinite(volume) || !(volume > 0)) continue;
            sizes.values.push_back(1000 * view.diameter[g]);
            sizes.weights.push_back(volume);
            if (g < view.moisture.size() && std::isfinite(view.moisture[g]))
                water += volume * view.moisture[g], dry += volume;
        }
        if (sizes.usable()) d = product::percentiles(sizes.values, sizes.weights);
        if (dry > 0) moisture = water / dry;
    }
    auto size = [&](char const* key, double fallback) -> std::optional<double> {
        if (auto const value = run.value(std::string("product.size_m.") + key)) return 1000 * *value;
        return d ? std::optional(fallback) : std::nullopt;
    };
    if (auto const value = run.value("product.residual_moisture")) moisture = value;
    HistogramChart chart = chart_of(sizes, "granule diameter (mm)", "share of the volume (%)");
    if (d) chart.marks = {{"d50 " + quantity(size("d50", d->p50), "mm", 4), d->p50}};
    out += figure(sizes.usable() ? svg(chart) : "",
                  "Size of the granules with their layer at the end of the simulated time, by volume.");
    out += "<div><table class=\"narrow\"><tbody>";
    out += row("d10", quantity(size("d10", d ? d->p10 : 0), "mm")) +
           row("d50", quantity(size("d50", d ? d->p50 : 0), "mm")) +
           row("d90", quantity(size("d90", d ? d->p90 : 0), "mm"));
    out += row("residual moisture (liquid water per dry granule)",
               moisture ? quantity(1000 * *moisture, "g/kg", 3) : not_available);
    out += row("batch", quantity(run.value("granules.mass_kg"), "kg", 4));
    double layer = 0;
    if (run.snapshot)
        for (double const mass : run.snapshot->granules.layer_mass) layer += std::isfinite(mass) ? mass : 0;
    out += row("dried layer on the granules", run.snapshot ? quantity(1000 * layer, "g", 3) : not_available);
    return section("product", "Size and moisture of the product", out + "</tbody></table></div></div>");
}
}
