// Closed vessels and vessels that are filled or emptied: gas whose pressure is what its mass and heat make it, against
// closed forms of the ideal gas with constant heat capacities. Rows E02 to E04.
//
// Without losses m c_v T changes by the enthalpy m c_p T of what enters. What leaves a vessel of one temperature lets
// the rest expand without change of entropy.
#include "granum/material/moist_air.hpp"
#include "scene/flow.hpp"
#include "unit/gas/chamber_with_gas.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;

double const gas_constant = math::gas_constant / material::molar_mass_air;  //!< J/kg/K
double const cp = material::heat_capacity_air, cv = cp - gas_constant;

//! Mass, mean temperature by mass, and pressure of a vessel of dry air.
struct Content
{
    double mass = 0, temperature = 0, pressure = 0;
};

Content content(sim::Simulation const& simulation, bool full)
{
    auto const& gas = simulation.gas();
    Content out;
    double volume = 0;
    grid::for_each_cell(simulation.grid(), [&](int, int, int, grid::Index c) {
        double const open = simulation.grid().open_volume[c];
        out.mass += gas.mass[c];
        out.temperature += gas.mass[c] * gas.temperature[c];
        out.pressure += open * (full ? simulation.data().gas.pressure + gas.pressure[c] : gas.static_pressure);
        volume += open;
    });
    out.temperature /= out.mass, out.pressure /= volume;
    return out;
}

void go(sim::Simulation& simulation, double until, double step)
{
    for (long k = std::lround((until - simulation.time()) / step); k > 0; --k) simulation.step(step);
}

TEST(ClosedVessel, that_its_walls_heat_keeps_its_mass_and_the_ratio_of_pressure_and_temperature)
{
    for (std::string const kind : {"low-mach", "full"}) {
        auto const simulation = scene::simulation_of(scene::gas_in_box(
            {0.1, 0.1, 0.1}, {4, 4, 4}, "",
            "closed = true\ntemperature = \"300 K\"\npressure = \"1 bar\"\nconductivity = \"1 W/m/K\"\n"
            "compressibility = \"" +
                kind + "\"\n[[gas.wall]]\nof = \"all\"\ntemperature = \"450 K\"\n"));
        bool const full = kind == "full";
        auto const before = content(*simulation, full);
        go(*simulation, 0.5, 5e-3);
        auto const middle = content(*simulation, full);
        EXPECT_GT(middle.temperature, 310);
        EXPECT_LT(middle.temperature, 440);
        go(*simulation, 30, 0.1);
        auto const after = content(*simulation, full);
        std::string const name = "closed vessel, " + kind + ", walls 150 K hotter: ";
        verify::below("E02", name + "mass lost, share", 1e-10, std::abs(after.mass / before.mass - 1));
        verify::relative("E02", name + "pressure over that at the start", 1.5, after.pressure / before.pressure, 1e-6);
        verify::relative("E02", name + "temperature, K", 450, after.temperature, 1e-6);
        verify::relative("E02", name + "heat that the walls gave over m c_v dT", 1,
                         -simulation->heat().wall_gas / (before.mass * cv * 150), 1e-6);
        verify::below("E02", name + "energy missing over what passed", 1e-10,
                      simulation->ledgers().energy.relative_error());
    }
}

//! A vessel of 10 L at 0.2 bar and 300 K that is filled with air of 320 K at 1 g/s for 0.05 s.
std::unique_ptr<sim::Simulation> filled(std::string const& kind, std::array<int, 3> cells, double length, double step,
                                        double time)
{
    double const side = std::sqrt(0.01 / length);
    auto simulation = scene::simulation_of(scene::gas_in_box(
        {length, side, side}, cells, "",
        "temperature = \"300 K\"\npressure = \"0.2 bar\"\nhumidity = 0\nconductivity = \"1e-12 W/m/K\"\n"
        "compressibility = \"" +
            kind +
            "\"\n[[inlet]]\nend = \"left\"\nhumidity = 0\ntemperature = \"320 K\"\ndry_mass_flow = \"0.1 kg/s\"\n"));
    go(*simulation, time, step);
    return simulation;
}

