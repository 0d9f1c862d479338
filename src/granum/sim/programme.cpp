#include "granum/sim/programme.hpp"

#include <utility>

namespace granum::sim
{
bool follow(Case& data, Nominal const& nominal, double time)
{
    bool changed = false;
    auto const set = [&](double& value, double now) { changed = std::exchange(value, now) != now || changed; };
    std::span<PhaseCase const> const phases(data.phases);
    double const share = value_at(phases, time, 1, [](auto const& p) { return p.gas_share; });
    for (std::size_t k = 0; k < data.gas.inlets.size(); ++k) {
        auto const& from = nominal.inlets[k];
        auto& inlet = data.gas.inlets[k];
        set(inlet.temperature,
            value_at(phases, time, from.temperature, [](auto const& p) { return p.gas_temperature; }));
        set(inlet.humidity, value_at(phases, time, from.humidity, [](auto const& p) { return p.gas_humidity; }));
        set(inlet.dry_mass_flow, share * from.dry_mass_flow);
        if (from.velocity > 0) set(inlet.velocity, share * from.velocity);
    }
    set(data.spray.rate, value_at(phases, time, nominal.spray_rate, [](auto const& p) { return p.spray_rate; }));
    return changed;
}
}
