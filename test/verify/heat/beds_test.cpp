// Reference case H-07, the breakthrough of heat in a packed bed, and rows E07 and E08: an empty chamber and a packed
// bed that are heated in every way there is, whose enthalpy must close.
#include "granum/law/heat/all.hpp"
#include "granum/material/moist_air.hpp"
#include "scene/case_text.hpp"
#include "scene/reference.hpp"
#include "verify/table.hpp"

#include <map>

namespace
{
using namespace granum;
using math::Vec3;

//! A bed of frozen spheres of 1 mm on a lattice, `slices` mm long, through which gas of 350 K begins to flow into gas
//! and spheres of 300 K.
struct Column
{
    static constexpr double diameter = 1e-3, solids = math::pi / 6, speed = 1;         //!< superficial, m/s
    static constexpr double density = 1.2, viscosity = 1.8e-5, conductivity = 1.5e-3;  //!< of the gas
    static constexpr double solid_density = 1000, solid_capacity = 20;
    int slices, per_slice;
    std::unique_ptr<sim::Simulation> simulation;

    //! h a, W/m3/K, by Gunn's law, recalculated here.
    static double transfer()
    {
        double const eps = 1 - solids, re = density * speed * diameter / viscosity;
        double const prandtl = std::cbrt(viscosity * material::heat_capacity_air / conductivity);
        double const nusselt = (7 - 10 * eps + 5 * eps * eps) * (1 + 0.7 * std::pow(re, 0.2) * prandtl) +
                               (1.33 - 2.4 * eps + 1.2 * eps * eps) * std::pow(re, 0.7) * prandtl;
        return nusselt * conductivity / diameter * 6 * solids / diameter;
    }
    static double xi(double z) { return transfer() * z / (density * speed * material::heat_capacity_air); }
    static double tau(double z, double t)
    {
        return transfer() * (t - z * (1 - solids) / speed) / (solids * solid_density * solid_capacity);
    }
    static double time(double z, double at)
    {
        return at * solids * solid_density * solid_capacity / transfer() + z * (1 - solids) / speed;
    }
    static double place(double at) { return at * density * speed * material::heat_capacity_air / transfer(); }

    //! Cells of 1/`per_slice` mm along the bed, of which every one has its share of spheres.
    Column(int length, int cells) : slices(length), per_slice(cells)
    {
        std::string rows;
        int id = 0;
        for (int k = 0; k < slices; ++k)
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i)
                    rows += fmt::format("{},{},{},{},{}\n", id++, (i + 0.5) * diameter, (j + 0.5) * diameter,
                                        (k + 0.5) * diameter, 0.5 * diameter);
        simulation = scene::simulation_of(
            "gravity = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n[apparatus]\nshape = \"box\"\nsize = " +
                scene::vector_text({3 * diameter, 3 * diameter, slices * diameter}, "m") +
                fmt::format("\nperiodic = [\"x\", \"y\"]\n[granules]\ndiameter = \"{} m\"\ndensity = \"{} kg/m3\"\n"
                            "heat_capacity = \"{} J/kg/K\"\nfrozen = true\nfile = \"granules.csv\"\n"
                            "[start]\nquasi_steady = false\nbed_temperature = \"300 K\"\ngas_temperature = \"300 K\"\n",
                            diameter, solid_density, solid_capacity) +
                fmt::format(
                    "[gas]\nvelocity = \"{} m/s\"\ntemperature = \"350 K\"\nhumidity = 0\ndensity = \"{} kg/m3\"\n"
                    "viscosity = \"{} Pa.s\"\nconductivity = \"{} W/m/K\"\nsmoothing = \"0 mm\"\n"
                    "heat_transfer = \"gunn\"\ndrag = \"ergun\"\ncells = [1, 1, {}]\n[time]\nduration = \"9 s\"\n",
                    speed, density, viscosity, conductivity, slices / per_slice),
            rows);
    }

    //! Largest share of the step by which gas and spheres are off the table, with steps of `step` s.
    std::array<double, 2> off(scene::Table const& table, double step)
    {
        struct Look
        {
            double z;
            std::size_t row;
        };
        std::multimap<double, Look> looks;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            double const z = place(table.number(row, "xi"));
            looks.insert({time(z, table.number(row, "tau")), {z, row}});
        }
        std::array<double, 2> worst{};
        auto const& grid = simulation->grid();
        auto const& granules = simulation->granules();
        for (auto const& [at, look] : looks) {
            while (simulation->time() < at - 1e-9) simulation->step(std::min(step, at - simulation->time()));
            auto const between = [&](double place, auto const& value) {
                int const k = static_cast<int>(place);
                return value(k) + (place - k) * (value(k + 1) - value(k));
            };
            double const edge = per_slice * diameter;
            double const gas = between(look.z / edge - 0.5, [&](int k) {
                return (simulation->gas().temperature[grid.at(0, 0, k)] - 300) / 50;
            });
            std::vector<double> along(static_cast<std::size_t>(slices));
            for (std::size_t row = 0; row < granules.owned; ++row)
                along[static_cast<std::size_t>(granules.position[row].z / diameter)] = granules.temperature[row];
            double const solid = between(look.z / diameter - 0.5,
                                         [&](int k) { return (along[static_cast<std::size_t>(k)] - 300) / 50; });
            worst[0] = std::max(worst[0], std::abs(gas - table.number(look.row, "theta_fluid")));
            worst[1] = std::max(worst[1], std::abs(solid - table.number(look.row, "theta_solid")));
        }
        return worst;
    }
};

