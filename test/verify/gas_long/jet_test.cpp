// Reference case CFD-12: a round free jet with k-epsilon, whose spread is known to be too wide.
#include "granum/math/constants.hpp"
#include "scene/flow.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;

TEST(Jet, spreads_as_fast_as_k_epsilon_is_known_to)
{
    // A quarter of the jet: mouth of 10 mm in the corner, 30 m/s, Re = 2e4. Gas is drawn in through the far sides.
    double const mouth = 0.01, speed = 30;
    std::string text = scene::gas_in_box(
        {0.16, 0.16, 0.4}, {12, 12, 64}, "",
        fmt::format(
            "density = \"1.2 kg/m3\"\nviscosity = \"1.8e-5 Pa.s\"\nturbulence = \"k-epsilon\"\nfine = [{{axis = "
            "\"x\", lower = \"0 mm\", upper = \"7.5 mm\", cell_size = \"1.25 mm\", growth = 1.15}}, {{axis = "
            "\"y\", lower = \"0 mm\", upper = \"7.5 mm\", cell_size = \"1.25 mm\", growth = 1.15}}]\n"
            "[[gas.wall]]\nof = \"left\"\nslip = true\n[[gas.wall]]\nof = \"front\"\nslip = true\n[[gas.wall]]\n"
            "of = \"bottom\"\nslip = true\n[[inlet]]\nend = \"bottom\"\ncentre = [\"0 m\", \"0 m\", \"0 m\"]\n"
            "diameter = \"{} m\"\ndry_mass_flow = \"{} kg/s\"\n[[outlet]]\nend = \"top\"\nresistance = \"0 Pa.s/m\"\n"
            "[[outlet]]\nend = \"right\"\nresistance = \"0 Pa.s/m\"\n[[outlet]]\nend = \"back\"\nresistance = "
            "\"0 Pa.s/m\"\n",
            mouth, 1.2 * speed * math::pi / 16 * mouth * mouth));
    // Courant number 0.7: of 2.4 the core of the jet sheds rings that carry off what the model should, and the spread
    // is that of neither.
    text.insert(text.find("[gas]"), "gas_step = \"0.15 ms\"\n");
    auto const simulation = scene::simulation_of(text);
    while (simulation->time() < 0.15) simulation->step(1e9);
    auto const& grid = simulation->grid();
    auto const& w = simulation->gas().velocity[2];
    // On the axis and half-widths, from 15 to 30 mouths downstream.
    auto const half_width = [&](int k) {
        double const centre = w[grid.at(0, 0, k)];
        for (int i = 1; i < grid.n[0]; ++i) {
            double const inner = w[grid.at(i - 1, 0, k)], outer = w[grid.at(i, 0, k)];
            if (outer > 0.5 * centre) continue;
            double const part = (inner - 0.5 * centre) / (inner - outer);
            return grid.axes[0].centre(i - 1) + part * (grid.axes[0].centre(i) - grid.axes[0].centre(i - 1));
        }
        return grid.axes[0].centre(grid.n[0] - 1);
    };
    double points = 0, z1 = 0, z2 = 0, r1 = 0, zr = 0, d1 = 0, zd = 0;
    for (int k = 0; k < grid.n[2]; ++k) {
        double const z = grid.axes[2].face(k);
        if (z < 15 * mouth || z > 30 * mouth) continue;
        double const r = half_width(k), decay = speed / w[grid.at(0, 0, k)];
        points += 1, z1 += z, z2 += z * z, r1 += r, zr += z * r, d1 += decay, zd += z * decay;
    }
    double const below = points * z2 - z1 * z1;
    double const slope = (points * zr - z1 * r1) / below, decay = (points * zd - z1 * d1) / below * mouth;
    verify::between({"CFD12", "measured 0.094 to 0.102; k-epsilon 15 to 40 % more"},
                    "round jet, k-epsilon: slope of the half-width", 1.15 * 0.094, 1.4 * 0.102, slope);
    // Momentum is kept: what spreads faster decays faster by as much.
    verify::between({"CFD12", "measured 1/6.1 to 1/5.8"}, "round jet, k-epsilon: slope of the decay on the axis",
                    1.15 / 6.1, 1.4 / 5.8, decay);
}
}
