// Reference cases CFD-09 and CFD-10: the decay of Taylor and Green's vortex, and a manufactured solution of the
// volume-averaged equations with a voidage field. Both need fields at the start or forces that no case can tell.
#include "granum/grid/halo.hpp"
#include "granum/math/constants.hpp"
#include "scene/reference.hpp"
#include "unit/gas/chamber_with_gas.hpp"
#include "verify/table.hpp"

#include <functional>

namespace
{
using namespace granum;
using math::Vec3;
using Function = std::function<double(double x, double z)>;

//! Sets u_x, u_z and p of flow in the x-z plane, and the mass fluxes that go with them.
void set_plane_flow(gas::ChamberWithGas& run, Function const& u, Function const& w, Function const& p)
{
    auto& state = run.state;
    auto const& [x, y, z] = run.grid.axes;
    grid::for_each_cell(run.grid, [&](int i, int j, int k, grid::Index c) {
        state.velocity[0][c] = u(x.face(i), z.centre(k));
        state.velocity[2][c] = w(x.centre(i), z.face(k));
        state.pressure[c] = p(x.centre(i), z.centre(k));
        state.mass_flux[0][c] = state.velocity[0][c] * y.width(j) * z.width(k);
        state.mass_flux[2][c] = state.velocity[2][c] * y.width(j) * x.width(i);
    });
    for (std::size_t d = 0; d < 3; ++d) grid::refresh(run.grid, {&state.velocity[d], &state.mass_flux[d]});
    grid::refresh(run.grid, {&state.pressure});
    state.earlier_flux = state.mass_flux;
}

struct Decayed
{
    double energy, error;  //!< mean kinetic energy per mass, root mean square error of the velocity
};

//! A vortex of size 2 pi in a stream (U, U), after `time` seconds.
Decayed vortex(int cells, double viscosity, double stream, double courant, double time)
{
    double const length = 2 * math::pi, h = length / cells;
    gas::Settings settings{.outlets = {}, .gravity = {}, .density = 1.0, .viscosity = viscosity, .tolerance = 1e-9};
    gas::ChamberWithGas run({.size = {length, h, length}}, {cells, 1, cells}, {true, true, true}, settings);
    auto const u = [&](double x, double z, double t) {
        return stream + std::cos(x - stream * t) * std::sin(z - stream * t) * std::exp(-2 * viscosity * t);
    };
    auto const w = [&](double x, double z, double t) {
        return stream - std::sin(x - stream * t) * std::cos(z - stream * t) * std::exp(-2 * viscosity * t);
    };
    set_plane_flow(
        run, [&](double x, double z) { return u(x, z, 0); }, [&](double x, double z) { return w(x, z, 0); },
        [](double x, double z) { return -0.25 * (std::cos(2 * x) + std::cos(2 * z)); });
    int const steps = static_cast<int>(std::ceil(time * (1 + stream) / (courant * h)));
    for (int step = 0; step < steps; ++step) run.step(time / steps);
    Decayed out{};
    double const each = 1.0 / (cells * cells);
    auto const& [ax, ay, az] = run.grid.axes;
    grid::for_each_cell(run.grid, [&](int i, int, int k, grid::Index c) {
        double const a = run.state.velocity[0][c], b = run.state.velocity[2][c];
        out.energy += 0.5 * each * (std::pow(a - stream, 2) + std::pow(b - stream, 2));
        out.error += each * (std::pow(a - u(ax.face(i), az.centre(k), time), 2) +
                             std::pow(b - w(ax.centre(i), az.face(k), time), 2));
    });
    out.error = std::sqrt(out.error);
    return out;
}

TEST(Vortex, of_taylor_and_green_decays_as_it_should)
{
    scene::Table const table("cfd-09.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const time = table.number(row, "t_s"), viscosity = table.number(row, "nu_m2_per_s");
        if (time == 0) continue;
        verify::relative(
            "CFD09", fmt::format("vortex, 64 cells, viscosity {} m2/s, {} s: kinetic energy, m2/s2", viscosity, time),
            table.number(row, "kinetic_energy_per_mass_m2_per_s2"), vortex(64, viscosity, 0, 0.5, time).energy, 0.01);
    }
    for (double const stream : {0.0, 0.7})
        for (double const viscosity : {0.1, 0.01}) {
            double coarser = 0;
            for (int const cells : {32, 64, 128}) {
                double const error = vortex(cells, viscosity, stream, 0.5, 2).error;
                if (coarser > 0)
                    verify::between(
                        "CFD09",
                        fmt::format("vortex in a stream of {} m/s, viscosity {}: order, step with cell, {} to {} cells",
                                    stream, viscosity, cells / 2, cells),
                        1.75, 3.3, std::log2(coarser / error));
                coarser = error;
            }
        }
    // In time alone: the difference between steps of one and two fourths, against two and four fourths.
    auto const at = [](double courant) { return vortex(64, 0.1, 0.7, courant, 2).error; };
    double const fine = at(0.0625), one = at(0.25) - fine, two = at(0.5) - fine;
    verify::between("CFD09", "vortex in a stream of 0.7 m/s: order in the step alone", 1.7, 2.5, std::log2(two / one));
}

// Lethe's case with variable voidage: fields on [-1, 1]^2, the force that makes them a solution.
struct Manufactured
{
    static constexpr double pi = math::pi;
    static double voidage(double x, double z) { return 0.5 + 0.25 * std::sin(pi * x) * std::sin(pi * z); }
    static double u(double x, double z)
    {
        return -2 * std::pow(std::sin(pi * x), 2) * std::sin(pi * z) * std::cos(pi * z);
    }
    static double w(double x, double z)
    {
        return 2 * std::sin(pi * x) * std::cos(pi * x) * std::pow(std::sin(pi * z), 2);
    }
    static double p(double x, double z) { return std::sin(pi * x) * std::sin(pi * z); }

