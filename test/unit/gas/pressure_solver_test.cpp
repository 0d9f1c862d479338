// The choice of the pressure solver changes a flow by no more than its tolerance.
#include "unit/gas/chamber_with_gas.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace granum;
using gas::ChamberWithGas;

TEST(PressureSolver, any_of_them_gives_the_same_flow)
{
    auto const run = [](solve::Method method) {
        gas::Settings settings;
        settings.inlets = {gas::Inlet{.mass_flow = 0.04, .temperature = 353.15, .vapour_fraction = 0.008}};
        settings.tolerance = 1e-11;
        settings.pressure_solver = method;
        ChamberWithGas chamber(gas::laboratory_chamber(), {10, 10, 30}, {}, settings, 320, 0.01);
        for (int step = 0; step < 10; ++step) chamber.step(1e-3);
        return chamber.state.velocity[2];
    };
    auto const expected = run(solve::Method::diagonal);
    double fastest = 0;
    for (double const u : expected) fastest = std::max(fastest, std::abs(u));
    ASSERT_GT(fastest, 0.1);
    for (auto const method : {solve::Method::multigrid, solve::Method::pfmg, solve::Method::smg}) {
        auto const found = run(method);
        double worst = 0;
        for (std::size_t c = 0; c < found.size(); ++c) worst = std::max(worst, std::abs(found[c] - expected[c]));
        EXPECT_LT(worst, 1e-6 * fastest) << static_cast<int>(method);
    }
}
