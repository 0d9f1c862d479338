// A pilot's case has the lab's velocity, drying potential and nozzle air, and eight times the rest.
#include "granum/sim/scale.hpp"

#include "granum/base/error.hpp"
#include "granum/sim/balance.hpp"
#include "granum/sim/case_reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace
{
using namespace granum;
using namespace granum::sim;
namespace fs = std::filesystem;

constexpr char const* lab_file = GRANUM_SOURCE_DIR "/examples/01-lab-layering/case.toml";

//! The scaled case, read from a file of its own.
Case pilot(Scaling const& scaling, std::string const& lab = lab_file)
{
    auto const path = fs::temp_directory_path() / fmt::format("granum_scale_test_{}.toml", ::getpid());
    std::ofstream(path) << scaled_case(lab, scaling);
    auto const out = read_case(path.string()).data;
    fs::remove(path);
    return out;
}

double plate_velocity(Case const& data)
{
    return dry_inlet_flow(data) / data.chamber.area(0);
}

TEST(Scale, by_height_keeps_velocity_balance_and_bed_height)
{
    auto const lab = read_case(lab_file).data;
    for (int const nozzles : {1, 2, 4, 8}) {
        auto const big = pilot({8, nozzles, Likeness::height});
        EXPECT_NEAR(plate_velocity(big), plate_velocity(lab), 1e-6 * plate_velocity(lab));
        EXPECT_NEAR(balance(big).eta, balance(lab).eta, 1e-6);
        EXPECT_NEAR(balance(big).outlet_temperature, balance(lab).outlet_temperature, 1e-4);
        EXPECT_NEAR(big.granules.mass, 8 * lab.granules.mass, 1e-9);
        EXPECT_NEAR(big.granules.parcel_ratio, lab.granules.parcel_ratio, 1e-6);
        EXPECT_NEAR(big.chamber.area(0), 8 * lab.chamber.area(0), 1e-6);
        EXPECT_EQ(big.chamber.height(), lab.chamber.height());
        EXPECT_NEAR(big.spray.rate, 8 * lab.spray.rate, 1e-12);
        ASSERT_EQ(big.spray.nozzles.size(), static_cast<std::size_t>(nozzles));
        double air = 0;
        for (auto const& nozzle : big.spray.nozzles) {
            air += nozzle.air_mass_flow;
            EXPECT_EQ(nozzle.position.z, lab.spray.nozzles[0].position.z);
            EXPECT_EQ(nozzle.air_velocity, lab.spray.nozzles[0].air_velocity);
        }
        EXPECT_NEAR(air, 8 * lab.spray.nozzles[0].air_mass_flow, 1e-9);
        // Cells as large as in the lab, to their rounding.
        double const edge = 2 * lab.chamber.radius(1) / lab.gas.cells[0],
                     big_edge = 2 * big.chamber.radius(1) / big.gas.cells[0];
        EXPECT_NEAR(big_edge, edge, 0.03 * edge);
    }
}

TEST(Scale, stands_nozzles_on_the_ring_that_parts_the_plate)
{
    auto const big = pilot({8, 4, Likeness::height});
    double const radius = big.chamber.radius(0);
    for (std::size_t n = 0; n < 4; ++n) {
        auto const& x = big.spray.nozzles[n].position;
        EXPECT_NEAR(x.x * x.x + x.y * x.y, 0.5 * radius * radius, 1e-8);
        auto const& next = big.spray.nozzles[(n + 1) % 4].position;
        EXPECT_NEAR(x.x * next.x + x.y * next.y, 0, 1e-8) << "a quarter of a turn apart";
    }
}

TEST(Scale, by_geometry_makes_all_lengths_alike)
{
    auto const lab = read_case(lab_file).data;
    auto const big = pilot({8, 1, Likeness::geometry});
    EXPECT_NEAR(big.chamber.height(), 2 * lab.chamber.height(), 1e-9);
    EXPECT_NEAR(big.chamber.radius(0), 2 * lab.chamber.radius(0), 1e-9);
    EXPECT_NEAR(big.granules.mass, 8 * lab.granules.mass, 1e-9);
    EXPECT_NEAR(big.spray.rate, 4 * lab.spray.rate, 1e-9);
    EXPECT_NEAR(plate_velocity(big), plate_velocity(lab), 1e-6 * plate_velocity(lab));
    EXPECT_NEAR(balance(big).eta, balance(lab).eta, 1e-6);
}

TEST(Scale, refuses_what_it_cannot_place)
{
    EXPECT_THROW(pilot({8, 1, Likeness::height}, GRANUM_SOURCE_DIR "/examples/08-wurster/case.toml"), base::CaseError);
    EXPECT_THROW(pilot({8, 0, Likeness::height}), base::CaseError);
    EXPECT_THROW(pilot({8, 1, Likeness::height}, "no-such-case.toml"), base::CaseError);
    EXPECT_THROW(pilot({8, 1, Likeness::height}, GRANUM_SOURCE_DIR "/examples/12-rectangular-bed/case.toml"),
                 base::CaseError);
}
}
