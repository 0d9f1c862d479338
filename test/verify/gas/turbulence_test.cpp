// Turbulence: decay (row P14), the channel of reference case CFD-06, spread of what follows the gas (row P15); and flow
// between plates of a liquid that thins.
#include "granum/base/random.hpp"
#include "granum/law/dispersion/langevin.hpp"
#include "scene/flow.hpp"
#include "scene/reference.hpp"
#include "unit/gas/chamber_with_gas.hpp"
#include "verify/table.hpp"

namespace
{
using namespace granum;

TEST(Decay, of_turbulence_follows_its_power_law)
{
    // k = (1 + 0.92 t)^(-1/0.92) m2/s2 with k = epsilon = 1 at the start: 0.49211 at 1 s, by hand.
    gas::Settings settings{.outlets = {}, .gravity = {}, .density = 1.2, .viscosity = 1.8e-5};
    settings.turbulence.model = law::turbulence::KEpsilon{};
    settings.turbulence.energy = 1;
    settings.turbulence.length = std::pow(0.09, 0.75);
    double coarser = 0;
    for (int const steps : {100, 200, 400}) {
        gas::ChamberWithGas run({.size = {1, 1, 1}}, {4, 2, 2}, {true, true, true}, settings, 293.15, 0, {0.5, 0, 0});
        for (int step = 0; step < steps; ++step) run.step(1.0 / steps);
        double const k = run.at(run.state.energy_of_eddies, 1, 1, 1), error = k / 0.49211 - 1;
        if (steps == 400)
            verify::relative("P14", "decay of turbulence, 400 steps: k after 1 s, m2/s2", 0.49211, k, 0.01);
        if (coarser > 0)
            verify::between("P14", fmt::format("decay of turbulence: order in the step, {} to {}", steps / 2, steps),
                            0.9, 1.2, std::log2(coarser / error));
        coarser = error;
    }
}

TEST(Spread, of_what_follows_the_gas_is_that_of_taylor)
{
    // sigma = 1 m/s, T = 0.1 s, 10 s: 2 sigma^2 T (t - T (1 - exp(-t/T))) = 1.98 m2, through a step of a fifth of T.
    law::dispersion::Langevin const law;
    law::dispersion::Turbulence const gas{.energy = 1.5, .dissipation = law.time_ratio * 1.5 / 0.1};
    double const step = 0.02;
    int const tracers = 20000, steps = 500, lag = 5;
    double spread = 0, variance = 0, together = 0;
    for (int tracer = 0; tracer < tracers; ++tracer) {
        base::Random random(1, base::Purpose::dispersion, static_cast<std::uint64_t>(tracer), 0);
        auto const normals = [&] {
            double const x = random.normal(), y = random.normal(), z = random.normal();
            return math::Vec3{x, y, z};
        };
        law::dispersion::Eddy eddy{normals(), 0};
        math::Vec3 way, before;
        for (int k = 0; k < steps; ++k) {
            math::Vec3 const u = law(eddy, gas, step, normals());
            way += step * u;
            if (k == steps - 1 - lag) before = u;
            if (k == steps - 1) variance += math::norm2(u) / 3, together += math::dot(u, before) / 3;
        }
        spread += math::norm2(way) / 3;
    }
    verify::relative("P15", "Langevin, 60 000 components: mean square of the way after 10 s, m2", 1.98,
                     spread / tracers, 0.03);
    verify::relative("P15", "Langevin: variance of the velocity, m2/s2", 1, variance / tracers, 0.03);
    verify::absolute("P15", "Langevin: correlation over one Lagrangian time, exp(-1)", std::exp(-1.0),
                     together / variance, 0.02);
}

constexpr double u_tau = 0.0543496, viscosity = 1e-4;

//! Velocity along z over u_tau in the half of a channel from its wall to its middle, at rest in time.
scene::Line half_channel(int cells, std::string const& model, std::string const& fine = "")
{
    auto const simulation = scene::simulation_of(scene::gas_in_box(
        {1, 1.0 / cells, 1.0 / cells}, {cells, 1, 1}, "\"y\", \"z\"",
        fmt::format("closed = true\ndensity = \"1 kg/m3\"\nviscosity = \"{} Pa.s\"\npush = [\"0 Pa/m\", \"0 Pa/m\", "
                    "\"{} Pa/m\"]\ninitial_velocity = [\"0 m/s\", \"0 m/s\", \"1 m/s\"]\nturbulence = \"{}\"\n"
                    "turbulence_velocity = \"{} m/s\"\n{}[[gas.wall]]\nof = \"right\"\nslip = true\n",
                    viscosity, u_tau * u_tau, model, u_tau, fine)));
    scene::run_to_rest(*simulation, 0.2, 20, 1e-6, 4000);
    auto const& grid = simulation->grid();
    scene::Line line;
    for (int i = 0; i < grid.n[0]; ++i) {
        line.place.push_back(grid.axes[0].centre(i));
        line.value.push_back(simulation->gas().velocity[2][grid.at(i, 0, 0)] / u_tau);
    }
    return line;
}

//! The largest share that `line` is off `direct` beyond y+ = `from`.
double off(scene::Line const& line, scene::Line const& direct, double from)
{
    double worst = 0;
    for (std::size_t i = 0; i < line.place.size(); ++i)
        if (line.place[i] * u_tau / viscosity > from)
            worst = std::max(worst, std::abs(line.value[i] / direct.at(line.place[i]) - 1));
    return worst;
}

TEST(TurbulentChannel, has_the_mean_velocity_of_direct_simulation)
{
    scene::Table const table("cfd-06.csv");
    scene::Line direct;
    for (std::size_t row = 0; row < table.rows(); ++row)
        if (table.text(row, "dataset") == "dns") {
            direct.place.push_back(table.number(row, "y_over_delta"));
            direct.value.push_back(table.number(row, "U_plus"));
        }
    for (std::string const model : {"k-epsilon", "k-omega-sst"})
        for (int const cells : {3, 6, 9})
            verify::below({"CFD06", model == "k-epsilon" ? "MFIX -0.4 to +2.3 %" : ""},
                          fmt::format("channel, Re_tau 543.5, {}, {} cells wide: largest share that U+ is off, y+ > 60",
                                      model, 2 * cells),
                          0.05, off(half_channel(cells, model), direct, 60));
    auto const resolved =
        half_channel(24, "k-omega-sst",
                     "fine = [{axis = \"x\", lower = \"0 m\", upper = \"0.003 m\", cell_size = \"0.0015 m\", growth = "
                     "1.15}]\n");
    verify::below("CFD06", "channel, Re_tau 543.5, k-omega-sst, first cell at y+ 0.4: largest share that U+ is off",
                  0.05, off(resolved, direct, 0));
}

//! Velocity between plates at distance h that a push G drives, by quadrature: the stress G (h/2 - x) is mu(rate) rate.
scene::Line thinning_profile(double height, double push, auto const& stress_of)
{
    auto const rate_at = [&](double x) {
        double const stress = push * (0.5 * height - x);
        double low = 0, high = 1e9;
        for (int k = 0; k < 200; ++k) {
            double const middle = 0.5 * (low + high);
            (stress_of(middle) < stress ? low : high) = middle;
        }
        return 0.5 * (low + high);
    };
    int const pieces = 4000;
    scene::Line line{{0}, {0}};
    for (int k = 0; k < pieces; ++k) {
        double const h = 0.5 * height / pieces, x = k * h;
        line.place.push_back(x + h);
        line.value.push_back(line.value.back() + h / 6 * (rate_at(x) + 4 * rate_at(x + 0.5 * h) + rate_at(x + h)));
    }
    return line;
}

TEST(Plates, with_a_liquid_that_thins_have_the_profile_of_quadrature)
{
    double const height = 0.01, push = 2e4, at_rest = 1, infinite = 0.01, time = 0.1, exponent = 0.4;
    auto const exact = thinning_profile(height, push, [&](double rate) {
        return rate * (infinite + (at_rest - infinite) * std::pow(1 + time * time * rate * rate, 0.5 * (exponent - 1)));
    });
    double coarser = 0;
    for (int const cells : {16, 32, 64}) {
        auto const simulation = scene::simulation_of(scene::gas_in_box(
            {height, height / cells, height / cells}, {cells, 1, 1}, "\"y\", \"z\"",
            fmt::format("closed = true\ndensity = \"1000 kg/m3\"\nviscosity = \"{} Pa.s\"\nviscosity_law = "
                        "\"carreau\"\nviscosity_infinite = \"{} Pa.s\"\nviscosity_time = \"{} s\"\nviscosity_exponent "
                        "= {}\npush = [\"0 Pa/m\", \"0 Pa/m\", \"{} Pa/m\"]\n",
                        at_rest, infinite, time, exponent, push)));
        scene::run_to_rest(*simulation, 0.02, 0.5, 1e-9, 50);
        auto const& grid = simulation->grid();
        double worst = 0;
        for (int i = 0; i < cells / 2; ++i)
            worst = std::max(
                worst, std::abs(simulation->gas().velocity[2][grid.at(i, 0, 0)] - exact.at(grid.axes[0].centre(i))));
        worst /= exact.value.back();
        if (cells == 64)
            verify::below("N03", "plates, liquid that thins, 64 cells: largest error over the largest velocity", 0.005,
                          worst);
        if (coarser > 0)
            verify::between("N03",
                            fmt::format("plates, liquid that thins: order from {} to {} cells", cells / 2, cells), 1.5,
                            2.5, std::log2(coarser / worst));
        coarser = worst;
    }
}
}
