// Row P32: two units of a granulator side by side in one box, each with its own granules, air and nozzle, let their
// deposits dry as one unit does. A wall stands between them up to the freeboard.
#include "granum/map/run_deposits.hpp"
#include "scene/program.hpp"
#include "scene/temporary_folder.hpp"
#include "verify/table.hpp"

#include <cmath>

namespace
{
using namespace granum;

constexpr double width = 60, wall = 7.5;  // mm: cells are as wide as the wall

std::string units(int count)
{
    double const all = count * width + (count - 1) * wall;
    std::string text = fmt::format(R"(seed = {0}
[apparatus]
shape = "box"
size = ["{1} mm", "60 mm", "300 mm"]
[gas]
velocity = "1.3 m/s"
temperature = "80 degC"
humidity = "8 g/kg"
cells = [{2}, 8, 40]
heat_transfer = "gunn"
[granules]
diameter = "0.6 mm"
density = "1445 kg/m3"
mass = "{3} kg"
parcels = {4}
start = "loose"
[contact]
youngs_modulus = "10 MPa"
restitution = 0.8
sliding_friction = 0.3
rolling_friction = 0.01
[spray]
liquid = "sodium-benzoate-30"
rate = "{5} kg/h"
solids_fraction = "30 %"
temperature = "25 degC"
droplet_median = "40 um"
droplet_spread = 1.6
[time]
duration = "5 s"
[output]
interval = "5 s"
)",
                                   count, all, std::lround(all / wall), 0.12 * count, 2000 * count, 0.15 * count);
    for (int k = 0; k < count; ++k)
        text += fmt::format(R"([[nozzle]]
position = ["{} mm", "30 mm", "150 mm"]
direction = [0, 0, -1]
half_angle = "15 deg"
air = "0.15 kg/h"
air_temperature = "20 degC"
air_velocity = "250 m/s"
droplet_velocity = "30 m/s"
)",
                            k * (width + wall) + width / 2);
    for (int k = 1; k < count; ++k)
        text += fmt::format(R"([[internal]]
shape = "box"
lower = ["{} mm", "0 mm", "0 mm"]
upper = ["{} mm", "60 mm", "270 mm"]
)",
                            k * (width + wall) - wall, k * (width + wall));
    return text;
}

TEST(TwoUnits, in_one_box_are_two_of_one)
{
    scene::TemporaryFolder const folder;
    std::array<map::RunDeposits, 2> runs;
    for (int count : {1, 2}) {
        auto const name = folder / fmt::format("{}", count);
        std::ofstream(name + ".toml") << units(count);
        scene::Program program({"run", name + ".toml", "-n", "1", "-o", name, "--quiet"}, name + ".said");
        ASSERT_EQ(program.wait(), 0) << program.errors();
        runs[static_cast<std::size_t>(count - 1)] = map::read_deposits(name);
    }
    auto const compare = [&](std::string const& column, std::string const& words, double largest_error) {
        bool const log = column == "drying_time";
        map::Mean const one = map::mean_of(runs[0].deposits, column, log),
                        two = map::mean_of(runs[1].deposits, column, log);
        EXPECT_LT(one.error, largest_error) << words;
        EXPECT_LT(two.error, largest_error) << words;
        verify::absolute("P32", words + " of two units in one box against one, within three standard errors", one.value,
                         two.value, 3 * std::hypot(one.error, two.error));
    };
    compare("drying_time", "mean of log10 of the drying time, s,", 0.02);
    compare("moisture_at_impact", "moisture at impact, kg/kg,", 0.05);
    compare("mean_drying_potential", "local drying potential, mean while drying,", 0.02);
}
}
