// Reads [gas] with its cells.
#include "granum/sim/balance.hpp"
#include "granum/sim/case_sections.hpp"
#include "granum/sim/law_families.hpp"

#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::sim
{
using io::Dimension;

namespace
{
//! Exactly one of the ways to say how much gas enters; a volume flow only with the state it is stated at.
void read_flow(io::CaseFile& file, GasCase& gas)
{
    auto const volume =
        file.optional_quantity("gas.flow", Dimension::volume_flow, "volume flow at flow_reference", io::positive);
    auto const mass = file.optional_quantity("gas.dry_mass_flow", Dimension::mass_flow, "kg of dry air", io::positive);
    auto const velocity =
        file.optional_quantity("gas.velocity", Dimension::velocity, "superficial at the plate", io::not_negative);
    file.know("gas.flow_reference");
    auto const at = file.optional_quantity("gas.flow_reference.temperature", Dimension::temperature,
                                           "of the state that the volume flow is stated at", io::positive);
    auto const density = file.optional_quantity("gas.flow_reference.dry_density", Dimension::density,
                                                "kg of dry air per m3 in that state", io::positive);
    int const ways = file.has("gas.flow") + file.has("gas.dry_mass_flow") + file.has("gas.velocity");
    if (gas.closed) {
        if (ways > 0) file.mistake("gas.closed", "contradicts a flow through the plate");
        return;
    }
    if (ways != 1) {
        file.mistake("gas", ways == 0 ? "needs a flow" : "has more than one flow",
                     {"give exactly one of gas.flow (with gas.flow_reference), gas.dry_mass_flow, gas.velocity"});
        return;
    }
    gas.inlet.velocity = velocity.value_or(-1);
    if (mass) gas.inlet.dry_mass_flow = *mass;
    if (!volume) return;
    if (!at && !density) {
        if (!file.wrong("gas.flow_reference.temperature") && !file.wrong("gas.flow_reference.dry_density"))
            file.mistake("gas.flow", "is a volume flow: the temperature and density it is stated at must be known",
                         {"add flow_reference = { temperature = \"20 degC\", dry_density = \"1.2 kg/m3\" }"});
        return;
    }
    double const reference = density.value_or(material::density(math::standard_pressure, at.value_or(293.15), 0));
    gas.inlet.dry_mass_flow = *volume * reference;
    file.derived("gas.dry_mass_flow", io::write_quantity(gas.inlet.dry_mass_flow, Dimension::mass_flow),
                 "kg of dry air");
}

void read_humidity(io::CaseFile& file, GasCase& gas)
{
    auto const humidity =
        file.optional_quantity("gas.humidity", Dimension::one, "kg water per kg dry air", io::not_negative);
    auto const relative =
        file.optional_quantity("gas.relative_humidity", Dimension::one, "of the inlet air", io::zero_to_one);
    if (file.has("gas.humidity") && file.has("gas.relative_humidity"))
        file.mistake("gas.relative_humidity", "and gas.humidity cannot both be given");
    double const saturated = material::saturation_humidity(gas.inlet.temperature, gas.pressure);
    if (humidity) {
        gas.inlet.humidity = *humidity;
        if (*humidity > saturated)
            file.mistake("gas.humidity",
                         fmt::format("is above saturation at {}",
                                     io::write_quantity(gas.inlet.temperature, Dimension::temperature)),
                         {fmt::format("allowed: 0 to {:.4g} g/kg", 1000 * saturated)});
    } else if (relative) {
        double const vapour = *relative * material::saturation_pressure(gas.inlet.temperature);
        gas.inlet.humidity = vapour < gas.pressure ? material::molar_ratio * vapour / (gas.pressure - vapour) : 0;
        if (vapour >= gas.pressure)
            file.mistake("gas.relative_humidity", "cannot be reached: water boils at this temperature");
        file.derived("gas.humidity", fmt::format("{:.6g}", gas.inlet.humidity), "kg water per kg dry air");
    } else if (!gas.density && !file.wrong("gas.humidity") && !file.wrong("gas.relative_humidity")) {
        file.mistake("gas", "needs the humidity of the air",
                     {"e.g. humidity = \"8 g/kg\" or relative_humidity = \"30 %\""});
    }
}
}

void read_gas(io::CaseFile& file, Case& data, Purpose purpose)
{
    GasCase& gas = data.gas;
    gas.present = file.has("gas");
    if (!gas.present) {
        if (purpose == Purpose::balance) file.mistake("gas", "is missing: a balance needs the inlet air");
        return;
    }
    gas.pressure =
        file.quantity("gas.pressure", Dimension::pressure, gas.pressure, "at the outlet", {.low = 1e4, .high = 1e6});
    gas.density =
        file.optional_quantity("gas.density", Dimension::density, "constant, instead of moist air", io::positive);
    gas.viscosity =
        file.optional_quantity("gas.viscosity", Dimension::viscosity, "constant, instead of moist air", io::positive);
    gas.conductivity = file.optional_quantity("gas.conductivity", Dimension::conductivity,
                                              "constant, instead of moist air", io::positive);
    gas.closed = file.boolean("gas.closed", false, "no inlet and no outlet");
    bool const constant = gas.density.has_value() || gas.closed;
    gas.inlet.temperature =
        file.quantity("gas.temperature", Dimension::temperature, constant ? std::optional(293.15) : std::nullopt,
                      "of the inlet air", {.low = 233.15, .high = 473.15});
    if (std::isnan(gas.inlet.temperature))
        gas.inlet.temperature = 293.15;  // already reported; what follows stays finite
    read_flow(file, gas);
    if (gas.closed && !file.has("gas.humidity") && !file.has("gas.relative_humidity"))
        gas.inlet.humidity = 0;
    else
        read_humidity(file, gas);
    gas.drag = file.name("gas.drag", gas.drag, "law", laws_for("gas.drag"), "a drag law");
    gas.heat_transfer =
        file.name("gas.heat_transfer", gas.heat_transfer, "law", laws_for("gas.heat_transfer"), "a heat transfer law");
    gas.smoothing = file.quantity("gas.smoothing", Dimension::length, 0.0,
                                  "bandwidth of the smoothing of the voidage; 0 mm: off", io::not_negative);
    gas.initial_velocity =
        file.vector("gas.initial_velocity", Dimension::velocity, math::Vec3{}, "of the gas at the start");
}

void read_cells(io::CaseFile& file, Case& data)
{
    if (!data.gas.present) return;
    auto const cells = file.integers("gas.cells", 3, "of the gas, along x, y and z", 1, 4096);
    auto const size = file.optional_quantity("gas.cell_size", Dimension::length, "edge of a gas cell, instead of cells",
                                             io::positive);
    if (file.has("gas.cells") && file.has("gas.cell_size"))
        file.mistake("gas.cell_size", "and gas.cells cannot both be given");
    if (!file.has("apparatus") || file.wrong("apparatus.shape") || file.wrong("apparatus.profile") ||
        file.wrong("apparatus.size"))
        return;
    if (!cells.empty()) {
        for (std::size_t i = 0; i < 3; ++i) data.gas.cells[i] = static_cast<int>(cells[i]);
    } else {
        // Three parcels wide where nothing is said: wide enough for a smooth voidage, narrow enough to see bubbles.
        auto const extent = data.chamber.upper() - data.chamber.lower();
        double const parcel = data.granules.diameter * data.granules.parcel_ratio;
        double const edge = size.value_or(data.granules.parcels > 0 ? 3 * parcel : extent.x / 16);
        if (!(edge > 0)) return;
        for (std::size_t i = 0; i < 3; ++i)
            data.gas.cells[i] = static_cast<int>(std::clamp(std::round(extent[i] / edge), 1.0, 4096.0));
        file.derived("gas.cells", fmt::format("[{}, {}, {}]", data.gas.cells[0], data.gas.cells[1], data.gas.cells[2]),
                     "of the gas, along x, y and z");
    }
    double const total = 1.0 * data.gas.cells[0] * data.gas.cells[1] * data.gas.cells[2];
    if (total > 5e7)
        file.mistake(size ? "gas.cell_size" : "gas.cells", fmt::format("makes {:.3g} cells", total),
                     {"allowed: up to 5e+07"});
}
}
