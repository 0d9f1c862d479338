// Row P12: a sphere released from rest in a liquid at rest, with Stokes' drag, virtual mass and Basset's history force,
// stated as a case and moved by the step of `granum run`, against the Laplace transform of the motion.
#include "scene/case_text.hpp"
#include "table.hpp"

namespace
{
using namespace granum;

//! U(s) = 1 / (s (s + sqrt(kappa s) + 1)), U = v / v_t at T = t / tau, inverted numerically by an independent program;
//! kappa = 9 rho / (2 rho_p + rho), tau = (2 rho_p + rho) a^2 / (9 mu).
struct Released
{
    double kappa;
    std::array<double, 6> speed;
};
constexpr std::array<double, 6> times{0.1, 0.5, 1, 2, 5, 10};
constexpr std::array released{Released{0.01, {0.09301, 0.37626, 0.59922, 0.81935, 0.95970, 0.97970}},
                              Released{0.5, {0.08163, 0.29620, 0.45445, 0.62248, 0.79051, 0.86324}},
                              Released{1, {0.07700, 0.26821, 0.40676, 0.55811, 0.72683, 0.81308}}};

//! Largest share by which speeds are off, with `per_tau` steps of the gas per tau.
double off(Released const& row, int per_tau, int window)
{
    double const density = 1000, viscosity = 0.1, a = 0.5e-3;
    double const solid = (9 * density / row.kappa - density) / 2;
    double const tau = (2 * solid + density) * a * a / (9 * viscosity);
    // A weight that carries it 4 mm in a tau at its terminal speed: Stokes' drag knows no Reynolds number.
    double const terminal = 4e-3 / tau, g = terminal * viscosity / (2.0 / 9 * (solid - density) * a * a);
    auto const simulation = scene::simulation_of(
        fmt::format("gravity = [\"0 m/s2\", \"0 m/s2\", \"{} m/s2\"]\n", -g) +
        "[apparatus]\nshape = \"box\"\nsize = " + scene::vector_text({0.3, 0.3, 0.3}, "m") + "\n" +
        fmt::format("[granules]\ndiameter = \"1 mm\"\ndensity = \"{} kg/m3\"\nstart = \"given\"\n", solid) +
        fmt::format("[gas]\nclosed = true\ndensity = \"{} kg/m3\"\nviscosity = \"{} Pa.s\"\ndrag = \"stokes\"\n"
                    "virtual_mass = \"constant\"\nhistory = {}\nsmoothing = \"0 mm\"\ncells = [3, 3, 3]\n",
                    density, viscosity, window) +
        fmt::format("[time]\nduration = \"1 s\"\ngas_step = \"{} s\"\n", tau / per_tau) +
        "[[granule]]\nposition = [\"0.15 m\", \"0.15 m\", \"0.15 m\"]\n");
    double worst = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        double const goal = times[i] * tau;
        while (simulation->time() < goal * (1 - 1e-9))
            simulation->step(std::min(tau / per_tau, goal - simulation->time()));
        double const speed = -simulation->granules().velocity[0].z / terminal;
        worst = std::max(worst, std::abs(speed / row.speed[i] - 1));
    }
    return worst;
}

TEST(ReleasedSphere, speeds_up_against_its_history_as_the_closed_form)
{
    for (auto const& row : released) {
        verify::below(
            "P12",
            fmt::format("sphere released in a liquid, kappa {}: speed at 0.1 to 10 tau, largest share off", row.kappa),
            0.01, off(row, 200, 50));
    }
}
}
