// granum balance CASE: wet bulb, outlet state and drying potential of the whole apparatus, instantly.
#include "verbs.hpp"

#include "granum/sim/balance.hpp"
#include "granum/sim/case_reader.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace granum::app
{
namespace
{
void print_json(sim::Balance const& b)
{
    nlohmann::ordered_json const out{{"eta", b.eta},
                                     {"outlet_humidity", b.outlet_humidity},
                                     {"outlet_temperature_K", b.outlet_temperature},
                                     {"wet_bulb_K", b.wet_bulb},
                                     {"wet_bulb_humidity", b.wet_bulb_humidity},
                                     {"outlet_relative_humidity", b.outlet_relative_humidity},
                                     {"inlet_temperature_K", b.inlet_temperature},
                                     {"inlet_humidity", b.inlet_humidity},
                                     {"dry_mass_flow_kg_s", b.dry_mass_flow},
                                     {"water_rate_kg_s", b.water_rate}};
    fmt::print("{}\n", out.dump(2));
}

void print_text(sim::Balance const& b)
{
    auto const celsius = [](double kelvin) { return kelvin - 273.15; };
    fmt::print("air        {:8.2f} kg/h dry, {:.2f} degC, {:.3f} g/kg (atomising air included)\n",
               3600 * b.dry_mass_flow, celsius(b.inlet_temperature), 1e3 * b.inlet_humidity);
    fmt::print("water      {:8.4f} kg/h sprayed\n", 3600 * b.water_rate);
    fmt::print("wet bulb   {:8.2f} degC, {:.3f} g/kg\n", celsius(b.wet_bulb), 1e3 * b.wet_bulb_humidity);
    fmt::print("outlet     {:8.2f} degC, {:.3f} g/kg, {:.1f} % relative humidity\n", celsius(b.outlet_temperature),
               1e3 * b.outlet_humidity, 100 * b.outlet_relative_humidity);
    fmt::print("eta        {:8.4f} drying potential left at the outlet (1 dry, 0 saturated)\n", b.eta);
    if (b.overwetted()) fmt::print("the air cannot take up this water: the bed over-wets\n");
}
}

void add_balance(CLI::App& program, Action& action)
{
    auto* verb = program.add_subcommand("balance", "steady heat and water balance of the whole apparatus");
    auto path = std::make_shared<std::string>();
    auto json = std::make_shared<bool>(false);
    verb->add_option("CASE", *path, "case file; [gas] and [spray] are enough")->required();
    verb->add_flag("--json", *json, "print JSON, in SI units");
    verb->callback([path, json, &action] {
        action = [path, json] {
            auto const result = sim::balance(sim::read_case(*path, sim::Purpose::balance).data);
            *json ? print_json(result) : print_text(result);
            return 0;
        };
    });
}
}