    //! d f/dx, d f/dz and their sum of second derivatives.
    static std::array<double, 3> derivatives(double (*f)(double, double), double x, double z)
    {
        constexpr double h = 1e-4;  // differences of fourth order
        auto const one = [&](double a, double b) {
            auto const at = [&](double s) { return f(x + s * a * h, z + s * b * h); };
            double const first = (at(-2) - 8 * at(-1) + 8 * at(1) - at(2)) / (12 * h);
            double const second = (-at(-2) + 16 * at(-1) - 30 * at(0) + 16 * at(1) - at(2)) / (12 * h * h);
            return std::array{first, second};
        };
        auto const [fx, fxx] = one(1, 0);
        auto const [fz, fzz] = one(0, 1);
        return {fx, fz, fxx + fzz};
    }
    //! Force per volume: eps (u . grad u + grad p - nu lap u), div u = 0 and u . grad eps = 0; of model B the last two
    //! without eps.
    static double force(std::size_t d, double x, double z, bool b)
    {
        auto const [ux, uz, lap] = derivatives(d == 0 ? u : w, x, z);
        auto const slope = derivatives(p, x, z)[d == 0 ? 0 : 1];
        double const eps = voidage(x, z), share = b ? 1 : eps;
        return eps * (u(x, z) * ux + w(x, z) * uz) + share * (slope - lap);
    }
};

//! Errors of velocity and pressure (root mean square) on cells x cells, at rest in time.
std::array<double, 2> manufactured(int cells, bool b)
{
    double const h = 2.0 / cells;
    gas::Settings settings{.outlets = {},
                           .model = b ? gas::Model::b : gas::Model::a,
                           .gravity = {},
                           .density = 1.0,
                           .viscosity = 1.0,
                           .tolerance = 1e-9};
    gas::ChamberWithGas run({.size = {2, h, 2}}, {cells, 1, cells}, {false, true, false}, settings);
    auto const& [x, y, z] = run.grid.axes;
    grid::for_each_cell(run.grid, [&](int i, int j, int k, grid::Index c) {
        double const a = x.centre(i) - 1, b_ = z.centre(k) - 1, volume = run.grid.volume(i, j, k);
        run.voidage[c] = Manufactured::voidage(a, b_);
        for (std::size_t d : {0u, 2u}) run.sources.drag_momentum[d][c] = volume * Manufactured::force(d, a, b_, b);
    });
    run.state = run.solver.start(run.voidage, run.grid.make_field(293.15), 0, {});
    for (int step = 0; step < 100; ++step) run.step(0.5 * h);
    double velocity = 0, pressure = 0, mean = 0;
    double const each = 1.0 / (cells * cells);
    grid::for_each_cell(run.grid, [&](int i, int, int k, grid::Index c) {
        mean += each * (run.state.pressure[c] - Manufactured::p(x.centre(i) - 1, z.centre(k) - 1));
    });
    grid::for_each_cell(run.grid, [&](int i, int, int k, grid::Index c) {
        double const a = run.state.velocity[0][c] - Manufactured::u(x.face(i) - 1, z.centre(k) - 1);
        double const w = run.state.velocity[2][c] - Manufactured::w(x.centre(i) - 1, z.face(k) - 1);
        double const p = run.state.pressure[c] - mean - Manufactured::p(x.centre(i) - 1, z.centre(k) - 1);
        velocity += each * (a * a + w * w);
        pressure += each * p * p;
    });
    // The source integrates over the area of 4 m2.
    return {2 * std::sqrt(velocity), 2 * std::sqrt(pressure)};
}

TEST(Manufactured, flow_through_a_voidage_field_is_of_second_order)
{
    scene::Table const lethe("cfd-10.csv");
    for (bool const b : {false, true}) {
        std::array<double, 2> coarser{};
        for (std::size_t row = 0; row < 3; ++row) {
            int const cells = 16 << row;
            auto const error = manufactured(cells, b);
            char const* const model = b ? "B" : "A";
            verify::below(
                {"CFD10", fmt::format("Lethe (A) {}", lethe.text(row, "L2_velocity"))},
                fmt::format("voidage field, model {}, {} x {} cells: error of the velocity, m/s", model, cells, cells),
                lethe.number(row, "L2_velocity") * 3, error[0]);
            verify::below(
                {"CFD10", fmt::format("Lethe (A) {}", lethe.text(row, "L2_pressure"))},
                fmt::format("voidage field, model {}, {} x {} cells: error of the pressure, Pa", model, cells, cells),
                lethe.number(row, "L2_pressure") * 3, error[1]);
            if (row > 0) {
                verify::between({"CFD10", "Lethe 1.91, 1.96; MFIX MMS03 1.98 to 2.05"},
                                fmt::format("voidage field, model {}: order of the velocity to {} cells", model, cells),
                                1.8, 2.6, std::log2(coarser[0] / error[0]));
                verify::between({"CFD10", "Lethe 1.5, 1.6"},
                                fmt::format("voidage field, model {}: order of the pressure to {} cells", model, cells),
                                1, 2.6, std::log2(coarser[1] / error[1]));
            }
            coarser = error;
        }
    }
}
}