TEST(PackedBed, is_heated_by_gas_as_schumann_found)
{
    scene::Table const table("h-07.csv");
    double last = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) last = std::max(last, table.number(row, "xi"));
    int const length = 4 * static_cast<int>(std::ceil(1.1 * Column::place(last) / Column::diameter / 4));
    double coarser = 0;
    for (int const mm : {4, 2, 1}) {
        Column column(length, mm);
        auto const [gas, solid] = column.off(table, 2.5e-4);
        std::string const name = fmt::format("packed bed, {} cells: ", length / mm);
        verify::below("H07", name + "gas, largest difference over the step", mm == 1 ? 0.01 : 0.2, gas);
        verify::below("H07", name + "solid, largest difference over the step", mm == 1 ? 0.01 : 0.2, solid);
        if (coarser > 0)
            verify::between("H07", fmt::format("packed bed: order from {} to {} cells", length / (2 * mm), length / mm),
                            0.9, 3.2, std::log2(coarser / gas));
        coarser = gas;
        verify::below("H07", name + "energy missing over what passed", 1e-6,
                      column.simulation->ledgers().energy.relative_error());
    }
}

TEST(EmptyChamber, that_is_heated_keeps_its_enthalpy)
{
    // The chamber of a laboratory unit with moist air of 80 degC, a lossy wall and a warm plate's ring.
    auto const simulation = scene::simulation_of(
        "[apparatus]\nshape = \"revolution\"\nprofile = [[\"0 mm\", \"180 mm\"], [\"200 mm\", \"250 mm\"], [\"400 "
        "mm\", "
        "\"250 mm\"]]\n[gas]\ndry_mass_flow = \"144 kg/h\"\ntemperature = \"80 degC\"\nhumidity = \"8 g/kg\"\n"
        "cells = [10, 10, 16]\nheat_loss = \"8 W/m2/K\"\nsurroundings = \"20 degC\"\n[[gas.wall]]\nof = \"chamber\"\n"
        "heat_loss = \"8 W/m2/K\"\n[start]\nquasi_steady = false\ngas_temperature = \"20 degC\"\n[time]\nduration = "
        "\"9 "
        "s\"\n");
    for (int step = 0; step < 1600; ++step) simulation->step(5e-3);
    auto const& ledger = simulation->ledgers().energy;
    verify::below("E07", "empty chamber, air of 80 degC, lossy wall, 8 s: enthalpy missing over what passed", 1e-6,
                  ledger.relative_error());
    verify::below("E07", "empty chamber: water missing over what passed", 1e-9,
                  simulation->ledgers().water.relative_error());
    EXPECT_GT(simulation->heat().wall_gas, 1);
    // Steady: what comes in leaves through outlet and wall.
    double const in = ledger.in, out = ledger.out, walls = simulation->heat().wall_gas;
    for (int step = 0; step < 200; ++step) simulation->step(5e-3);
    auto const& later = simulation->ledgers().energy;
    verify::relative("E07", "empty chamber, ninth second: enthalpy out over enthalpy in", 1,
                     (later.out - out) / (later.in - in), 2e-3);
    EXPECT_GT(simulation->heat().wall_gas, walls);
}

TEST(PackedBed, that_is_heated_in_every_way_keeps_its_enthalpy)
{
    // A settled bed: convection, contacts, films, radiation, a hot wall and a lossy one.
    auto const simulation = scene::simulation_of(
        "[apparatus]\nshape = \"box\"\nsize = [\"12 mm\", \"12 mm\", \"40 mm\"]\n[granules]\ndiameter = \"1 mm\"\n"
        "density = \"1500 kg/m3\"\nheat_capacity = \"800 J/kg/K\"\nmass = \"2 g\"\nemissivity = 0.9\nstart = "
        "\"settled\"\n"
        "[contact]\nyoungs_modulus = \"1 MPa\"\nconduction = \"hertz\"\nheat_conductivity = \"1 W/m/K\"\n"
        "wall_heat_conductivity = \"15 W/m/K\"\nreal_youngs_modulus = \"5 GPa\"\nfilm = \"rong-horio\"\n"
        "[gas]\nvelocity = \"0.25 m/s\"\ntemperature = \"140 degC\"\nhumidity = \"5 g/kg\"\ncells = [4, 4, 12]\n"
        "[[gas.wall]]\nof = \"left\"\ntemperature = \"180 degC\"\n[[gas.wall]]\nof = \"right\"\nheat_loss = \"20 "
        "W/m2/K\"\n[start]\nquasi_steady = false\nbed_temperature = \"20 degC\"\ngas_temperature = \"20 degC\"\n"
        "[time]\nduration = \"9 s\"\n");
    for (int step = 0; step < 400; ++step) simulation->step(2e-3);
    auto const heat = simulation->heat();
    verify::below("E08",
                  "packed bed heated by gas, walls, contacts, films and radiation: enthalpy missing over what passed",
                  1e-6, simulation->ledgers().energy.relative_error());
    // Every way was gone, and towards the colder.
    EXPECT_GT(heat.contacts, 1e-4);
    EXPECT_GT(heat.film, 1e-3);
    EXPECT_LT(heat.wall_contacts, 0);
    EXPECT_LT(heat.wall_film, 0);
    EXPECT_NE(heat.radiation, 0);
    // The granules gained what gas and walls lost: enthalpies of granules as their temperatures say.
    double stored = 0, kept = 0;
    auto const& granules = simulation->granules();
    for (std::size_t row = 0; row < granules.owned; ++row) {
        kept += granules.enthalpy[row];
        stored += granules.mass[row] * 800 * (granules.temperature[row] - math::zero_celsius);
    }
    verify::relative("E08", "packed bed: enthalpy of the granules over mass, capacity and temperature", 1,
                     kept / stored, 1e-10);
    EXPECT_GT(stored / (2e-3 * 800), 20);
}
}
