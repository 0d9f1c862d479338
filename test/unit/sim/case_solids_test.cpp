// Solids and bodies that a case states: what they become for gas and granules, where their walls are.
#include "granum/geometry/region.hpp"
#include "granum/sim/balance.hpp"
#include "granum/sim/build.hpp"
#include "granum/sim/wall_output.hpp"
#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::sim;

std::string const funnel = R"(
[apparatus]
shape = "solids"
[[apparatus.solid]]
name = "cone"
shape = "cone"
base = ["0 mm", "0 mm", "50 mm"]
length = "100 mm"
base_diameter = "60 mm"
top_diameter = "100 mm"
[[apparatus.solid]]
name = "column"
shape = "cylinder"
base = ["0 mm", "0 mm", "150 mm"]
length = "100 mm"
diameter = "100 mm"
[[apparatus.solid]]
name = "notch"
operation = "subtract"
shape = "box"
lower = ["30 mm", "-10 mm", "180 mm"]
upper = ["60 mm", "10 mm", "200 mm"]
)";
std::string const tube = R"(
[[internal]]
name = "tube"
material = "steel"
shape = "tube"
base = ["0 mm", "0 mm", "53 mm"]
length = "60 mm"
inner_diameter = "30 mm"
outer_diameter = "34 mm"
[material.steel]
density = "7800 kg/m3"
)";
std::string const granules = R"(
[granules]
diameter = "4 mm"
density = "1500 kg/m3"
number = 400
[time]
duration = "1 s"
)";

TEST(CaseSolids, stand_where_they_are_drawn)
{
    auto const data = scene::case_of(funnel + tube + granules);
    auto const& chamber = data.chamber;
    EXPECT_DOUBLE_EQ(chamber.bottom(), 0.05);
    EXPECT_DOUBLE_EQ(chamber.top(), 0.25);
    double const cone = math::pi * 0.1 / 3 * (9e-4 + 15e-4 + 25e-4), column = math::pi * 0.0025 * 0.1;
    double const ring = math::pi * (0.017 * 0.017 - 0.015 * 0.015) * 0.06;
    // The notch: 20 mm high and wide, from 30 mm to the wall at sqrt(50^2 - y^2) mm.
    double const notch = 0.02 * (2 * (0.5 * (0.01 * std::sqrt(0.0024) + 0.0025 * std::asin(0.2))) - 0.03 * 0.02);
    EXPECT_NEAR(chamber.volume() / (cone + column - ring - notch), 1, 2e-3);
    EXPECT_TRUE(chamber.inside({0, 0, 0.1}));
    EXPECT_FALSE(chamber.inside({0.016, 0, 0.1}));
    EXPECT_FALSE(chamber.inside({0.04, 0, 0.19}));
    ASSERT_EQ(data.bodies.size(), 2u);
    EXPECT_EQ(data.bodies[0].name, "cone") << "what is joined is drawn as one wall";
    EXPECT_EQ(data.bodies[1].name, "tube");
    EXPECT_EQ(data.bodies[0].material, 1u);
    EXPECT_EQ(data.contact.materials[data.bodies[1].material].name, "steel");
    EXPECT_FALSE(chamber_walls(data).faces.empty());
}

TEST(CaseSolids, keep_granules_in_the_open_where_they_start)
{
    for (auto const* start : {"loose", "settled", "lattice"}) {
        auto const simulation =
            scene::simulation_of(funnel + tube + "[granules]\nstart = \"" + start + "\"\n" + granules.substr(12));
        auto const& rows = simulation->granules();
        ASSERT_EQ(rows.owned, 400u);
        int in_tube = 0;
        for (std::size_t row = 0; row < rows.owned; ++row) {
            auto const& x = rows.position[row];
            double const r = std::hypot(x.x, x.y), give = start[0] == 's' ? 1e-4 : 1e-9,
                         radius = rows.radius[row] - give;
            bool const beside = x.z > 0.053 && x.z < 0.113;
            EXPECT_FALSE(beside && r > 0.015 - radius && r < 0.017 + radius) << start << " " << r << " " << x.z;
            in_tube += beside && r < 0.015;
            EXPECT_GT(x.z, 0.05 + radius) << start;
            // Distance from the flank of the cone.
            double const wall = (0.03 + 0.2 * (x.z - 0.05) - r) / std::sqrt(1.04);
            EXPECT_GT(wall, radius - 2e-5) << start << ": chords of its triangles lie inside by a little";
        }
        EXPECT_GT(in_tube, 3) << start;
    }
}

std::string const gas = R"(
[gas]
velocity = "1 m/s"
density = "1.2 kg/m3"
viscosity = "1.8e-5 Pa s"
humidity = "0 g/kg"
temperature = "20 degC"
cells = [10, 10, 20]
)";

TEST(CaseSolids, give_the_gas_its_plate_and_its_walls_their_names)
{
    auto const data = scene::case_of(funnel + tube + granules + gas +
                                     "[[gas.wall]]\nof = \"tube\"\ntemperature = "
                                     "\"350 K\"\n[[gas.wall]]\nof = \"column\"\nslip = true\n");
    EXPECT_NEAR(moist_mass_flow(data, data.gas.inlets[0]) / (1.2 * math::pi * 9e-4), 1, 2e-3);
    auto const settings = gas_settings(data);
    ASSERT_EQ(settings.walls.size(), 3u);
    auto const at = [&](math::Vec3 const& x) { return settings.walls[settings.wall_at(x)]; };
    EXPECT_EQ(at({0.0145, 0, 0.1}).temperature, 350) << "inside the tube";
    EXPECT_EQ(at({0, 0.0178, 0.1}).temperature, 350) << "outside";
    EXPECT_TRUE(at({0, 0.0495, 0.2}).slip);
    EXPECT_FALSE(at({0, 0.039, 0.1}).slip);
    EXPECT_FALSE(at({0, 0.039, 0.1}).temperature.has_value());
}

