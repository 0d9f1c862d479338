// Granules alone: how they are packed, where their energy went, what came and left.
#include "granum/report/html.hpp"
#include "granum/report/sections.hpp"

#include <fmt/format.h>

namespace granum::report
{
namespace
{
std::optional<double> percent(std::optional<double> share)
{
    if (share) *share *= 100;
    return share;
}

//! Soft granules touch for a while, hard ones collide.
std::string touching(RunFolder const& run)
{
    std::string out;
    out += row("mean coordination number", quantity(run.value("packing.coordination_number"), "", 4));
    out += row("contacts of granules", quantity(run.value("packing.contacts"), "", 6));
    out += row("contacts with walls", quantity(run.value("packing.wall_contacts"), "", 6));
    out += row("overlap, mean", quantity(percent(run.value("packing.overlap.mean")), "% of a radius", 3));
    out += row("overlap, 99 % are below", quantity(percent(run.value("packing.overlap.p99")), "% of a radius", 3));
    out += row("overlap, largest", quantity(percent(run.value("packing.overlap.largest")), "% of a radius", 3));
    out += row(fmt::format("contacts beyond {}", quantity(percent(run.value("packing.overlap.criterion")), "%", 2)),
               quantity(percent(run.value("packing.overlap.share_beyond")), "%", 3));
    return out;
}

std::string colliding(RunFolder const& run)
{
    std::string out;
    out += row("collisions of granules", quantity(run.value("collisions.pairs"), "", 9));
    out += row("collisions with walls", quantity(run.value("collisions.walls"), "", 9));
    out += row("in time-driven steps", quantity(run.value("collisions.time_driven_s"), "s", 3));
    if (auto const largest = run.value("packing.overlap.largest"))
        out += row("overlap, largest", fmt::format("{:.1e} of a radius", *largest));
    return out;
}
}

std::string packing_section(RunFolder const& run)
{
    bool const hard = run.at("collisions").is_object();
    std::string out = "<table class=\"narrow\"><tbody>";
    out += hard ? colliding(run) : touching(run);
    out += row("energy of motion", quantity(run.value("mechanics.kinetic_J"), "J", 3));
    out += row("dissipated in contacts", quantity(run.value("mechanics.dissipated_J"), "J", 3));
    if (auto const missing = run.value("mechanics.relative_error"))
        out += row("energy missing, of what moved or was lost", fmt::format("{:.1e}", *missing));
    if (run.at("traffic").is_object()) {
        out += row("fed", quantity(run.value("traffic.fed_kg"), "kg", 4));
        out += row("discharged", quantity(run.value("traffic.discharged_kg"), "kg", 4));
    }
    return section("packing", hard ? "The collisions" : "The packing", out + "</tbody></table>");
}
}
