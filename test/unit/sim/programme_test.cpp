// The operating programme: what is set when, and that gas and spray follow it with all ledgers closed.
#include "granum/sim/programme.hpp"

#include "granum/base/error.hpp"
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::sim;

std::string const box = R"([apparatus]
shape = "box"
size = ["60 mm", "60 mm", "80 mm"]
[gas]
velocity = "1 m/s"
temperature = "40 degC"
humidity = "8 g/kg"
cells = [3, 3, 4]
[granules]
diameter = "3 mm"
density = "1445 kg/m3"
number = 50
[contact]
youngs_modulus = "5 MPa"
[time]
duration = "1 s"
)";
std::string const spray = R"([spray]
liquid = "sodium-benzoate-30"
rate = "0.05 kg/h"
solids_fraction = "30 %"
parcels_per_second = "2000 1/s"
[[nozzle]]
position = ["30 mm", "30 mm", "60 mm"]
droplet_velocity = "5 m/s"
)";
std::string const phases = R"([[phase]]
name = "heat up"
duration = "0.1 s"
ramp = true
gas_temperature = "90 degC"
spray_rate = "0 kg/h"
[[phase]]
name = "spray"
duration = "0.1 s"
gas_share = 0.8
spray_rate = "0.1 kg/h"
[[phase]]
name = "cool"
duration = "0.1 s"
ramp = true
gas_temperature = "20 degC"
spray_rate = "0 kg/h"
)";

TEST(Programme, sets_at_once_or_along_a_ramp_and_keeps_what_is_not_named)
{
    auto data = scene::case_of(box + spray + phases);
    Nominal const nominal(data);
    auto const at = [&](double time) -> Case const& {
        follow(data, nominal, time);
        return data;
    };
    EXPECT_NEAR(at(0).gas.inlets[0].temperature, 313.15, 1e-9);
    EXPECT_NEAR(at(0.05).gas.inlets[0].temperature, 338.15, 1e-9);
    EXPECT_NEAR(at(0.05).spray.rate, 0.5 * 0.05 / 3600, 1e-15);
    EXPECT_NEAR(at(0.15).gas.inlets[0].temperature, 363.15, 1e-9);
    EXPECT_NEAR(at(0.15).gas.inlets[0].velocity, 0.8, 1e-12);
    EXPECT_NEAR(at(0.15).spray.rate, 0.1 / 3600, 1e-15);
    EXPECT_NEAR(at(0.25).gas.inlets[0].temperature, 328.15, 1e-9);
    EXPECT_NEAR(at(9).gas.inlets[0].temperature, 293.15, 1e-9);
    EXPECT_EQ(at(9).spray.rate, 0);
    EXPECT_FALSE(follow(data, nominal, 10)) << "nothing changes any more";
}

TEST(Programme, is_followed_by_gas_and_spray_and_all_ledgers_close)
{
    auto const simulation = scene::simulation_of(box + spray + phases);
    auto const to = [&](double end) {
        while (simulation->time() < end - 1e-9) simulation->step(end - simulation->time());
    };
    to(0.1);
    double const heated = simulation->readings().outlet_temperature;
    auto const sprayed = simulation->totals().solids;
    EXPECT_GT(sprayed, 0) << "the rate falls along the ramp";
    EXPECT_NEAR(sprayed, 0.3 * 0.5 * 0.05 / 3600 * 0.1, 0.02 * sprayed);
    to(0.2);
    EXPECT_GT(simulation->readings().outlet_temperature, heated);
    EXPECT_NEAR(simulation->totals().solids - sprayed, 0.3 * 0.1 / 3600 * 0.1, 0.02 * sprayed);
    to(0.35);
    EXPECT_LT(simulation->ledgers().solids.relative_error(), 1e-9);
    EXPECT_LT(simulation->ledgers().water.relative_error(), 1e-9);
    EXPECT_LT(simulation->ledgers().energy.relative_error(), 1e-6);
    EXPECT_NEAR(simulation->steady().inlet_temperature, 293.15, 0.5);
}

TEST(Programme, says_what_is_wrong_with_it)
{
    auto const mistakes = [](std::string const& text) -> std::string {
        try {
            scene::case_of(text);
        } catch (base::CaseError const& error) {
            return error.what();
        }
        return "";
    };
    auto const has = [](std::string const& text, char const* part) { return text.find(part) != std::string::npos; };
    EXPECT_EQ(mistakes(box + spray + phases), "");
    EXPECT_PRED2(has, mistakes(box + "[[phase]]\nduration = \"1 s\"\nspray_rate = \"1 kg/h\"\n"), "without [spray]");
    EXPECT_PRED2(has, mistakes(box + "[[phase]]\nspray = 1\n"), "phase[0].duration");
    EXPECT_PRED2(has, mistakes(box + "[[phase]]\nduration = \"1 s\"\nramp = true\n"), "nothing to ramp");
    EXPECT_PRED2(has, mistakes(box + "[[phase]]\nduration = \"1 s\"\ngas_share = 0\n"), "gas_share");
    EXPECT_PRED2(has, mistakes(box + spray + "[[phase]]\nduration = \"1 s\"\nspray_rate = \"5 kg/h\"\n"),
                 "than its air can dry");
}
}