TEST(Internals, that_cut_an_opening_off_are_told_at_the_start)
{
    // A cup upside down over the plate: what enters is caught below it.
    std::string const cup = R"(
[[internal]]
shape = "cylinder"
base = ["0 mm", "0 mm", "85 mm"]
length = "20 mm"
diameter = "96 mm"
)";
    EXPECT_THROW(scene::simulation_of(funnel + cup + granules + gas), base::CaseError);
}

TEST(Internals, stand_in_a_box_too)
{
    std::string const box = R"(
[apparatus]
shape = "box"
size = ["60 mm", "60 mm", "100 mm"]
[[internal]]
name = "block"
shape = "box"
lower = ["20 mm", "20 mm", "0 mm"]
upper = ["40 mm", "40 mm", "30 mm"]
[[internal]]
name = "bar"
shape = "cylinder"
base = ["-5 mm", "30 mm", "28 mm"]
axis = [1, 0, 0]
length = "70 mm"
diameter = "8 mm"
joined = true
)";
    auto const data = scene::case_of(box + granules + gas +
                                     "[[gas.wall]]\nof = \"left\"\nslip = true\n[[gas.wall]]\nof = \"bar\"\n"
                                     "temperature = \"350 K\"\n");
    EXPECT_NEAR(moist_mass_flow(data, data.gas.inlets[0]) / (1.2 * (0.0036 - 0.0004)), 1, 2e-3)
        << "superficial where the plate is open";
    ASSERT_EQ(data.bodies.size(), 1u) << "bodies that are fixed to each other are one";
    auto const settings = gas_settings(data);
    EXPECT_TRUE(settings.walls[settings.wall_at({0, 0.01, 0.01})].slip);
    EXPECT_EQ(settings.walls[settings.wall_at({0.01, 0.03, 0.033})].temperature, 350);
    EXPECT_FALSE(settings.walls[settings.wall_at({0.0195, 0.03, 0.01})].temperature);
    auto const walls = granule_settings(data).walls;
    EXPECT_EQ(walls.size(), 7u);
    EXPECT_EQ(walls.back().name, "block");
}

std::string message_of(std::string const& text)
{
    try {
        scene::case_of(text);
    } catch (base::CaseError const& error) {
        return error.what();
    }
    return "";
}

TEST(CaseSolids, that_do_not_make_a_chamber_are_told)
{
    auto const says = [](std::string const& text, char const* word) {
        auto const what = message_of(text + granules);
        EXPECT_NE(what.find(word), std::string::npos) << word << " in\n" << what;
    };
    auto const solid = [](char const* operation, char const* centre) {
        return std::string("[[apparatus.solid]]\noperation = \"") + operation +
               "\"\nshape = \"sphere\"\ndiameter = \"50 mm\"\ncentre = " + centre + "\n";
    };
    auto const far = "[\"0 mm\", \"0 mm\", \"500 mm\"]", middle = "[\"0 mm\", \"0 mm\", \"130 mm\"]";
    says(funnel + solid("add", far), "does not touch what was added before");
    says(funnel + solid("subtract", far), "takes away a body that does not reach into");
    says(funnel + solid("intersect", far), "leaves nothing");
    EXPECT_EQ(message_of(funnel + solid("subtract", middle) + granules), "");
    says("[apparatus]\nshape = \"solids\"\n" + solid("subtract", middle), "before there is a chamber");
    says("[apparatus]\nshape = \"solids\"\n", "apparatus.solid is missing");
    says("[apparatus]\nshape = \"solids\"\n" + solid("add", middle) +
             "[[apparatus.solid]]\noperation = \"subtract\"\nshape = \"sphere\"\ndiameter = \"60 mm\"\ncentre = " +
             middle + "\n",
         "leaves nothing open");
    says(funnel + "[[internal]]\nshape = \"sphere\"\ndiameter = \"5 mm\"\ncentre = " + far + "\n",
         "does not stand in the apparatus");
    says(funnel +
             "[[apparatus.solid]]\noperation = \"subtract\"\nshape = \"box\"\nlower = [\"-60 mm\", \"-0.1 mm\", \"160 "
             "mm\"]\n"
             "upper = [\"60 mm\", \"0.1 mm\", \"190 mm\"]\n",
         "give apparatus.resolution half of the thinnest wall");
    auto const filled = message_of(funnel + granules +
                                   "[granules.region]\nlower = [\"41 mm\", \"-5 mm\", \"185 mm\"]\n"
                                   "upper = [\"45 mm\", \"5 mm\", \"195 mm\"]\n");
    EXPECT_NE(filled.find("has no open place: its middle is in the wall: within \"notch\""), std::string::npos)
        << filled;
    says(funnel + "[[internal]]\nname = \"cone\"\nshape = \"sphere\"\ndiameter = \"5 mm\"\ncentre = " + middle + "\n",
         "is that of another wall too");
    says(funnel +
             "[[internal]]\nshape = \"tube\"\ninner_diameter = \"5 mm\"\nouter_diameter = \"5 mm\"\nlength = \"9 "
             "mm\"\nbase = " +
             middle + "\n",
         "leaves the tube no wall");
}
}
