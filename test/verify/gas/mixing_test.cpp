// Reference case CFD-05: three equal streams of gases of 1, 10 and 25 kg/kmol mix; and waves of humidity, for their
// order.
#include "granum/grid/halo.hpp"
#include "granum/material/moist_air.hpp"
#include "granum/math/constants.hpp"
#include "scene/flow.hpp"
#include "scene/reference.hpp"
#include "unit/gas/chamber_with_gas.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;

TEST(Streams, of_three_gases_leave_in_the_shares_of_their_molar_masses)
{
    // The lightest is the dry gas, the second stands in for the vapour, the heaviest is the tracer.
    std::string inlets;
    for (int k = 0; k < 3; ++k)
        inlets += fmt::format(
            "[[inlet]]\nname = \"stream-{0}\"\nend = \"left\"\nvelocity = \"0.25 m/s\"\nlower = [\"0 m\", \"0 m\", "
            "\"{1} "
            "m\"]\nupper = [\"0 m\", \"0.01 m\", \"{2} m\"]\nhumidity = {3}\ntracer = {4}\n",
            k, 0.01 * k, 0.01 * (k + 1), k == 1 ? 1e12 : 0.0, k == 2 ? 1 : 0);
    auto const simulation = scene::simulation_of(
        scene::gas_in_box({2, 0.01, 0.03}, {200, 1, 3}, "\"y\", \"z\"",
                          "compressibility = \"low-mach\"\nmolar_mass = \"1 g/mol\"\nvapour_molar_mass = \"10 "
                          "g/mol\"\ndiffusivity = \"1e-3 "
                          "m2/s\"\nviscosity = \"1e-5 Pa.s\"\npressure = \"101000 Pa\"\ntemperature = \"293.15 "
                          "K\"\n[gas.tracer]\ndiffusivity = "
                          "\"1e-3 m2/s\"\nmolar_mass = \"25 g/mol\"\n" +
                              inlets + "[[outlet]]\nend = \"right\"\nresistance = \"0 Pa.s/m\"\n"));
    while (simulation->time() < 1) simulation->step(0.002);  // the light gas of the beginning is driven out
    while (simulation->time() < 24) simulation->step(0.02);
    auto const& grid = simulation->grid();
    std::array<double, 3> shares{};
    double flow = 0;
    for (int k = 0; k < 3; ++k) {
        auto const c = grid.at(199, 0, k);
        double const w = simulation->gas().vapour_fraction[c], t = simulation->gas().tracer_fraction[c];
        double const passes = simulation->gas().mass_flux[0][grid.next(c, 0)];
        shares[0] += passes * (1 - w - t), shares[1] += passes * w, shares[2] += passes * t;
        flow += passes;
    }
    std::array const expected{0.0277777778, 0.2777777778, 0.6944444444};
    for (std::size_t s = 0; s < 3; ++s)
        verify::absolute({"CFD05", "MFIX 3.3e-6"}, fmt::format("three streams: share {} at the outlet, kg/kg", s + 1),
                         expected[s], shares[s] / flow, 1e-5);
}

//! Root mean square error of a wave of the tracer carried once around a periodic box, and how far it left [0.2, 0.8].
std::array<double, 2> carried(int cells, double courant, bool smooth)
{
    gas::Settings settings{
        .outlets = {}, .gravity = {}, .density = 1.2, .viscosity = 1e-9, .tracer = gas::Tracer{1e-12, {}}};
    gas::ChamberWithGas run({.size = {1, 1.0 / cells, 1.0 / cells}}, {cells, 1, 1}, {true, true, true}, settings,
                            293.15, 0, {1, 0, 0});
    auto const wave = [&](double x) {
        double const s = std::sin(2 * math::pi * x);
        return 0.5 + 0.3 * (smooth ? s : s > 0 ? 1 : -1);
    };
    auto const place = [&](int i) { return (i + 0.5) / cells; };
    grid::for_each_cell(run.grid, [&](int i, int, int, grid::Index c) {
        run.state.tracer_fraction[c] = wave(place(i));
        run.state.tracer[c] = run.state.tracer_fraction[c] * run.state.mass[c];
    });
    grid::refresh(run.grid, {&run.state.tracer, &run.state.tracer_fraction});
    run.state.tracer_fractions = {0.2, 0.8};
    int const steps = static_cast<int>(std::lround(cells / courant));
    for (int step = 0; step < steps; ++step) run.step(1.0 / steps);
    double squares = 0, beyond = 0;
    grid::for_each_cell(run.grid, [&](int i, int, int, grid::Index c) {
        double const x = run.state.tracer_fraction[c];
        squares += std::pow(x - wave(place(i)), 2) / cells;
        beyond = std::max({beyond, x - 0.8, 0.2 - x});
    });
    return {std::sqrt(squares), beyond};
}

TEST(Tracer, is_carried_with_second_order_where_it_is_smooth_and_never_beyond_its_bounds)
{
    for (double const courant : {0.5, 1.0}) {
        double coarser = 0;
        for (int const cells : {32, 64, 128}) {
            auto const [error, beyond] = carried(cells, courant, true);
            if (coarser > 0)
                verify::between(
                    "N01",
                    fmt::format("sine of a tracer, once around, Courant number {}: order from {} to {} cells", courant,
                                cells / 2, cells),
                    1.8, 2.4, std::log2(coarser / error));
            coarser = error;
        }
        verify::below("N01",
                      fmt::format("step of a tracer, once around, Courant number {}: largest overshoot", courant),
                      1e-12, carried(64, courant, false)[1]);
    }
    verify::below("N01", "step of a tracer, once around, Courant number 8: largest overshoot", 1e-12,
                  carried(64, 8, false)[1]);
}
}
