// Rows P10 and D10: a granular gas that cools by its collisions, in a periodic cube stated as a case and moved by the
// step of `granum run`, against Haff's law (J. Fluid Mech. 134 (1983) 401) with Enskog's collision rate.
//
// The softness of the spheres is chosen so that a contact takes about a hundredth of the time between two contacts:
// harder spheres change nothing but the number of steps.
#include "granum/base/random.hpp"
#include "scene/case_text.hpp"
#include "scene/reference.hpp"
#include "table.hpp"

#include "granum/particle/store.hpp"

namespace
{
using namespace granum;
using namespace verify;
using math::Vec3;

constexpr double density = 1000;  //!< kg/m3

struct Gas
{
    double diameter, solids, temperature;  //!< m, 1, m2/s2 (mean square of one component)
    int edge;                              //!< granules along an edge
    double rate;                           //!< collisions of a granule at the start, 1/s
    double size() const { return edge * diameter * std::cbrt(math::pi / (6 * solids)); }
};

//! Rows of a granule file.
struct State
{
    std::vector<Vec3> position, velocity;

    //! Takes out the mean velocity and scales the rest to the temperature.
    void scale(double temperature)
    {
        Vec3 mean;
        for (auto const& v : velocity) mean += v * (1.0 / static_cast<double>(velocity.size()));
        double sum = 0;
        for (auto& v : velocity) v -= mean, sum += norm2(v);
        double const factor = std::sqrt(3 * temperature * static_cast<double>(velocity.size()) / sum);
        for (auto& v : velocity) v *= factor;
    }
};

State lattice(Gas const& gas, std::uint32_t seed)
{
    State state;
    double const spacing = gas.size() / gas.edge;
    for (int k = 0; k < gas.edge; ++k)
        for (int j = 0; j < gas.edge; ++j)
            for (int i = 0; i < gas.edge; ++i) {
                base::Random random(seed, base::Purpose::test, state.position.size(), 0);
                state.position.push_back({(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing});
                state.velocity.push_back({random.normal(), random.normal(), random.normal()});
            }
    state.scale(gas.temperature);
    return state;
}

std::unique_ptr<sim::Simulation> simulate(Gas const& gas, State const& state, double restitution)
{
    double const mass = density * math::pi / 6 * std::pow(gas.diameter, 3), speed = std::sqrt(gas.temperature);
    double const duration = 1 / (60 * gas.rate);
    double const modulus = std::sqrt(std::pow(2.87 / duration, 5) * mass * mass / 4 / (gas.diameter / 4 * speed));
    std::string text = "gravity = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n[apparatus]\nshape = \"box\"\n";
    text += "periodic = [\"x\", \"y\", \"z\"]\nsize = " + scene::vector_text({gas.size(), gas.size(), gas.size()}, "m");
    text += fmt::format(
        "\n[granules]\ndiameter = \"{} m\"\ndensity = \"{} kg/m3\"\nstart = \"given\"\nfile = \"granules.csv\"\n",
        gas.diameter, density);
    text += fmt::format(
        "[contact]\nyoungs_modulus = \"{} Pa\"\npoisson_ratio = 0\nrestitution = {}\nsliding_friction = 0\n"
        "rolling_friction = 0\n",
        2 * modulus, restitution);
    text += fmt::format("[time]\nduration = \"100 s\"\ngranule_step = \"{} s\"\n", duration / 24);
    std::string rows = "id,x,y,z,radius,vx,vy,vz\n";
    for (std::size_t k = 0; k < state.position.size(); ++k) {
        auto const &p = state.position[k], &v = state.velocity[k];
        rows += fmt::format("{},{},{},{},{},{},{},{}\n", k, p.x, p.y, p.z, gas.diameter / 2, v.x, v.y, v.z);
    }
    return scene::simulation_of(text, rows);
}

double temperature(particle::Store const& granules)
{
    double sum = 0;
    for (std::size_t row = 0; row < granules.owned; ++row) sum += norm2(granules.velocity[row]);
    return sum / (3 * static_cast<double>(granules.owned));
}

//! A gas without order in its places: elastic spheres from a lattice after some ten collisions each.
State mixed(Gas const& gas, std::uint32_t seed)
{
    auto const elastic = simulate(gas, lattice(gas, seed), 1);
    while (elastic->time() < 10 / gas.rate) elastic->step(elastic->granule_dt());
    State state;
    auto const& granules = elastic->granules();
    double const edge = gas.size();
    for (std::size_t row = 0; row < granules.owned; ++row) {
        Vec3 at = granules.position[row];
        for (std::size_t d = 0; d < 3; ++d)
            at[d] = std::min(at[d] - edge * std::floor(at[d] / edge), edge * (1 - 1e-12));
        state.position.push_back(at);
        state.velocity.push_back(granules.velocity[row]);
    }
    state.scale(gas.temperature);
    return state;
}

TEST(CoolingGas, starts_to_cool_at_the_rate_of_haff)
{
    Gas const gas{.diameter = 1e-3, .solids = 0.05, .temperature = 0.01, .edge = 10, .rate = 76.991};
    double mean = 0;
    int const seeds = 5;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        auto const simulation = simulate(gas, mixed(gas, seed), 0.9);
        while (simulation->time() < 0.2) simulation->step(simulation->granule_dt());
        // T = T0 / (1 + rate t / 2)^2
        mean += 2 * (std::sqrt(gas.temperature / temperature(simulation->granules())) - 1) / simulation->time() / seeds;
    }
    relative("P10", "gas of 0.05 solids, restitution 0.9: initial -d ln T/dt, mean of 5 seeds, 1/s", 4.876, mean, 0.10);
}

TEST(CoolingGas, follows_the_law_of_haff)
{
    scene::Table const table("dem-10.csv");
    for (std::size_t const row : {std::size_t{0}}) {
        // The law knows no time but that of the first temperature: a faster gas goes through the same states sooner.
        double const sooner = std::sqrt(table.number(row, "T0_m2_per_s2") / 1.0);
        Gas const gas{.diameter = table.number(row, "d_m"),
                      .solids = table.number(row, "phi"),
                      .temperature = 1,
                      .edge = 13,
                      .rate = table.number(row, "collision_rate0_per_s") / sooner};
        double const tau = table.number(row, "tau_s") * sooner;
        double const e = table.number(row, "e");
        auto const simulation = simulate(gas, mixed(gas, 7), e);
        for (double const at : {1.0, 2.0, 4.9}) {
            while (simulation->time() < at * tau) simulation->step(simulation->granule_dt());
            relative("D10",
                     fmt::format("gas of {} solids, restitution {}: temperature at {} tau over that at the start",
                                 gas.solids, e, at),
                     1 / std::pow(1 + simulation->time() / tau, 2),
                     temperature(simulation->granules()) / gas.temperature, 0.05);
        }
    }
}
}
