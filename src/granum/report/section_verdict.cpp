// The head of the page: what was predicted, and whether the run can be believed.
#include "granum/math/constants.hpp"
#include "granum/report/html.hpp"
#include "granum/report/sections.hpp"

#include <fmt/format.h>

#include <cmath>

namespace granum::report
{
namespace
{
using math::zero_celsius;

std::optional<double> times(std::optional<double> value, double factor)
{
    if (value) *value *= factor;
    return value;
}

std::optional<double> celsius(std::optional<double> kelvin)
{
    if (kelvin) *kelvin -= zero_celsius;
    return kelvin;
}

std::string tile(std::string const& name, std::string const& value, std::string const& note)
{
    return fmt::format(
        "<div class=\"tile\"><span class=\"name\">{}</span><span class=\"value{}\">{}</span><span "
        "class=\"note\">{}</span></div>",
        name, value == not_available ? " none" : "", escape(value), escape(note));
}

enum class Light
{
    good,
    watch,
    bad,
    unknown
};

struct Check
{
    std::string name, found, bar;
    Light light;
    std::string meaning;
};

//! Good within `bar`, worth a look within ten (ledgers) or three bars, bad beyond.
Light judge(std::optional<double> deviation, double bar, double patience)
{
    if (!deviation || !std::isfinite(*deviation)) return Light::unknown;
    double const size = std::abs(*deviation);
    return size <= bar ? Light::good : size <= patience * bar ? Light::watch : Light::bad;
}

//! @param bar allowed error where the summary states none
Check ledger(RunFolder const& run, std::string const& what, double bar, std::string const& meaning)
{
    auto const error = run.value("ledger." + what + ".relative_error");
    bar = run.value("ledger." + what + ".bar").value_or(bar);
    return {what + " ledger", error ? fmt::format("{:.1e}", *error) : not_available, fmt::format("{:.0e}", bar),
            judge(error, bar, 10), meaning};
}

std::optional<double> deviation(std::optional<double> value, std::optional<double> reference)
{
    if (!value || !reference || *reference == 0) return std::nullopt;
    return *value / *reference - 1;
}

//! Water evaporated over water sprayed in the last two thirds of the run.
std::optional<double> evaporated_share(RunFolder const& run)
{
    auto const last_in = run.value("water.sprayed_last_two_thirds_kg"),
               last_out = run.value("water.evaporated_last_two_thirds_kg");
    if (last_in && last_out && *last_in > 0) return *last_out / *last_in;
    auto const* time = run.column({"time"});
    auto const* sprayed = run.column({"sprayed_water"});
    auto const* evaporated = run.column({"evaporated_water"});
    if (!time || !sprayed || !evaporated || time->size() < 3) return std::nullopt;
    std::size_t first = 0;
    while (first + 1 < time->size() && (*time)[first] < time->front() + (time->back() - time->front()) / 3) ++first;
    double const in = sprayed->back() - (*sprayed)[first];
    if (!(in > 0)) return std::nullopt;
    return (evaporated->back() - (*evaporated)[first]) / in;
}

Check agreement(std::string const& name, std::optional<double> off, std::string const& meaning)
{
    return {name, off ? fmt::format("{:+.2f} %", 100 * *off) : not_available, "3 %", judge(off, 0.03, 3), meaning};
}

std::vector<Check> checks(RunFolder const& run)
{
    std::vector<Check> out;
    out.push_back(ledger(run, "solids", 1e-9, "solids in = solids on granules, walls, in flight and lost"));
    out.push_back(ledger(run, "water", 1e-9, "water in = water in gas and deposits, and out"));
    out.push_back(ledger(run, "energy", 1e-6, "enthalpy in = enthalpy stored and out"));
    if (run.value("ledger.momentum.relative_error"))
        out.push_back(ledger(run, "momentum", 1e-9, "force on the gas = force on granules and droplets, turned round"));
    out.push_back(agreement("bed pressure drop",
                            deviation(run.value("bed.pressure_drop_Pa"), run.value("bed.weight_over_area_Pa")),
                            "against the weight of the bed over its area: is all of it fluidised?"));
    out.push_back(agreement("outlet humidity",
                            deviation(run.value("result.outlet_humidity"), run.value("balance.outlet_humidity")),
                            "against the steady balance of the whole apparatus"));
    auto const share = evaporated_share(run);
    out.push_back(agreement("water evaporated", share ? std::optional(*share - 1) : std::nullopt,
                            "against water sprayed, over the last two thirds: is the run steady?"));
    auto const sprayed = run.value("spray.sprayed_kg");
    std::optional<double> lost;
    if (sprayed && *sprayed > 0) {
        double sum = 0;
        for (char const* part : {"deposited_kg", "overspray_kg", "on_walls_kg", "in_flight_kg"})
            sum += run.value(std::string("spray.") + part).value_or(std::nan(""));
        lost = sum / *sprayed - 1;
    }
    out.push_back({"spray split", lost && std::isfinite(*lost) ? fmt::format("{:.1e}", *lost) : not_available, "1e-09",
                   judge(lost, 1e-9, 10), "deposited + overspray + walls + in flight = sprayed"});
    return out;
}

//! Sums that must be exact break; comparisons with the steady state only say that it is not reached.
char const* word(Check const& check)
{
    bool const exact = check.name.ends_with("ledger") || check.name == "spray split";
    switch (check.light) {
        case Light::good:
            return "holds";
        case Light::watch:
            return "look at it";
        case Light::bad:
            return exact ? "broken" : "not steady";
        case Light::unknown:
            break;
    }
    return not_available;
}

char const* style(Light light)
{
    switch (light) {
        case Light::good:
            return "good";
        case Light::watch:
            return "watch";
        case Light::bad:
            return "bad";
        case Light::unknown:
            break;
    }
    return "unknown";
}

//! No comparison with the steady state is far off.
bool steady(std::vector<Check> const& all)
{
    return std::none_of(all.begin(), all.end(), [](Check const& check) {
        return check.light == Light::bad && std::string_view(word(check)) == "not steady";
    });
}

//! The verdict over all ledgers, in one clause.
std::string ledger_verdict(std::vector<Check> const& all)
{
    int closed = 0, nearly = 0, broken = 0, unknown = 0;
    for (auto const& check : all) {
        if (!check.name.ends_with("ledger")) continue;
        switch (check.light) {
            case Light::good:
                ++closed;
                break;
            case Light::watch:
                ++nearly;
                break;
            case Light::bad:
                ++broken;
                break;
            case Light::unknown:
                ++unknown;
                break;
        }
    }
    int const known = closed + nearly + broken;
    if (broken > 0)
        return fmt::format("{} of {} ledgers not closed: do not use these results before that is understood",
                           broken + nearly, known);
    if (nearly > 0) return fmt::format("{} of {} ledgers not closed within its bar, see the checks", nearly, known);
    if (closed == 0) return "the ledgers are not available";
    return unknown > 0 ? "the ledgers that are available are closed"
                       : "the ledgers of solids, water and energy are closed";
}
}

std::string figure(std::string const& drawing, std::string const& caption)
{
    if (drawing.empty())
        return fmt::format("<figure class=\"empty\"><figcaption>{} <b>No data yet.</b></figcaption></figure>",
                           escape(caption));
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>", drawing, escape(caption));
}

std::string section(std::string const& id, std::string const& heading, std::string const& body)
{
    return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, escape(heading), body);
}

