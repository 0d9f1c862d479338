// Reference case CFD-07: how far behind a step the flow lies down again.
#include "scene/flow.hpp"
#include "scene/reference.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;

//! Where the gas along the floor behind the step turns, in heights of the step. Half of the channel before the step is
//! closed by a body of `before` heights; `cells` to a height of the step.
double reattachment(double reynolds, int cells, double behind)
{
    double const before = 3, h = 1;
    int const along = static_cast<int>(std::lround((before + behind) * cells));
    // Re = 2 h U / nu with the mean velocity U of the narrow part.
    auto text = scene::gas_in_box(
        {before + behind, 1.0 / cells, 2 * h}, {along, 1, 2 * cells}, "",
        fmt::format(
            "density = \"1 kg/m3\"\nviscosity = \"{} Pa.s\"\ntolerance = 1e-5\n[[gas.wall]]\nof = \"front\"\nslip = "
            "true\n[[gas.wall]]\nof = \"back\"\nslip = true\n",
            2 * h / reynolds));
    text += fmt::format(
        "[[internal]]\nname = \"step\"\nshape = \"box\"\nlower = [\"-1 m\", \"-1 m\", \"-1 m\"]\nupper = [\"{} m\", "
        "\"1 m\", "
        "\"{} m\"]\n[[inlet]]\nend = \"left\"\nlower = [\"0 m\", \"0 m\", \"{} m\"]\nupper = [\"0 m\", \"{} m\", \"{} "
        "m\"]\n"
        "profile = \"parabolic\"\nvelocity = \"1 m/s\"\n[[outlet]]\nend = \"right\"\nresistance = \"0 Pa s/m\"\n",
        before, h, h, 1.0 / cells, 2 * h);
    auto const simulation = scene::simulation_of(text);
    scene::run_to_rest(*simulation, 0.5 / cells, 5, 2e-4, 400);
    auto const& grid = simulation->grid();
    auto const& u = simulation->gas().velocity[0];
    for (int i = static_cast<int>(before * cells) + cells; i + 1 < along; ++i) {
        double const here = u[grid.at(i, 0, 0)], next = u[grid.at(i + 1, 0, 0)];
        if (here < 0 && next >= 0) return (i + here / (here - next)) / cells - before;
    }
    return 0;
}

TEST(BackwardStep, flow_lies_down_where_erturk_has_it)
{
    scene::Table const table("cfd-07.csv");
    struct Run
    {
        double reynolds, behind;
        char const* lethe;
    };
    for (auto const& [reynolds, behind, lethe] :
         {Run{100, 12, "Lethe 1 %"}, Run{200, 16, ""}, Run{400, 24, "Lethe 1.3 %"}}) {
        double published = 0;
        for (std::size_t row = 0; row < table.rows(); ++row)
            if (table.text(row, "dataset") == "erturk_2008_cfd" && table.number(row, "Re") == reynolds)
                published = table.number(row, "xr_over_h");
        double const coarse = reattachment(reynolds, 8, behind), fine = reattachment(reynolds, 16, behind);
        verify::relative(
            {"CFD07", lethe},
            fmt::format("step, Re {}: length behind it over its height, 16 cells to a height (8 cells: {:.3f})",
                        reynolds, coarse),
            published, fine, 0.03);
    }
}
}
