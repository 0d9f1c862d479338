// Where the spray went, what the run cost, and what it was run with.
#include "granum/report/chart.hpp"
#include "granum/report/html.hpp"
#include "granum/report/sections.hpp"

#include <fmt/format.h>

#include <array>

namespace granum::report
{
namespace
{
std::string percent(double part, double all)
{
    return all > 0 ? number(100 * part / all, 3) + "\u00a0%" : not_available;
}
}

std::string row(std::string const& name, std::string const& value)
{
    return fmt::format("<tr><td>{}</td><td class=\"num\">{}</td></tr>", escape(name), escape(value));
}

std::string spray_section(RunFolder const& run)
{
    double const sprayed = run.value("spray.sprayed_kg").value_or(0);
    struct Part
    {
        char const *name, *key;
    };
    constexpr std::array<Part, 4> parts{{{"deposited on granules", "spray.deposited_kg"},
                                         {"overspray (dried in flight or carried out)", "spray.overspray_kg"},
                                         {"on walls", "spray.on_walls_kg"},
                                         {"still in flight", "spray.in_flight_kg"}}};
    std::vector<Share> shares;
    std::string table = "<table class=\"narrow\"><tbody>";
    for (auto const& part : parts) {
        auto const mass = run.value(part.key);
        shares.push_back({part.name, mass.value_or(0)});
        table += fmt::format("<tr><td>{}</td><td class=\"num\">{}</td><td class=\"num\">{}</td></tr>", part.name,
                             mass ? quantity(1000 * *mass, "g", 3) : not_available,
                             mass ? percent(*mass, sprayed) : not_available);
    }
    auto const abraded = run.value("spray.abraded_kg").value_or(0);
    table += fmt::format(
        "<tr class=\"sum\"><td>sprayed</td><td class=\"num\">{}</td><td class=\"num\">{}</td></tr></tbody></table>",
        run.value("spray.sprayed_kg") ? quantity(1000 * sprayed, "g", 4) : not_available,
        sprayed > 0 ? "100\u00a0%" : "");
    if (abraded > 0)
        table += fmt::format("<p>Of layers {} were rubbed off again by collisions ({} of what was sprayed).</p>",
                             quantity(1000 * abraded, "g", 3), percent(abraded, sprayed));
    return section(
        "spray", "Where the solids of the spray went",
        figure(split_bar(shares), "Solids of the sprayed liquid: only the deposited part becomes product.") + table);
}

std::string performance_section(RunFolder const& run)
{
    std::vector<Share> shares;
    auto const& split = run.at("performance.share");
    if (split.is_object())
        for (auto const& [name, value] : split.items())
            if (value.is_number()) shares.push_back({name, value.get<double>()});
    std::string out = figure(split_bar(shares), "Where the computing time went.") + "<table class=\"narrow\"><tbody>";
    auto const speed = run.value("performance.granule_steps_per_s");
    out +=
        row("steps of a parcel per second", speed ? fmt::format("{} million", number(*speed / 1e6, 3)) : not_available);
    auto const wall = run.value("run.wall_s"), simulated = run.value("run.simulated_s");
    out += row("wall time", wall ? duration(*wall) : not_available) + row("simulated time", quantity(simulated, "s"));
    out += row("wall time per simulated second",
               wall && simulated && *simulated > 0 ? duration(*wall / *simulated) : not_available);
    out += row("coupling steps of gas and granules",
               run.value("run.steps") ? whole(*run.value("run.steps")) : not_available) +
           row("ranks", run.value("run.ranks") ? whole(*run.value("run.ranks")) : not_available);
    return section("performance", "Computing time", out + "</tbody></table>");
}

std::string warnings_section(RunFolder const& run)
{
    std::string out;
    for (auto const& warning : run.warnings) out += fmt::format("<li>{}</li>", escape(warning));
    for (auto const& missing : run.missing) out += fmt::format("<li>Not in this report: {}</li>", escape(missing));
    return section("warnings", "Warnings", out.empty() ? "<p>None.</p>" : "<ul>" + out + "</ul>");
}

std::string case_section(RunFolder const& run)
{
    if (run.resolved_case.empty()) return section("case", "The case", "<p>The resolved case is not available.</p>");
    return section(
        "case", "The case",
        fmt::format("<details><summary>Every value that was used, defaults included</summary><pre>{}</pre></details>",
                    escape(run.resolved_case)));
}
}
