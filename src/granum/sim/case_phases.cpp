// Reads [[phase]], the operating programme.
#include "granum/sim/case_sections.hpp"

namespace granum::sim
{
using io::Dimension;

void read_phases(io::CaseFile& file, Case& data)
{
    int const count = file.count("phase");
    double start = 0;
    for (int k = 0; k < count; ++k) {
        auto const key = fmt::format("phase[{}].", k);
        PhaseCase phase;
        phase.name = file.words(key + "name", fmt::format("phase {}", k + 1), "for people");
        double const length =
            file.quantity(key + "duration", Dimension::time, std::nullopt, "of the phase", io::positive);
        phase.start = start, phase.end = start += length;
        phase.ramp = file.boolean(key + "ramp", false, "reach the values in a straight line, not at once");
        phase.gas_temperature = file.optional_quantity(key + "gas_temperature", Dimension::temperature, "of all inlets",
                                                       {.low = 200, .high = 1000});
        phase.gas_humidity = file.optional_quantity(key + "gas_humidity", Dimension::one,
                                                    "kg water per kg dry air, of all inlets", io::not_negative);
        phase.gas_share = file.optional_quantity(key + "gas_share", Dimension::one, "of the flow that the case states",
                                                 {.low = 0, .high = 10, .low_allowed = false});
        phase.spray_rate = file.optional_quantity(key + "spray_rate", Dimension::mass_flow, "of all nozzles together",
                                                  io::not_negative);
        if (!data.gas.present || data.gas.inlets.empty())
            for (auto const* name : {"gas_temperature", "gas_humidity", "gas_share"})
                if (file.has(key + name)) file.mistake(key + name, "has no meaning without an inlet of gas");
        if (!data.spray.present && file.has(key + "spray_rate"))
            file.mistake(key + "spray_rate", "has no meaning without [spray]");
        if (!phase.gas_temperature && !phase.gas_humidity && !phase.gas_share && !phase.spray_rate && phase.ramp)
            file.mistake(key + "ramp", "has nothing to ramp", {"give what the phase reaches, e.g. gas_temperature"});
        data.phases.push_back(std::move(phase));
    }
}
}