TEST(Plenum, that_is_filled_has_the_temperature_and_pressure_of_the_closed_form)
{
    double const volume = 0.01, time = 0.05, entered = 0.1 * time;
    double const start = 0.2e5 * volume / (gas_constant * 300), mass = start + entered;
    double const temperature = (start * cv * 300 + entered * cp * 320) / (mass * cv);
    double const pressure = mass * gas_constant * temperature / volume;
    for (std::string const kind : {"low-mach", "full"}) {
        bool const full = kind == "full";
        std::string const name = "vessel filled threefold, " + kind + ": ";
        std::vector<double> off;
        for (double const step : {5e-4, 2.5e-4, 1.25e-4}) {
            auto const simulation = filled(kind, {4, 2, 2}, 0.25, step, time);
            auto const now = content(*simulation, full);
            off.push_back(now.temperature - temperature);
            if (step > 1.3e-4) continue;
            verify::below("E03", name + "mass off, share", 1e-10, std::abs(now.mass / mass - 1));
            verify::relative("E03", name + "temperature, K", temperature, now.temperature, 2e-3);
            verify::relative("E03", name + "pressure, Pa", pressure, now.pressure, 5e-3);
            verify::below("E03", name + "energy missing over what passed", 1e-10,
                          simulation->ledgers().energy.relative_error());
        }
        verify::between("E03", name + "order of the step in the temperature", 0.85, 1.2,
                        std::log2((off[0] - off[1]) / (off[1] - off[2])));
    }
}

TEST(Plenum, that_is_filled_from_one_end_compresses_what_is_there_without_change_of_entropy)
{
    // A tube: what was there is pushed to the far end and mixes with nothing.
    auto const simulation = filled("low-mach", {64, 1, 1}, 1, 2e-5, 0.02);
    auto const now = content(*simulation, false);
    auto const& grid = simulation->grid();
    double const last = simulation->gas().temperature[grid.at(63, 0, 0)];
    verify::relative("E03", "tube filled from one end: temperature at the other, K",
                     300 * std::pow(now.pressure / 0.2e5, gas_constant / cp), last, 1e-3);
}

//! A closed vessel at 1 bar from which gas of its own state is taken until a third is left: temperature over that
//! along the isentrope, less one.
double off_isentrope(gas::Compressibility kind, int steps, double& missing)
{
    gas::Settings const settings{.outlets = {}, .compressibility = kind, .pressure = 1e5, .gravity = {}};
    gas::ChamberWithGas vessel({.size = {0.1, 0.1, 0.1}}, {2, 2, 2}, {}, settings, 300, 0);
    double const mass = vessel.sum(vessel.state.mass), heat = vessel.sum(vessel.state.enthalpy), dt = 0.1 / steps;
    double passed = 0, work = 0;
    for (int step = 0; step < steps; ++step) {
        vessel.sources.clear(vessel.grid);
        grid::for_each_cell(vessel.grid, [&](int, int, int, grid::Index c) {
            double const rate = -mass * 2 / 3 / 0.1 / 8;
            vessel.sources.mass[c] = rate;
            vessel.sources.enthalpy[c] = rate * material::enthalpy(vessel.state.temperature[c], 0);
            passed += dt * vessel.sources.enthalpy[c];
        });
        work += vessel.step(dt).pressure_work;
    }
    auto const c = vessel.grid.at(0, 0, 0);
    missing = std::abs(vessel.sum(vessel.state.enthalpy) - heat - passed - work) / heat;
    EXPECT_NEAR(3 * vessel.sum(vessel.state.mass) / mass, 1, 1e-10);
    // T ~ rho^(gamma - 1)
    return vessel.state.temperature[c] / (300 * std::pow(1.0 / 3, gas_constant / cv)) - 1;
}

TEST(Vessel, that_loses_gas_cools_along_the_isentrope)
{
    for (auto const kind : {gas::Compressibility::low_mach, gas::Compressibility::full}) {
        double missing = 0;
        double const coarse = off_isentrope(kind, 100, missing), fine = off_isentrope(kind, 200, missing),
                     finest = off_isentrope(kind, 400, missing);
        std::string const name =
            fmt::format("vessel that loses gas, {}: ", kind == gas::Compressibility::full ? "full" : "low-mach");
        verify::below("E04", name + "temperature off the isentrope, share", 5e-3, std::abs(finest));
        verify::below("E04", name + "energy missing over what was there", 1e-10, missing);
        verify::between("E04", name + "order of the step", 0.9, 1.1, std::log2(coarse / finest) / 2);
        EXPECT_GT(std::abs(fine), std::abs(finest));
    }
}
}
