// Reference cases CFD-02, CFD-03 and CFD-04: flow between plates and conduction across a gap, with their order.
#include "scene/flow.hpp"
#include "scene/reference.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;

constexpr std::array across{8, 16, 32, 64};

//! Velocity along z between plates at x = 0 and x = `height` after a long time, cell by cell across.
scene::Line channel(int cells, double height, double viscosity, double push, double upper_wall)
{
    auto const simulation = scene::simulation_of(scene::gas_in_box(
        {height, height / cells, height / cells}, {cells, 1, 1}, "\"y\", \"z\"",
        fmt::format("closed = true\ndensity = \"1 kg/m3\"\nviscosity = \"{} Pa.s\"\npush = [\"0 Pa/m\", \"0 Pa/m\", "
                    "\"{} Pa/m\"]\n[[gas.wall]]\nof = \"right\"\nvelocity = [\"0 m/s\", \"0 m/s\", \"{} m/s\"]\n",
                    viscosity, push, upper_wall)));
    double const slowest = height * height / (viscosity * 9.8696);  // the slowest mode's time
    scene::run_to_rest(*simulation, 0.5 * slowest, slowest, 1e-12 * height * height * (std::abs(push) + 1) / viscosity,
                       100 * slowest);
    auto const& grid = simulation->grid();
    scene::Line line;
    for (int i = 0; i < cells; ++i) {
        line.place.push_back(grid.axes[0].centre(i));
        line.value.push_back(simulation->gas().velocity[2][grid.at(i, 0, 0)]);
    }
    return line;
}

TEST(Channel, between_plates_at_rest_is_a_parabola)
{
    double const height = 0.01, push = 240 / 0.2, viscosity = 1e-3;
    std::array const mfix{0.234375, 0.0585937, 0.0146484, 0.00366208};
    double coarser = 0;
    for (std::size_t k = 0; k < across.size(); ++k) {
        auto const line = channel(across[k], height, viscosity, push, 0);
        double worst = 0;
        for (std::size_t i = 0; i < line.place.size(); ++i) {
            double const x = line.place[i];
            worst = std::max(worst, std::abs(line.value[i] - push / (2 * viscosity) * x * (height - x)));
        }
        verify::below({"CFD02", fmt::format("MFIX {}", mfix[k])},
                      fmt::format("plates, {} cells across: largest error of the velocity, m/s (mean 10)", across[k]),
                      1.01 * mfix[k], worst);
        if (k > 0)
            verify::between({"CFD02", "MFIX 2.00"},
                            fmt::format("plates: order from {} to {} cells", across[k - 1], across[k]), 1.9, 2.1,
                            std::log2(coarser / worst));
        coarser = worst;
    }
    // The archived table, on the finest cells.
    auto const line = channel(64, height, viscosity, push, 0);
    scene::Table const table("cfd-02.csv");
    double worst = 0;
    for (std::size_t row = 1; row + 1 < table.rows(); ++row)
        worst = std::max(worst, std::abs(line.at(table.number(row, "y_m")) - table.number(row, "u_m_per_s")));
    verify::below("CFD02", "plates, 64 cells: largest difference from the table, m/s (centre 15)", 0.01, worst);
}

TEST(Channel, with_one_plate_moving_is_the_sum_of_a_line_and_a_parabola)
{
    double const height = 0.01, viscosity = 5e-6, wall = 10;
    scene::Table const table("cfd-03.csv");
    for (int const push : {-3, -2, -1, 0, 1, 2, 3}) {
        auto const line = channel(64, height, viscosity, push, wall);
        double worst = 0;
        for (std::size_t row = 0; row < table.rows(); ++row)
            if (table.number(row, "dp_over_L_Pa_per_m") == push && table.number(row, "y_over_H") > 0 &&
                table.number(row, "y_over_H") < 1)
                worst = std::max(
                    worst, std::abs(line.at(height * table.number(row, "y_over_H")) - table.number(row, "u_m_per_s")));
        verify::below({"CFD03", push == 3   ? "MFIX 0.0018"
                                : push == 0 ? "MFIX 7e-7"
                                            : ""},
                      fmt::format("one plate at 10 m/s, {} Pa/m, 64 cells: largest error, m/s", push),
                      push == 0 ? 1e-6 : 0.0019, worst);
    }
    double coarser = 0;
    std::array const mfix{0.1171875, 0.0292969, 0.0073242, 0.001831};
    for (std::size_t k = 0; k < across.size(); ++k) {
        auto const line = channel(across[k], height, viscosity, 3, wall);
        double worst = 0;
        for (std::size_t i = 0; i < line.place.size(); ++i) {
            double const x = line.place[i];
            worst =
                std::max(worst, std::abs(line.value[i] - wall * x / height - 3 / (2 * viscosity) * x * (height - x)));
        }
        verify::below({"CFD03", fmt::format("MFIX {}", mfix[k])},
                      fmt::format("one plate moving, 3 Pa/m, {} cells across: largest error, m/s", across[k]),
                      1.01 * mfix[k], worst);
        if (k > 0)
            verify::between("CFD03",
                            fmt::format("one plate moving: order from {} to {} cells", across[k - 1], across[k]), 1.9,
                            2.1, std::log2(coarser / worst));
        coarser = worst;
    }
}

TEST(Gap, between_walls_of_two_temperatures_conducts_along_a_line)
{
    for (int const cells : {8, 16, 32, 64}) {
        auto const simulation = scene::simulation_of(scene::gas_in_box(
            {1, 1.0 / cells, 1.0 / cells}, {cells, 1, 1}, "\"y\", \"z\"",
            "closed = true\ndensity = \"1 kg/m3\"\nviscosity = \"1e-5 Pa.s\"\nconductivity = \"1 W/m/K\"\n"
            "temperature = \"350 K\"\n[[gas.wall]]\nof = \"left\"\ntemperature = \"400 K\"\n[[gas.wall]]\nof = "
            "\"right\"\ntemperature = \"300 K\"\n"));
        for (int step = 0; step < 60; ++step) simulation->step(1e3);
        double worst = 0;
        for (int i = 0; i < cells; ++i)
            worst = std::max(worst, std::abs(simulation->gas().temperature[simulation->grid().at(i, 0, 0)] -
                                             (400 - 100 * simulation->grid().axes[0].centre(i))));
        verify::below({"CFD04", "MFIX 9.1e-13"},
                      fmt::format("gap between 400 and 300 K, {} cells: largest error, K", cells), 1e-6, worst);
    }
}
}
