// granum check CASE: validates without running, and says what the case implies.
#include "verbs.hpp"

#include "cores.hpp"
#include "granum/sim/case_reader.hpp"
#include "granum/sim/wall_time.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace granum::app
{
namespace
{
void line(std::string_view label, std::string const& text)
{
    fmt::print("{:<18}{}\n", label, text);
}

std::string duration(double seconds)
{
    if (seconds < 90) return fmt::format("{:.0f} s", std::max(1.0, seconds));
    if (seconds < 600) return fmt::format("{:.1f} min", seconds / 60);
    if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}

void print_bed(sim::Case const& data, sim::Forecast const& f)
{
    if (f.parcels == 0) return;
    line("granules",
         fmt::format("{:.4g} of {:.3g} mm, {:.4g} kg/m3{}", f.granules, 1e3 * data.granules.diameter,
                     data.granules.density,
                     data.granules.mass > 0 ? fmt::format(", {:.4g} kg", data.granules.mass) : std::string()));
    line("parcels",
         fmt::format("{}, ratio {:.3g}: {:.3g} mm wide, {:.4g} granules each", f.parcels, data.granules.parcel_ratio,
                     1e3 * f.parcel_diameter, f.granules / static_cast<double>(f.parcels)));
    if (f.bed_height > 0) line("settled bed", fmt::format("{:.1f} mm high at 60 % solids", 1e3 * f.bed_height));
    if (data.contact.hard()) {
        line("contacts", "hard spheres: from collision to collision, without overlap and without a step, on one rank");
        return;
    }
    line("overlap",
         fmt::format("about {:.1f} % of a radius in a contact at {:.2g} m/s", 100 * f.overlap, f.overlap_speed));
    double least = f.bounds.front().seconds;
    for (auto const& bound : f.bounds) least = std::min(least, bound.seconds);
    line("granule step", fmt::format("{:.3g} s{}", f.granule_step,
                                     data.time.granule_step ? ", as the case says" : ", the smallest of"));
    for (auto const& bound : f.bounds)
        fmt::print("{:<18}  {:.3g} s: {}{}\n", "", bound.seconds, bound.reason,
                   bound.seconds == least ? "  <- smallest" : "");
}

void print_gas(sim::Case const& data, sim::Forecast const& f)
{
    if (!data.gas.present) return;
    line("gas at the plate", fmt::format("{:.3g} m/s superficial", f.plate_velocity));
    if (f.minimum_fluidisation > 0) {
        line("fluidisation", fmt::format("begins at {:.3g} m/s ({}, voidage 0.42); terminal velocity {:.3g} m/s",
                                         f.minimum_fluidisation, data.gas.drag, f.terminal_velocity));
    }
    line(
        "cells",
        fmt::format("{} ({} x {} x {}), {:.3g} x {:.3g} x {:.3g} mm{}", f.cells, data.gas.cells[0], data.gas.cells[1],
                    data.gas.cells[2], 1e3 * f.cell_size.x, 1e3 * f.cell_size.y, 1e3 * f.cell_size.z,
                    f.cell_over_parcel > 0 ? fmt::format("; {:.2f} parcels wide", f.cell_over_parcel) : std::string()));
    line("gas step", fmt::format("about {:.3g} s (Courant number 1, at most 50 granule steps)", f.gas_step));
}

int check(std::string const& path)
{
    auto const resolved = sim::read_case(path);
    auto const& data = resolved.data;
    int const ranks = data.contact.hard() ? 1 : cores();
    auto const f = sim::forecast(data, ranks);
    fmt::print("{}: {}\n", path, data.title);
    print_bed(data, f);
    print_gas(data, f);
    if (f.balance) {
        auto const& b = *f.balance;
        line("balance", fmt::format("outlet {:.2f} degC, {:.2f} g/kg, {:.1f} % rh; wet bulb {:.2f} degC; eta {:.4f}",
                                    b.outlet_temperature - 273.15, 1e3 * b.outlet_humidity,
                                    100 * b.outlet_relative_humidity, b.wet_bulb - 273.15, b.eta));
    }
    line("memory", fmt::format("about {:.0f} MB", f.memory / 1e6));
    if (double const seconds = sim::wall_time(data, f, ranks, sim::machine_speed(ranks)); seconds > 0)
        line("wall time", fmt::format("about {} for {:.3g} s on {} {}", duration(seconds), data.time.duration, ranks,
                                      ranks == 1 ? "core" : "cores"));
    for (auto const& warning : resolved.warnings) fmt::print("warning: {}\n", warning);
    fmt::print("the case can be run\n");
    return 0;
}
}

void add_check(CLI::App& program, Action& action)
{
    auto* verb = program.add_subcommand("check", "validate a case and say what it implies");
    auto path = std::make_shared<std::string>();
    verb->add_option("CASE", *path, "case file")->required();
    verb->callback([path, &action] { action = [path] { return check(*path); }; });
}
}
