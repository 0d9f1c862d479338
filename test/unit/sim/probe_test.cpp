// Probes read the gas between the middles of its cells, and what they were told wrongly is said.
#include "granum/sim/probe_output.hpp"

#include "granum/base/error.hpp"
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum;

std::string column(std::string const& probes, std::string const& cells = "[4, 4, 10]")
{
    return R"(
[apparatus]
shape = "box"
size = ["40 mm", "40 mm", "200 mm"]
[gas]
velocity = "0.5 m/s"
temperature = "60 degC"
humidity = "8 g/kg"
density = "1.2 kg/m3"
viscosity = "1.8e-5 Pa.s"
cells = )" +
           cells +
           R"(
[granules]
diameter = "1 mm"
density = "1000 kg/m3"
number = 20
start = "loose"
[contact]
youngs_modulus = "10 MPa"
[start]
quasi_steady = false
[time]
duration = "1 ms"
)" + probes;
}

TEST(Probe, of_gas_at_rest_in_itself_reads_its_weight_between_the_cells)
{
    auto const simulation = scene::simulation_of(column(R"(
[[output.probe]]
name = "up"
from = ["20 mm", "20 mm", "150 mm"]
to = ["20 mm", "20 mm", "190 mm"]
points = 5
[[output.probe]]
position = ["3 mm", "37 mm", "163 mm"]
)"));
    auto const readings = sim::probe_readings(*simulation);
    ASSERT_EQ(readings.size(), 6U);
    for (auto const& reading : readings) {
        EXPECT_NEAR(reading.temperature, 333.15, 1e-9);
        EXPECT_NEAR(reading.humidity, 0.008, 1e-12);
        EXPECT_NEAR(reading.voidage, 1, 1e-3);
    }
    // At the start the gas hangs in its own weight: between any two places the pressure differs by density times g.
    for (std::size_t k = 1; k < 5; ++k)
        EXPECT_NEAR(readings[k].pressure - readings[k - 1].pressure, -1.2 * 9.81 * 0.01, 1e-6);
    EXPECT_NEAR(readings[5].pressure - readings[0].pressure, -1.2 * 9.81 * 0.013, 1e-6);
}

std::string mistake(std::string const& text)
{
    try {
        scene::case_of(text);
    } catch (base::CaseError const& error) {
        return error.what();
    }
    return "";
}

TEST(Probe, wrongly_placed_or_told_is_a_mistake)
{
    EXPECT_NE(
        mistake(column("[[output.probe]]\nposition = [\"20 mm\", \"20 mm\", \"-1 mm\"]\n")).find("outside the chamber"),
        std::string::npos);
    EXPECT_NE(
        mistake(column("[[output.probe]]\nfrom = [\"20 mm\", \"20 mm\", \"1 mm\"]\nto = [\"20 mm\", \"20 mm\", \"201 "
                       "mm\"]\npoints = 3\n"))
            .find("point 2 of the line"),
        std::string::npos);
    EXPECT_NE(mistake(column("[[output.probe]]\nposition = [\"20 mm\", \"20 mm\", \"1 mm\"]\npoints = 3\n"))
                  .find("belongs to a line"),
              std::string::npos);
    EXPECT_NE(mistake(column("[[output.probe]]\nname = \"a,b\"\nposition = [\"20 mm\", \"20 mm\", \"1 mm\"]\n"))
                  .find("cannot head a column"),
              std::string::npos);
}
}
