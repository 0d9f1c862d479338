// Reference case CFD-11: the pressure drop of a packed bed of spheres at rest, through the whole coupling.
#include "scene/flow.hpp"
#include "scene/reference.hpp"
#include "verify/table.hpp"

#include <algorithm>

namespace
{
using namespace granum;

struct Bed
{
    char const* name;
    double diameter, voidage, length, density, viscosity;  // m, m3/m3, m, kg/m3, Pa s
};

//! Spheres at rest on a body-centred lattice, one cube of it to a cell, as wide as it must be for the voidage. Returns
//! what the gas loses over the length of the bed, Pa.
double pressure_drop(Bed const& bed, double velocity)
{
    double const edge = std::cbrt(2 * math::pi / 6 * std::pow(bed.diameter, 3) / (1 - bed.voidage));
    int const across = 3, along = 12;
    std::string text = scene::gas_in_box(
        {across * edge, across * edge, along * edge}, {across, across, along}, "\"x\", \"y\"",
        fmt::format(
            "density = \"{} kg/m3\"\nviscosity = \"{} Pa.s\"\nvelocity = \"{} m/s\"\ndrag = \"ergun\"\n"
            "smoothing = \"0 mm\"\n[granules]\nstart = \"given\"\nfrozen = true\ndiameter = \"{} m\"\ndensity = "
            "\"2000 kg/m3\"\n",
            bed.density, bed.viscosity, velocity, bed.diameter));
    for (int k = 0; k < along; ++k)
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i)
                for (double const middle : {0.25, 0.75})
                    text += scene::granule_text(
                        {.position = edge * math::Vec3{i + middle, j + middle, k + middle}, .diameter = bed.diameter});
    auto const simulation = scene::simulation_of(text);
    for (int step = 0; step < 200; ++step) simulation->step(0.5 * edge / velocity);
    auto const& grid = simulation->grid();
    auto const& pressure = simulation->gas().pressure;
    return (pressure[grid.at(1, 1, 2)] - pressure[grid.at(1, 1, along - 3)]) / ((along - 5) * edge) * bed.length;
}

TEST(PackedBed, loses_the_pressure_of_ergun)
{
    Bed const beds[] = {{"cfdem_ergun", 1e-3, 0.451335, 0.0156, 10, 1.5e-3},
                        {"cfdem_packedbed", 0.022, 0.4436, 1, 1.188, 1.188 * 1.5e-3}};
    scene::Table const table("cfd-11.csv");
    for (auto const& bed : beds) {
        std::string const name = bed.name;
        double worst = 0;
        int rows = 0;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (table.text(row, "case") != name) continue;
            double const published = table.number(row, "dp_Pa");
            double const ours = pressure_drop(bed, table.number(row, "U_superficial_m_per_s"));
            worst = std::max(worst, std::abs(ours / published - 1));
            ++rows;
        }
        ASSERT_GT(rows, 3);
        verify::below("CFD11", fmt::format("{}: pressure drop at {} velocities, largest share off", name, rows), 0.01,
                      worst);
    }
}

//! A bed at rest that hot gas passes, as granules or as parcels of `ratio` cubed of them in the same cells: what it
//! costs the gas and how warm bed and gas become.
struct Passed
{
    double pressure, bed, outlet;  // Pa, K, K
};

Passed passed_by_hot_gas(int ratio)
{
    double const diameter = 1e-3, edge = 1.25e-3 * ratio;
    int const across = 3, along = 10, in_cell = 4 / ratio;
    double const cell = in_cell * edge;
    auto text = scene::gas_in_box(
        {across * cell, across * cell, along * cell}, {across, across, along}, "\"x\", \"y\"",
        fmt::format(
            "velocity = \"0.5 m/s\"\ntemperature = \"80 degC\"\nhumidity = \"8 g/kg\"\nmapping = \"centre\"\n"
            "smoothing = \"0 mm\"\n[granules]\nstart = \"given\"\nfrozen = true\ndiameter = \"{} m\"\ndensity = "
            "\"2500 kg/m3\"\nparcel_ratio = {}\n",
            diameter, ratio));
    text.insert(text.find("[start]") + 8, "bed_temperature = \"20 degC\"\n");
    for (int k = 0; k < along * in_cell; ++k)
        for (int j = 0; j < across * in_cell; ++j)
            for (int i = 0; i < across * in_cell; ++i)
                for (double const middle : {0.25, 0.75})
                    text += scene::granule_text({.position = edge * math::Vec3{i + middle, j + middle, k + middle}});
    auto data = scene::case_of(text);
    for (auto& one : data.granules.given) one.count = std::pow(ratio, 3);  // in a case each is a single granule
    par::Communicator const alone(MPI_COMM_SELF);
    auto const simulation = std::make_unique<sim::Simulation>(std::move(data), alone);
    for (double const end = 0.2; simulation->time() < end * (1 - 1e-12);)
        simulation->step(std::min(5e-4, end - simulation->time()));
    auto const& grid = simulation->grid();
    auto const& gas = simulation->gas();
    return {gas.pressure[grid.at(1, 1, 0)] - gas.pressure[grid.at(1, 1, along - 1)],
            simulation->readings().bed_temperature, gas.temperature[grid.at(1, 1, along - 1)]};
}

TEST(PackedBed, of_parcels_does_to_the_gas_what_its_granules_do)
{
    auto const granules = passed_by_hot_gas(1);
    EXPECT_GT(granules.pressure, 100);
    EXPECT_GT(granules.bed, 293.17);
    for (int const ratio : {2, 4}) {
        auto const parcels = passed_by_hot_gas(ratio);
        auto const say = [&](char const* what) {
            return fmt::format("bed at rest as parcels of {} granules: {}", ratio * ratio * ratio, what);
        };
        verify::relative("N19", say("pressure drop against that of the granules, Pa"), granules.pressure,
                         parcels.pressure, 2e-4);
        verify::relative("N19", say("rise of the bed temperature, K"), granules.bed - 293.15, parcels.bed - 293.15,
                         1e-3);
        verify::relative("N19", say("gas that leaves, K"), granules.outlet, parcels.outlet, 2e-5);
    }
}
}
