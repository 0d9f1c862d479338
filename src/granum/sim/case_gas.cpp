// Reads [gas] with its cells.
#include "granum/sim/balance.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/law_families.hpp"

#include "granum/grid/stretch.hpp"
#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::sim
{
using io::Dimension;

namespace
{
void read_humidity(io::CaseFile& file, std::string const& key, GasCase const& gas, FlowCase& flow)
{
    auto const humidity =
        file.optional_quantity(key + "humidity", Dimension::one, "kg water per kg dry air", io::not_negative);
    auto const relative =
        file.optional_quantity(key + "relative_humidity", Dimension::one, "of what enters", io::zero_to_one);
    if (file.has(key + "humidity") && file.has(key + "relative_humidity"))
        file.mistake(key + "relative_humidity", "and " + key + "humidity cannot both be given");
    double const saturated = material::saturation_humidity(flow.temperature, gas.pressure);
    if (humidity) {
        flow.humidity = *humidity;
        if (*humidity > saturated && !gas.vapour_molar_mass)
            file.mistake(
                key + "humidity",
                fmt::format("is above saturation at {}", io::write_quantity(flow.temperature, Dimension::temperature)),
                {fmt::format("allowed: 0 to {:.4g} g/kg", 1000 * saturated)});
    } else if (relative) {
        double const vapour = *relative * material::saturation_pressure(flow.temperature);
        flow.humidity = vapour < gas.pressure ? material::molar_ratio * vapour / (gas.pressure - vapour) : 0;
        if (vapour >= gas.pressure)
            file.mistake(key + "relative_humidity", "cannot be reached: water boils at this temperature");
        file.derived(key + "humidity", fmt::format("{:.6g}", flow.humidity), "kg water per kg dry air");
    } else if (!gas.density && !gas.closed && !file.wrong(key + "humidity") && !file.wrong(key + "relative_humidity")) {
        file.mistake(key.substr(0, key.size() - 1), "needs the humidity of the air",
                     {"e.g. humidity = \"8 g/kg\" or relative_humidity = \"30 %\""});
    }
}

void read_properties(io::CaseFile& file, GasCase& gas)
{
    gas.density =
        file.optional_quantity("gas.density", Dimension::density, "constant, instead of moist air", io::positive);
    gas.viscosity =
        file.optional_quantity("gas.viscosity", Dimension::viscosity, "constant, instead of moist air", io::positive);
    gas.conductivity = file.optional_quantity("gas.conductivity", Dimension::conductivity,
                                              "constant, instead of moist air", io::positive);
    gas.diffusivity = file.optional_quantity("gas.diffusivity", Dimension::diffusivity,
                                             "of vapour, constant, instead of moist air", io::positive);
    gas.molar_mass =
        file.optional_quantity("gas.molar_mass", Dimension::molar_mass, "of the dry gas, instead of air", io::positive);
    gas.vapour_molar_mass =
        file.optional_quantity("gas.vapour_molar_mass", Dimension::molar_mass, "instead of water", io::positive);
    gas.expansion = file.quantity("gas.expansion", Dimension::expansion, 0.0,
                                  "of a constant density, in its weight (Boussinesq)", io::not_negative);
    gas.expansion_temperature = file.quantity("gas.expansion_temperature", Dimension::temperature, 293.15,
                                              "at which the constant density is", io::positive);
    if (gas.expansion > 0 && !gas.density) file.mistake("gas.expansion", "belongs to a constant gas.density");
    gas.compressibility = file.name("gas.compressibility", gas.density ? "constant" : "low-mach",
                                    "what the density follows", {"constant", "low-mach", "full"}, "a choice");
    if (gas.compressibility == "constant" && !gas.density)
        file.mistake("gas.compressibility", "is constant: the density must be known", {"add gas.density"});
    if (gas.compressibility != "constant" && gas.density)
        file.mistake("gas.density", "is constant: gas.compressibility cannot be " + gas.compressibility);
    if (!file.has("gas.tracer")) return;
    TracerCase tracer;
    tracer.diffusivity = file.quantity("gas.tracer.diffusivity", Dimension::diffusivity, tracer.diffusivity,
                                       "of the tracer", io::not_negative);
    tracer.molar_mass = file.optional_quantity("gas.tracer.molar_mass", Dimension::molar_mass,
                                               "of the tracer; without it the density does not change", io::positive);
    gas.tracer = tracer;
}
}

namespace
{
void read_forces(io::CaseFile& file, ForceCase& forces)
{
    auto const law = [&](std::string const& key, std::string& name) {
        name = file.name("gas." + key, name, "law", laws_for("gas." + key), "a law");
    };
    law("virtual_mass", forces.virtual_mass);
    law("shear_lift", forces.shear_lift);
    law("spin_lift", forces.spin_lift);
    law("torque", forces.torque);
    forces.history = static_cast<int>(file.integer("gas.history", 0, "steps of Basset's window; 0: off", 0, 100000));
    forces.polydisperse = file.boolean("gas.polydisperse", false, "drag of each size of a mixture");
    forces.filtered = file.boolean("gas.filtered", false, "drag of cells wider than clusters");
}
}

FlowCase read_flow(io::CaseFile& file, std::string const& key, GasCase const& gas, double temperature)
{
    FlowCase flow;
    flow.temperature = temperature;
    auto const volume =
        file.optional_quantity(key + "flow", Dimension::volume_flow, "volume flow at flow_reference", io::positive);
    auto const mass =
        file.optional_quantity(key + "dry_mass_flow", Dimension::mass_flow, "kg of dry air", io::positive);
    auto const velocity =
        file.optional_quantity(key + "velocity", Dimension::velocity, "superficial where it enters", io::not_negative);
    file.know(key + "flow_reference");
    auto const at = file.optional_quantity(key + "flow_reference.temperature", Dimension::temperature,
                                           "of the state that the volume flow is stated at", io::positive);
    auto const density = file.optional_quantity(key + "flow_reference.dry_density", Dimension::density,
                                                "kg of dry air per m3 in that state", io::positive);
    read_humidity(file, key, gas, flow);
    int const ways = file.has(key + "flow") + file.has(key + "dry_mass_flow") + file.has(key + "velocity");
    auto const section = key.substr(0, key.size() - 1);
    if (ways != 1) {
        file.mistake(
            section, ways == 0 ? "needs a flow" : "has more than one flow",
            {fmt::format("give exactly one of {0}flow (with {0}flow_reference), {0}dry_mass_flow, {0}velocity", key)});
        return flow;
    }
    flow.velocity = velocity.value_or(-1);
    if (mass) flow.dry_mass_flow = *mass;
    if (!volume) return flow;
    if (!at && !density) {
        if (!file.wrong(key + "flow_reference.temperature") && !file.wrong(key + "flow_reference.dry_density"))
            file.mistake(key + "flow", "is a volume flow: the temperature and density it is stated at must be known",
                         {"add flow_reference = { temperature = \"20 degC\", dry_density = \"1.2 kg/m3\" }"});
        return flow;
    }
    double const reference = density.value_or(material::density(math::standard_pressure, at.value_or(293.15), 0));
    flow.dry_mass_flow = *volume * reference;
    file.derived(key + "dry_mass_flow", io::write_quantity(flow.dry_mass_flow, Dimension::mass_flow), "kg of dry air");
    return flow;
}

void read_gas(io::CaseFile& file, Case& data, Purpose purpose)
{
    GasCase& gas = data.gas;
    gas.present = file.has("gas");
    if (!gas.present) {
        for (auto const* of_gas : {"inlet", "outlet"})
            if (file.has(of_gas)) file.mistake(of_gas, "belongs to a case with [gas]");
        if (purpose == Purpose::balance) file.mistake("gas", "is missing: a balance needs the inlet air");
        return;
    }
    gas.pressure =
        file.quantity("gas.pressure", Dimension::pressure, gas.pressure, "at the outlet", {.low = 1e3, .high = 1e7});
    read_properties(file, gas);
    gas.model =
        file.name("gas.model", gas.model, "who has the pressure gradient and the stress", {"A", "B"}, "a model");
    gas.convection = file.name("gas.convection", gas.convection, "of momentum, heat and vapour",
                               {"second-order", "upwind"}, "a scheme");
    gas.push = file.vector("gas.push", Dimension::pressure_gradient, Vec3{}, "force on the gas per volume");
    gas.closed = file.boolean("gas.closed", false, "no inlet and no outlet");
    bool const told = file.has("inlet") || file.has("outlet");
    bool const constant = gas.density.has_value() || gas.closed || told;
    gas.inlet.temperature = file.quantity(
        "gas.temperature", Dimension::temperature, constant ? std::optional(293.15) : std::nullopt,
        told ? "at the start, and of inlets that say nothing else" : "of the inlet air", {.low = 200, .high = 1000});
    if (std::isnan(gas.inlet.temperature))
        gas.inlet.temperature = 293.15;  // already reported; what follows stays finite
    if (gas.closed || told) {
        for (auto const* flow : {"gas.flow", "gas.dry_mass_flow", "gas.velocity"})
            if (file.has(flow))
                file.mistake(flow, gas.closed ? "contradicts gas.closed = true" : "belongs into [[inlet]] here");
        if (file.has("gas.humidity") || file.has("gas.relative_humidity"))
            read_humidity(file, "gas.", gas, gas.inlet);
        else
            gas.inlet.humidity = 0, file.know("gas.humidity"), file.know("gas.relative_humidity");
        for (auto const* key : {"flow", "dry_mass_flow", "velocity", "flow_reference"})
            file.know(std::string("gas.") + key);
    } else {
        gas.inlet = read_flow(file, "gas.", gas, gas.inlet.temperature);
    }
    gas.drag = file.name("gas.drag", gas.drag, "law", laws_for("gas.drag"), "a drag law");
    gas.heat_transfer =
        file.name("gas.heat_transfer", gas.heat_transfer, "law", laws_for("gas.heat_transfer"), "a heat transfer law");
    read_forces(file, gas.forces);
    read_turbulence(file, gas);
    gas.mapping =
        file.name("gas.mapping", gas.mapping, "of granules to cells", {"kernel", "centre", "divided"}, "a way");
    gas.smoothing = file.optional_quantity("gas.smoothing", Dimension::length,
                                           "bandwidth of what granules and gas share; 0 mm: off", io::not_negative);
    gas.rebalance_every =
        file.integer("gas.rebalance_every", 0, "gas steps between shares of space among ranks; 0: where work is uneven",
                     0, 1000000000);
    gas.tolerance =
        file.quantity("gas.tolerance", Dimension::one, gas.tolerance,
                      "of the pressure's equation, relative to its right side", {.low = 1e-13, .high = 1e-2});
    gas.pressure_solver = file.name("gas.pressure_solver", gas.pressure_solver, "preconditioner of conjugate gradients",
                                    {"multigrid", "pfmg", "smg", "diagonal"}, "a pressure solver");
    gas.initial_velocity =
        file.vector("gas.initial_velocity", Dimension::velocity, math::Vec3{}, "of the gas at the start");
}

void read_cells(io::CaseFile& file, Case& data)
{
    if (!data.gas.present) return;
    GasCase& gas = data.gas;
    auto const cells = file.integers("gas.cells", 3, "of the gas, along x, y and z", 1, 4096);
    auto const size = file.optional_quantity("gas.cell_size", Dimension::length, "edge of a gas cell, instead of cells",
                                             io::positive);
    if (file.has("gas.cells") && file.has("gas.cell_size"))
        file.mistake("gas.cell_size", "and gas.cells cannot both be given");
    for (int i = 0; i < file.count("gas.fine"); ++i) {
        auto const key = fmt::format("gas.fine[{}].", i);
        FineCase fine;
        auto const axis =
            file.name(key + "axis", std::nullopt, "along which cells are fine", {"x", "y", "z"}, "an axis");
        if (!axis.empty()) fine.axis = static_cast<std::size_t>(axis[0] - 'x');
        fine.lower = file.quantity(key + "lower", Dimension::length, std::nullopt, "where they begin");
        fine.upper = file.quantity(key + "upper", Dimension::length, std::nullopt, "where they end");
        fine.size = file.quantity(key + "cell_size", Dimension::length, std::nullopt, "between", io::positive);
        fine.growth = file.quantity(key + "growth", Dimension::one, fine.growth, "ratio of neighbours beyond",
                                    {.low = 1.01, .high = 2});
        if (fine.lower >= fine.upper) file.mistake(key + "upper", "is not beyond lower");
        if (std::isfinite(fine.lower + fine.upper + fine.size)) gas.fine.push_back(fine);
    }
    if (!file.has("apparatus") || file.wrong("apparatus.shape") || file.wrong("apparatus.profile") ||
        file.wrong("apparatus.size") || !data.chamber.known())
        return;
    auto const low = data.chamber.lower(), high = data.chamber.upper(), extent = high - low;
    if (!cells.empty()) {
        for (std::size_t i = 0; i < 3; ++i) gas.cells[i] = static_cast<int>(cells[i]);
    } else {
        // Three parcels wide where nothing is said: wide enough for a smooth voidage, narrow enough to see bubbles.
        double const parcel = data.granules.diameter * data.granules.parcel_ratio;
        double const edge = size.value_or(data.granules.parcels > 0 ? 3 * parcel : extent.x / 16);
        if (!(edge > 0)) return;
        for (std::size_t i = 0; i < 3; ++i)
            gas.cells[i] = static_cast<int>(std::clamp(std::round(extent[i] / edge), 1.0, 4096.0));
    }
    for (std::size_t d = 0; d < 3; ++d) {
        std::vector<grid::Fine> fine;
        for (auto const& one : gas.fine)
            if (one.axis == d) fine.push_back({one.lower, one.upper, one.size, one.growth});
        if (fine.empty()) continue;
        if (data.periodic[d]) file.mistake("gas.fine", "does not go with a direction that repeats itself");
        gas.faces[d] = grid::stretched(low[d], high[d], extent[d] / gas.cells[d], fine);
        gas.cells[d] = static_cast<int>(gas.faces[d].size()) - 1;
    }
    if (cells.empty() || !gas.fine.empty())
        file.derived("gas.cells", fmt::format("[{}, {}, {}]", gas.cells[0], gas.cells[1], gas.cells[2]),
                     "of the gas, along x, y and z");
    double const total = 1.0 * gas.cells[0] * gas.cells[1] * gas.cells[2];
    if (total > 5e7)
        file.mistake(size ? "gas.cell_size" : "gas.cells", fmt::format("makes {:.3g} cells", total),
                     {"allowed: up to 5e+07"});
}
}
