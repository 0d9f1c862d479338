// Walls of the gas: with a temperature, with a loss to the surroundings, adiabatic; against closed forms. Conduction
// across a gap between two temperatures is CFD-04. Row E05.
#include "granum/material/moist_air.hpp"
#include "scene/flow.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;

double const capacity = material::heat_capacity_air;

std::string gas_text(double conductivity, double temperature)
{
    return fmt::format(
        "density = \"1.2 kg/m3\"\nviscosity = \"2e-5 Pa.s\"\nconductivity = \"{} W/m/K\"\n"
        "temperature = \"{} K\"\n",
        conductivity, temperature);
}

//! Gas that flows at 0.5 m/s along a duct of 10 x 10 mm and 0.5 m length; `wall` are lines of [gas] on its walls.
std::unique_ptr<sim::Simulation> duct(int cells, std::string const& wall)
{
    auto simulation = scene::simulation_of(scene::gas_in_box(
        {0.5, 0.01, 0.01}, {cells, 1, 1}, "",
        gas_text(1e-9, 350) + wall +
            "[[inlet]]\nend = \"left\"\nhumidity = 0\nvelocity = \"0.5 m/s\"\n[[outlet]]\nend = \"right\"\n"));
    for (int step = 0; step < 600; ++step) simulation->step(0.01);
    return simulation;
}

TEST(Duct, that_loses_heat_cools_its_gas_as_the_closed_form)
{
    // T - T_a = (T_in - T_a) exp(-U P x / (m c)); U = 20 W/m2/K, P = 40 mm, m = 60 mg/s. The ends lose heat too where
    // they are walls; here they are open.
    double const flow = 1.2 * 0.5 * 1e-4, outside = 290, rate = 20 * 0.04 / (flow * capacity);
    double coarser = 0;
    for (int const cells : {10, 20, 40}) {
        auto const simulation = duct(cells, "heat_loss = \"20 W/m2/K\"\nsurroundings = \"290 K\"\n");
        double worst = 0;
        for (int i = 0; i < cells; ++i) {
            double const x = (i + 0.5) * 0.5 / cells;
            double const t = simulation->gas().temperature[simulation->grid().at(i, 0, 0)];
            worst = std::max(worst, std::abs(t - outside - 60 * std::exp(-rate * x)));
        }
        if (coarser > 0)
            verify::between("E05", fmt::format("duct with heat loss: order from {} to {} cells", cells / 2, cells),
                            0.85, 2.3, std::log2(coarser / worst));
        if (cells == 40)
            verify::below("E05", "duct with heat loss, 40 cells: largest temperature off, K (of a fall of 60)", 0.5,
                          worst);
        coarser = worst;
    }
}

TEST(Duct, that_is_adiabatic_keeps_the_temperature_of_its_gas)
{
    auto const simulation = duct(10, "");
    double worst = 0;
    for (int i = 0; i < 10; ++i)
        worst = std::max(worst, std::abs(simulation->gas().temperature[simulation->grid().at(i, 0, 0)] - 350));
    verify::below("E05", "adiabatic duct: largest temperature off, K", 1e-9, worst);
    verify::below("E05", "adiabatic duct: heat to the walls, J", 1e-12, std::abs(simulation->heat().wall_gas));
}

TEST(ClosedVessel, that_loses_heat_cools_as_the_closed_form)
{
    // Mixed by conduction; m c_v dT/dt = -U A (T - T_a).
    double const cv = capacity - math::gas_constant / material::molar_mass_air;
    double const mass = material::density(1e5, 350, 0) * 1e-3, rate = 2 * 0.06 / (mass * cv), time = 1 / rate;
    std::vector<double> off;
    for (int const steps : {50, 100, 200}) {
        auto const simulation = scene::simulation_of(scene::gas_in_box(
            {0.1, 0.1, 0.1}, {2, 2, 2}, "",
            "closed = true\nconductivity = \"1000 W/m/K\"\ntemperature = \"350 K\"\npressure = \"1 bar\"\nheat_loss = "
            "\"2 W/m2/K\"\nsurroundings = \"290 K\"\n"));
        for (int step = 0; step < steps; ++step) simulation->step(time / steps);
        double const t = simulation->gas().temperature[simulation->grid().at(0, 0, 0)];
        off.push_back(t - 290 - 60 * std::exp(-1));
        if (steps == 200)
            verify::absolute("E05", "closed vessel with heat loss, after one time constant: temperature, K",
                             290 + 60 * std::exp(-1), t, 0.2);
    }
    verify::between("E05", "closed vessel with heat loss: order of the step", 0.9, 1.1,
                    std::log2((off[0] - off[1]) / (off[1] - off[2])));
}

//! Nusselt number, by twice the distance of the plates, of developed laminar flow between plates of one temperature.
double plates(int across)
{
    double const height = 0.01, peclet = 60, conductivity = 0.03;
    double const speed = peclet * conductivity / (1.2 * capacity * height), length = 12 * height;
    auto const simulation = scene::simulation_of(scene::gas_in_box(
        {length, height / across, height}, {4 * across, 1, across}, "\"y\"",
        gas_text(conductivity, 300) +
            "[[gas.wall]]\nof = \"bottom\"\ntemperature = \"300 K\"\n[[gas.wall]]\nof = \"top\"\ntemperature = \"300 "
            "K\"\n" +
            fmt::format("[[inlet]]\nend = \"left\"\nhumidity = 0\ntemperature = \"400 K\"\nprofile = \"parabolic\"\n"
                        "velocity = \"{} m/s\"\n[[outlet]]\nend = \"right\"\nresistance = \"0 Pa.s/m\"\n",
                        speed)));
    double const step = length / (4 * across) / speed;
    while (simulation->time() < 4 * length / speed) simulation->step(step);
    auto const& gas = simulation->gas();
    auto const& grid = simulation->grid();
    auto const bulk = [&](int i) {
        double flow = 0, heat = 0;
        for (int k = 0; k < across; ++k) {
            auto const c = grid.at(i, 0, k);
            double const u = 0.5 * (gas.velocity[0][c] + gas.velocity[0][grid.next(c, 0)]);
            flow += u, heat += u * (gas.temperature[c] - 300);
        }
        return heat / flow;
    };
    int const first = 4 * across * 5 / 12, last = 4 * across * 10 / 12;
    double const distance = (last - first) * length / (4 * across);
    double const decay = std::log(bulk(first) / bulk(last)) / distance;  // Nu k / (rho c u h^2)
    return decay * 1.2 * capacity * speed * height * height / conductivity;
}

TEST(Plates, of_one_temperature_cool_laminar_flow_with_the_nusselt_number_of_the_textbook)
{
    // Conduction along the flow takes (s h)^2 of it, s the decay per length: 0.2 % here.
    for (int const across : {8, 16})
        verify::relative("E05", fmt::format("plates of one temperature, {} cells across: Nusselt number", across),
                         7.5407, plates(across), 0.005);
}
}
