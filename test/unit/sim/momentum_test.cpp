// What granules get from the gas the gas loses, whichever forces act between them.
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;

struct Forces
{
    char const *name, *keys;
};

//! Granules of two sizes that fly and collide in a box of gas that repeats itself, without weight.
std::string box_with(std::string const& keys)
{
    std::string text = R"(
gravity = ["0 m/s2", "0 m/s2", "0 m/s2"]
[apparatus]
shape = "box"
size = ["20 mm", "16 mm", "24 mm"]
periodic = ["x", "y", "z"]
[gas]
closed = true
cells = [5, 4, 6]
temperature = "293.15 K"
initial_velocity = ["1 m/s", "-0.5 m/s", "2 m/s"]
)" + keys + R"(
[granules]
diameter = "1.5 mm"
density = "150 kg/m3"
emissivity = 0.5
[contact]
youngs_modulus = "1 MPa"
[time]
duration = "1 s"
)";
    int number = 0;
    for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 5; ++i, ++number)
                text += scene::granule_text(
                    {.position = {0.004 * (i + 0.5), 0.004 * (j + 0.5), 0.004 * (k + 0.5)},
                     .velocity = {3 * std::sin(number), 4 * std::cos(3 * number), 2 * std::sin(7 * number + 1)},
                     .spin = {300 * std::cos(number), 200 * std::sin(2 * number), -400 * std::sin(5 * number)},
                     .diameter = number % 3 == 0 ? 2e-3 : 1.5e-3});
    return text;
}

math::Vec3 momentum(sim::Simulation& simulation)
{
    auto const& granules = simulation.granules();
    math::Vec3 sum = simulation.solver().momentum(simulation.gas());
    for (std::size_t row = 0; row < granules.owned; ++row)
        sum += granules.mass[row] * granules.velocity[row] - simulation.exchange().debt(granules, row);
    return sum;
}

class Momentum : public testing::TestWithParam<Forces>
{
};

TEST_P(Momentum, of_gas_and_granules_together_stays)
{
    auto const simulation = scene::simulation_of(box_with(GetParam().keys));
    double scale = 0;
    auto const& granules = simulation->granules();
    simulation->step(1e9);  // from here on the gas has the mass of the middle of a step
    double const dt = simulation->time();
    auto const before = momentum(*simulation);
    for (std::size_t row = 0; row < granules.owned; ++row)
        scale += granules.mass[row] * math::norm(granules.velocity[row]);
    double moved = 0;
    auto const v = granules.velocity[0];
    for (int step = 0; step < 60; ++step) simulation->step(dt);
    moved = math::norm(granules.velocity[0] - v);
    EXPECT_GT(moved, 0.05) << "nothing happens here";
    EXPECT_GT(simulation->mover().watch().largest_overlap, 0) << "granules are to touch meanwhile";
    auto const after = momentum(*simulation);
    for (std::size_t d = 0; d < 3; ++d) EXPECT_LT(std::abs(after[d] - before[d]), 1e-10 * scale) << "along " << d;
}

std::string const all_forces = R"(virtual_mass = "zuber"
history = 10
shear_lift = "saffman-mei"
spin_lift = "loth-dorgan"
torque = "dennis"
polydisperse = true
)";
INSTANTIATE_TEST_SUITE_P(
    Forces, Momentum,
    testing::Values(
        Forces{"drag", ""}, Forces{"model_b", "model = \"B\""}, Forces{"smoothed", "smoothing = \"5 mm\""},
        Forces{"unsmoothed", "smoothing = \"0 mm\""}, Forces{"centre", "mapping = \"centre\""},
        Forces{"divided", "mapping = \"divided\""}, Forces{"virtual_mass", "virtual_mass = \"constant\""},
        Forces{"history", "history = 10"}, Forces{"shear_lift", "shear_lift = \"saffman-mei\""},
        Forces{"spin_lift", "spin_lift = \"rubinow-keller\""}, Forces{"torque", "torque = \"dennis\""},
        Forces{"polydisperse", "polydisperse = true"}, Forces{"filtered", "filtered = true"},
        Forces{"all", all_forces.c_str()},
        Forces{"all_full",
               "virtual_mass = \"zuber\"\nhistory = 10\nshear_lift = \"saffman-mei\"\ncompressibility = \"full\""}),
    [](auto const& param) { return param.param.name; });
}