std::string verdict_section(RunFolder const& run)
{
    auto const all = checks(run);
    std::string const title = run.text("title", run.text("case.title", "Untitled case"));
    std::string out =
        fmt::format("<header id=\"verdict\"><p class=\"brand\">Granum report</p><h1>{}</h1>\n", escape(title));

    std::vector<std::string> how;
    if (auto const version = run.text("granum.version", run.text("version", "")); !version.empty())
        how.push_back("Granum " + version);
    if (auto const simulated = run.value("run.simulated_s"))
        how.push_back(quantity(simulated, "s", 3) + " of the process simulated");
    if (auto const wall = run.value("run.wall_s"))
        how.push_back(fmt::format("in {} on {} rank{}", duration(*wall), whole(run.value("run.ranks").value_or(1)),
                                  run.value("run.ranks").value_or(1) == 1 ? "" : "s"));
    if (auto const parcels = run.value("granules.parcels"))
        how.push_back(fmt::format("{} parcels for {} granules ({})", whole(*parcels),
                                  number(run.value("granules.represented").value_or(NAN), 3),
                                  quantity(run.value("granules.mass_kg"), "kg", 3)));
    if (auto const cells = run.value("gas.cells")) how.push_back(whole(*cells) + " gas cells");
    std::string line;
    for (auto const& part : how) line += (line.empty() ? "" : " · ") + part;
    if (!line.empty()) out += fmt::format("<p class=\"how\">{}</p>\n", escape(line));
    auto const ended = run.text("ended", "");
    if (ended != "done")
        out += fmt::format(
            "<p class=\"how\"><b>The run did not reach its end{}; everything below is up to that moment.</b></p>\n",
            escape(ended.empty() ? "" : " (" + ended + ")"));

    if (run.granules_alone())
        return out + fmt::format(
                         "<p class=\"statement\">Granules alone: a granule touches {} others; 99 % of the overlaps are "
                         "below {} % of a radius.</p></header>\n",
                         quantity(run.value("packing.coordination_number"), "", 3),
                         quantity(times(run.value("packing.overlap.p99"), 100), "", 2));

    auto const mean = run.value("product.porosity.mean"), p10 = run.value("product.porosity.p10"),
               p90 = run.value("product.porosity.p90");
    auto const eta = run.value("result.eta_global");
    std::string verdict = mean ? fmt::format("Predicted porosity of the layer: {} (10 to 90 % interval {} to {})",
                                             number(*mean, 3), quantity(p10, "", 3), quantity(p90, "", 3))
                               : "No product property yet: no sprayed deposit has dried";
    if (eta) verdict += fmt::format(", at a drying potential of {}", number(*eta, 3));
    out += fmt::format("<p class=\"statement\">{}; {}{}.</p>\n", escape(verdict), ledger_verdict(all),
                       steady(all) ? "" : "; the run is not steady yet, see the checks");
    if (!(run.at("product.validated").is_boolean() && run.at("product.validated").get<bool>()))
        out +=
            "<p class=\"notice\" id=\"notice\"><b>This map is not validated on a measured product.</b> The step from "
            "drying "
            "conditions to porosity uses coefficients given in the case. Take the property as a trend between cases, "
            "not as a "
            "number to specify, until a map fitted to measurements of your product is used.</p>\n";

    auto const balance_eta = run.value("balance.eta");
    out += "<div class=\"tiles\" id=\"key-figures\">";
    out += tile("layer porosity", quantity(mean, "", 3),
                mean ? fmt::format("10 to 90 %: {} to {}", quantity(p10, "", 3), quantity(p90, "", 3))
                     : "mean over the solids");
    out += tile("drying potential η", quantity(eta, "", 3), "balance: " + quantity(balance_eta, "", 3));
    out += tile("bed temperature", quantity(celsius(run.value("result.bed_temperature_K")), "°C", 3),
                "mean of the last third");
    out += tile("outlet air", quantity(celsius(run.value("result.outlet_temperature_K")), "°C", 3),
                "balance: " + quantity(celsius(run.value("balance.outlet_temperature_K")), "°C", 3));
    out += tile("outlet humidity", quantity(times(run.value("result.outlet_humidity"), 1000), "g/kg", 3),
                "balance: " + quantity(times(run.value("balance.outlet_humidity"), 1000), "g/kg", 3));
    auto const count = run.value("events.count");
    auto const hits = run.value("spray.hits");
    out += tile(
        "deposits dried", count ? whole(*count) : whole(static_cast<double>(run.events.rows())),
        hits ? fmt::format("of {} captured; the property rests on these", whole(*hits)) : "events behind the property");
    return out + "</div></header>\n";
}

std::string checks_section(RunFolder const& run)
{
    std::string out =
        "<table><thead><tr><th>check</th><th class=\"num\">found</th><th "
        "class=\"num\">allowed</th><th>verdict</th><th>what it compares</th></tr></thead><tbody>";
    for (auto const& check : checks(run))
        out += fmt::format(
            "<tr><td>{}</td><td class=\"num\">{}</td><td class=\"num\">{}</td><td><span class=\"light "
            "{}\">{}</span></td><td>{}</td></tr>",
            escape(check.name), escape(check.found), check.bar, style(check.light), word(check), escape(check.meaning));
    return section("checks", "Can it be trusted?",
                   out + "</tbody></table><p>Ledger errors are relative to what passed through the apparatus.</p>");
}
}
