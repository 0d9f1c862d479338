// Reference cases CFD-01 and CFD-08: a cavity whose lid moves, and one whose sides have two temperatures.
#include "scene/flow.hpp"
#include "scene/reference.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;

//! Values on the vertical middle of u and on the horizontal middle of w, ends included.
struct Profiles
{
    scene::Line u, w;
};

Profiles middle_lines(sim::Simulation const& simulation, double lid)
{
    auto const& grid = simulation.grid();
    auto const& velocity = simulation.gas().velocity;
    int const across = grid.n[0], up = grid.n[2];  // even and the same from both sides: a face lies in the middle
    Profiles out;
    out.u = {{0}, {0}};
    out.w = {{0}, {0}};
    for (int k = 0; k < up; ++k)
        out.u.place.push_back(grid.axes[2].centre(k)), out.u.value.push_back(velocity[0][grid.at(across / 2, 0, k)]);
    for (int i = 0; i < across; ++i)
        out.w.place.push_back(grid.axes[0].centre(i)), out.w.value.push_back(velocity[2][grid.at(i, 0, up / 2)]);
    out.u.place.push_back(1), out.u.value.push_back(lid);
    out.w.place.push_back(1), out.w.value.push_back(0);
    return out;
}

TEST(Cavity, with_a_lid_that_moves_has_the_profiles_of_ghia)
{
    scene::Table const table("cfd-01.csv");
    struct Published
    {
        double reynolds, mfix_u, mfix_v;
    };
    for (auto const& [reynolds, mfix_u, mfix_v] :
         {Published{100, 0.0026, 0.0050}, Published{400, 0.0017, 0.0025}, Published{1000, 0.0051, 0.0061}}) {
        int const cells = 128;
        auto const simulation = scene::simulation_of(scene::gas_in_box(
            {1, 1.0 / cells, 1}, {cells, 1, cells}, "\"y\"",
            fmt::format("closed = true\ndensity = \"1 kg/m3\"\nviscosity = \"{} Pa.s\"\n[[gas.wall]]\nof = \"top\"\n"
                        "velocity = [\"1 m/s\", \"0 m/s\", \"0 m/s\"]\n",
                        1 / reynolds)));
        scene::run_to_rest(*simulation, 0.8 / cells, 1, 2e-5, 80);
        auto const lines = middle_lines(*simulation, 1);
        std::array<double, 2> squares{}, worst{}, points{};
        for (std::size_t row = 0; row < table.rows(); ++row) {
            double const at = table.number(row, "coordinate");
            // One value of Ghia's table breaks its smooth profile (CFD-01, note 2).
            bool const odd = reynolds == 400 && table.text(row, "profile")[0] == 'v' && at == 0.9063;
            if (table.number(row, "Re") != reynolds || at <= 0 || at >= 1 || odd) continue;
            std::size_t const which = table.text(row, "profile")[0] == 'u' ? 0 : 1;
            double const off = (which == 0 ? lines.u : lines.w).at(at) - table.number(row, "ghia");
            squares[which] += off * off, points[which] += 1;
            worst[which] = std::max(worst[which], std::abs(off));
        }
        for (std::size_t which : {0u, 1u}) {
            char const* const name = which == 0 ? "along the lid, vertical middle" : "across it, horizontal middle";
            verify::below(
                {"CFD01", fmt::format("MFIX {}", which == 0 ? mfix_u : mfix_v)},
                fmt::format(
                    "lid cavity, Re {}, 128 x 128: root mean square difference of the velocity {}, over the lid's",
                    reynolds, name),
                0.01, std::sqrt(squares[which] / points[which]));
            verify::below("CFD01", fmt::format("lid cavity, Re {}: largest difference {}", reynolds, name), 0.015,
                          worst[which]);
        }
    }
}

