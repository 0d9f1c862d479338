// The steady balance against worked examples and an independent table.
#include "granum/sim/balance.hpp"

#include "granum/material/moist_air.hpp"
#include "granum/sim/case_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>

namespace granum::sim
{
namespace
{
struct Worked
{
    int number;
    double eta, wet_bulb, wet_bulb_humidity, outlet_humidity, outlet, outlet_rh;  //!< degC
};

Case lab()
{
    return read_case(GRANUM_SOURCE_DIR "/examples/balance/1.toml", Purpose::balance).data;
}
}

// Numbers worked out by hand and a second program: 80 degC and so on at 101325 Pa, liquid at 25 degC.
TEST(Balance, agrees_with_the_worked_examples)
{
    for (auto const& row : {Worked{1, 0.71749, 30.8663, 0.028649, 0.0138333, 65.610, 0.0857},
                            Worked{2, 0.43499, 30.8663, 0.028649, 0.0196667, 51.519, 0.2333},
                            Worked{3, 0.58389, 26.5031, 0.022019, 0.0138333, 45.820, 0.2203},
                            Worked{4, 0.79107, 30.3651, 0.027804, 0.0066000, 80.850, 0.0217}}) {
        auto const file = GRANUM_SOURCE_DIR "/examples/balance/" + std::to_string(row.number) + ".toml";
        auto const b = balance(read_case(file, Purpose::balance).data);
        EXPECT_NEAR(b.eta, row.eta, 1e-5) << file;
        EXPECT_NEAR(b.wet_bulb, row.wet_bulb + 273.15, 1e-3) << file;
        EXPECT_NEAR(b.wet_bulb_humidity, row.wet_bulb_humidity, 1e-6) << file;
        EXPECT_NEAR(b.outlet_humidity, row.outlet_humidity, 1e-7) << file;
        EXPECT_NEAR(b.outlet_temperature, row.outlet + 273.15, 1e-3) << file;
        EXPECT_NEAR(b.outlet_relative_humidity, row.outlet_rh, 1e-4) << file;
    }
}

// Reference case G-06 (test/reference/g-06.toml): adiabatic outlet of a spray bed.
TEST(Balance, agrees_with_the_reference_table_of_spray_beds)
{
    std::ifstream in(GRANUM_SOURCE_DIR "/test/reference/g-06.csv");
    int rows = 0;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || !std::isdigit(static_cast<unsigned char>(line[0]))) continue;
        std::array<double, 8> v{};
        std::istringstream cells(line);
        for (auto& value : v) {
            std::string cell;
            std::getline(cells, cell, ',');
            value = std::stod(cell);
        }
        Case data;
        data.gas.present = data.spray.present = true;
        data.gas.inlets.resize(1);
        static_cast<FlowCase&>(data.gas.inlets.front()) = {
            .dry_mass_flow = v[2], .velocity = -1, .temperature = v[0] + 273.15, .humidity = v[1]};
        data.spray.rate = v[3];
        data.spray.solids_fraction = 0;
        data.spray.temperature = v[4] + 273.15;
        auto const b = balance(data);
        EXPECT_NEAR(b.outlet_temperature - 273.15, v[5], 0.2) << line;
        EXPECT_NEAR(b.outlet_humidity, v[6], 1e-8) << line;
        EXPECT_NEAR(b.outlet_relative_humidity, v[7], 0.01 * v[7]) << line;
        ++rows;
    }
    EXPECT_EQ(rows, 4);
}

TEST(Balance, keeps_all_potential_without_spray_and_none_at_saturation)
{
    auto data = lab();
    data.spray.rate = 0;
    EXPECT_NEAR(balance(data).eta, 1, 1e-12);
    EXPECT_NEAR(balance(data).outlet_temperature, data.gas.inlets.front().temperature, 1e-9);
    auto const dry = balance(data);
    data.spray.rate =
        (dry.wet_bulb_humidity - dry.inlet_humidity) * dry.dry_mass_flow / (1 - data.spray.solids_fraction);
    data.spray.temperature = dry.wet_bulb;  // the liquid then neither warms nor cools the saturated air
    auto const wet = balance(data);
    EXPECT_NEAR(wet.eta, 0, 1e-9);
    EXPECT_NEAR(wet.outlet_temperature, wet.wet_bulb, 1e-6);
    EXPECT_NEAR(wet.outlet_relative_humidity, 1, 1e-7);
}

TEST(Balance, of_scaled_flows_is_the_same)
{
    auto data = lab();
    double const eta = balance(data).eta;
    data.gas.inlets.front().dry_mass_flow *= 8;
    data.spray.rate *= 8;
    EXPECT_NEAR(balance(data).eta, eta, 1e-12);
}

TEST(Balance, takes_atomising_air_as_a_second_inlet)
{
    auto data = lab();
    NozzleCase nozzle;
    nozzle.air_mass_flow = 1.2 / 3600;
    nozzle.air_temperature = data.gas.inlets.front().temperature;
    nozzle.air_humidity = data.gas.inlets.front().humidity;
    data.spray.nozzles = {nozzle};
    auto const same_air = balance(data);
    auto more = lab();
    more.gas.inlets.front().dry_mass_flow += nozzle.air_mass_flow;
    EXPECT_NEAR(same_air.eta, balance(more).eta, 1e-12) << "the same air through either inlet is the same";

    data.spray.nozzles[0].air_temperature = 293.15;
    data.spray.nozzles[0].air_humidity = 0;
    auto const cold = balance(data);
    EXPECT_LT(cold.inlet_temperature, data.gas.inlets.front().temperature);
    EXPECT_NEAR(cold.inlet_humidity * cold.dry_mass_flow,
                data.gas.inlets.front().dry_mass_flow * data.gas.inlets.front().humidity, 1e-15);
}

TEST(Balance, flags_over_wetting)
{
    auto data = lab();
    EXPECT_FALSE(balance(data).overwetted());
    data.spray.rate *= 4;
    EXPECT_TRUE(balance(data).overwetted());
    EXPECT_LT(balance(data).eta, 0);
}

// By hand: dry air of 0.0333333 kg/s enters with 30 degC and no vapour; 3.6 kg/h of melt bring 1500 x 140 + 224000 J/kg
// above 0 degC, and leave as solid as warm as the air.
TEST(Balance, of_a_melt_gives_its_heat_of_fusion_to_the_air)
{
    auto data = lab();
    data.gas.inlets.front().dry_mass_flow = 0.0333333, data.gas.inlets.front().humidity = 0;
    data.gas.inlets.front().velocity = 0, data.gas.inlets.front().temperature = 303.15;
    data.granules.heat_capacity = 1500;
    data.spray.nozzles.clear();
    data.spray.rate = 1e-3, data.spray.solids_fraction = 1, data.spray.temperature = 413.15;
    data.spray.melting_point = 405.85, data.spray.fusion_heat = 224e3;
    auto const b = balance(data);
    double const air = 0.0333333 * material::heat_capacity_air;
    EXPECT_NEAR(b.outlet_temperature - 273.15, (air * 30 + 1e-3 * (1500 * 140 + 224e3)) / (air + 1e-3 * 1500), 1e-9);
    EXPECT_EQ(b.outlet_humidity, 0);
    EXPECT_NEAR(b.eta, 1, 1e-12);
}
}