TEST(Cavity, with_a_hot_and_a_cold_side_carries_the_heat_of_de_vahl_davis)
{
    scene::Table const table("cfd-08.csv");
    // Air-like: the numbers of the case are Prandtl 0.71 and Rayleigh; density, expansion and size are of any scale.
    double const prandtl = 0.71, viscosity = 1e-3, capacity = 1006;
    double const conductivity = viscosity * capacity / prandtl, alpha = conductivity / capacity;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const rayleigh = table.number(row, "Ra");
        // Cells of 6 mm at the hot and the cold side, where the gas rises and falls. On 80 x 80 equal cells the Nusselt
        // number at 1e6 is 2.2 % above the published one; at the other three all holds within 1 %.
        int const cells = 80;
        double const expansion = rayleigh * viscosity * alpha / 9.81;  // of 1 K over 1 m at 9.81 m/s2
        auto text = scene::gas_in_box(
            {1, 1.0 / cells, 1}, {64, 1, cells}, "\"y\"",
            fmt::format(
                "fine = [{{axis = \"x\", lower = \"0 m\", upper = \"0.06 m\", cell_size = \"0.006 m\", growth = 1.1}}, "
                "{{axis = \"x\", lower = \"0.94 m\", upper = \"1 m\", cell_size = \"0.006 m\", growth = 1.1}}]\n"
                "closed = true\ndensity = \"1 kg/m3\"\nviscosity = \"{} Pa.s\"\nconductivity = \"{} W/m/K\"\n"
                "expansion = \"{} 1/K\"\nexpansion_temperature = \"300 K\"\ntemperature = \"300 K\"\n[[gas.wall]]\nof "
                "= "
                "\"left\"\ntemperature = \"300.5 K\"\n[[gas.wall]]\nof = \"right\"\ntemperature = \"299.5 K\"\n",
                viscosity, conductivity, expansion));
        text.replace(0, text.find('\n'), "gravity = [\"0 m/s2\", \"0 m/s2\", \"-9.81 m/s2\"]");
        auto const simulation = scene::simulation_of(text);
        double const speed = alpha * std::max(1.0, table.number(row, "v_max"));
        scene::run_to_rest(*simulation, std::min(0.5 / cells / speed, 2.0 / alpha / cells),
                           30 / std::sqrt(rayleigh / 1e3), 1e-6 * speed, 0.6 / alpha);
        auto const& grid = simulation->grid();
        auto const& gas = simulation->gas();
        // Heat that enters through the hot wall, and the mean over all vertical planes of what is carried and
        // conducted.
        double hot = 0, mean = 0, planes = 0;
        auto const &x = grid.axes[0], &z = grid.axes[2];
        ASSERT_EQ(grid.n[0] % 2, 0);
        ASSERT_NEAR(x.face(grid.n[0] / 2), 0.5, 1e-9);
        for (int k = 0; k < grid.n[2]; ++k)
            hot += (300.5 - gas.temperature[grid.at(0, 0, k)]) / (0.5 * x.width(0)) * z.width(k);
        for (int i = 1; i < grid.n[0]; ++i) {
            double const at = (x.face(i) - x.centre(i - 1)) / x.gap(i);
            for (int k = 0; k < grid.n[2]; ++k) {
                auto const c = grid.at(i, 0, k), low = grid.before(c, 0);
                double const rise = gas.temperature[c] - gas.temperature[low];
                double const carried = gas.velocity[0][c] * (gas.temperature[low] + at * rise - 300) / alpha;
                mean += (carried - rise / x.gap(i)) * z.width(k) * x.gap(i);
            }
            planes += x.gap(i);
        }
        mean /= planes;
        auto const lines = middle_lines(*simulation, 0);
        auto const [u_max, at_z] = lines.u.largest();
        auto const [w_max, at_x] = lines.w.largest();
        auto const say = [&](char const* what) {
            return fmt::format("heated cavity, Ra {}, {} x {}, finer at the sides: {}", rayleigh, grid.n[0], grid.n[2],
                               what);
        };
        verify::relative("CFD08", say("mean Nusselt number"), table.number(row, "Nu_mean"), mean, 0.01);
        verify::relative("CFD08", say("Nusselt number of the hot wall"), table.number(row, "Nu_hot_wall"), hot, 0.01);
        verify::relative("CFD08", say("largest horizontal velocity on the vertical middle, L/alpha"),
                         table.number(row, "u_max"), u_max / alpha, 0.01);
        verify::absolute("CFD08", say("its height"), table.number(row, "y_of_u_max"), at_z, 0.01);
        verify::relative("CFD08", say("largest vertical velocity on the horizontal middle, L/alpha"),
                         table.number(row, "v_max"), w_max / alpha, 0.01);
        verify::absolute("CFD08", say("its place"), table.number(row, "x_of_v_max"), at_x, 0.01);
    }
}
}
