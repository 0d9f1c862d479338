// Rows P13, P16 and P17, minimum fluidisation, and the reference cases of one sphere in a gas stream and of a settling
// suspension: gas and granules together, each stated as a case and moved by the step of `granum run`.
#include "granum/base/random.hpp"
#include "scene/case_text.hpp"
#include "scene/reference.hpp"
#include "table.hpp"

namespace
{
using namespace granum;
using math::Vec3;

//! Rows of granules.csv: `where` visits every place.
template <class Places>
std::string granules_csv(Places const& places, double radius, Vec3 const& velocity = {})
{
    std::string out;
    for (auto const& x : places)
        out += fmt::format("{},{},{},{},{},{},{},{}\n", out.size(), x.x, x.y, x.z, radius, velocity.x, velocity.y,
                           velocity.z);
    return out;
}

std::string box_text(Vec3 const& size, std::string const& periodic)
{
    return "[apparatus]\nshape = \"box\"\nsize = " + scene::vector_text(size, "m") + "\nperiodic = [" + periodic +
           "]\n";
}

std::string granules_text(double diameter, double density)
{
    return fmt::format("[granules]\ndiameter = \"{} m\"\ndensity = \"{} kg/m3\"\nfile = \"granules.csv\"\n", diameter,
                       density);
}

TEST(FixedBed, of_equal_cells_has_the_pressure_drop_of_ergun)
{
    // Voidage 0.42 by two granules in every cell, at a quarter and three quarters of its diagonal.
    double const diameter = 1e-3, phi = 0.58, volume = math::pi / 6 * std::pow(diameter, 3);
    double const edge = std::cbrt(2 * volume / phi);
    int const across = 3, up = 12;
    std::vector<Vec3> places;
    for (int k = 0; k < up; ++k)
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i)
                for (double const at : {0.25, 0.75}) places.push_back(edge * (Vec3(i, j, k) + Vec3(at, at, at)));
    auto const simulation = scene::simulation_of(
        "gravity = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n" +
            box_text({across * edge, across * edge, up * edge}, "\"x\", \"y\"") + granules_text(diameter, 2500) +
            "frozen = true\n[gas]\nvelocity = \"0.3 m/s\"\ndensity = \"1.2 kg/m3\"\nviscosity = \"1.8e-5 Pa.s\"\n"
            "drag = \"ergun\"\n" +
            fmt::format("cells = [{0}, {0}, {1}]\n[time]\nduration = \"1 s\"\ngas_step = \"1 ms\"\n", across, up),
        granules_csv(places, diameter / 2));
    for (int step = 0; step < 50; ++step) simulation->step(1e-3);
    auto const& grid = simulation->grid();
    auto const pressure = [&](int k) { return simulation->gas().pressure[grid.at(1, 1, k)]; };
    EXPECT_NEAR(simulation->gas().voidage[grid.at(1, 1, 5)], 0.42, 1e-12);
    verify::relative("P13", "Ergun, voidage 0.42, 0.3 m/s: pressure drop in the bed, Pa/m", 5157.43,
                     (pressure(3) - pressure(9)) / (6 * edge), 1e-3);
}

TEST(PackedBed, begins_to_float_at_the_speed_of_its_law_and_packing)
{
    double const density = 1.2, viscosity = 1.8e-5, diameter = 0.6e-3, g = math::standard_gravity;
    double const speed = 0.16;  // the bed rests
    int const lowest = 1, highest = 8;
    auto const simulation = scene::simulation_of(
        box_text({0.004, 0.004, 0.04}, "\"x\", \"y\"") +
        "[granules]\ndiameter = \"0.6 mm\"\ndensity = \"1445 kg/m3\"\nmass = \"0.25 g\"\nstart = \"settled\"\n"
        "[contact]\nyoungs_modulus = \"0.2 MPa\"\n[gas]\ndensity = \"1.2 kg/m3\"\nviscosity = \"1.8e-5 Pa.s\"\n"
        "cells = [2, 2, 24]\ndrag = \"ergun\"\n" +
        fmt::format("velocity = \"{} m/s\"\n[time]\nduration = \"1 s\"\ngas_step = \"0.5 ms\"\n", speed));
    while (simulation->time() < 0.15) simulation->step(5e-4);

    auto const& grid = simulation->grid();
    auto const layer = [&](auto const& field, int k) {
        double sum = 0;
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) sum += field[grid.at(i, j, k)] / 4;
        return sum;
    };
    auto const over_layers = [&](auto&& gradient) {
        double sum = 0;
        for (int k = lowest; k <= highest; ++k)
            sum += (k == lowest || k == highest ? 0.5 : 1) * gradient(layer(simulation->gas().voidage, k)) *
                   grid.axes[2].width(0);
        return sum;
    };
    // Ergun's equation as he wrote it (Chem. Eng. Prog. 48 (1952) 89), layer by layer, and the weight of the layers.
    auto const ergun = [&](double u) {
        return over_layers([&](double eps) {
            double const phi = 1 - eps, eps3 = eps * eps * eps;
            return 150 * viscosity * phi * phi * u / (eps3 * diameter * diameter) +
                   1.75 * density * phi * u * u / (eps3 * diameter);
        });
    };
    double const weight = over_layers([&](double eps) { return (1445 - density) * g * (1 - eps); });
    double const drop = layer(simulation->gas().pressure, lowest) - layer(simulation->gas().pressure, highest) -
                        density * g * (highest - lowest) * grid.axes[2].width(0);
    auto const carries = [&](double share) {  // the speed at which the share of Ergun's drop is the weight
        double low = 0, high = 1;
        while (high - low > 1e-9) (share * ergun(0.5 * (low + high)) < weight ? low : high) = 0.5 * (low + high);
        return low;
    };
    verify::relative("X02", "settled bed of 0.6 mm, Ergun, 0.16 m/s: pressure drop of its middle, Pa", ergun(speed),
                     drop, 0.03);
    verify::relative("X02", "settled bed of 0.6 mm, Ergun: minimum fluidisation at its own packing, m/s", carries(1),
                     carries(drop / ergun(speed)), 0.03);
}

struct Box
{
    double rate;           //!< of the slip's decay, 1/s
    double momentum_lost;  //!< largest, relative to what moves
};

//! A periodic box of gas and granules at different speeds; the drag of Stokes has a constant coefficient.
Box decay(double step)
{
    double const diameter = 1e-3, edge = 2e-3, density = 10, end = 0.02;
    int const cells = 4;
    Vec3 const gas{0.5, -0.3, 1}, solid{-0.2, 0.1, 0.4};
    std::vector<Vec3> places;
    for (int k = 0; k < cells; ++k)
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) places.push_back(edge * (Vec3(i, j, k) + Vec3(0.3, 0.4, 0.6)));
    auto const simulation = scene::simulation_of(
        "gravity = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n" +
            box_text({cells * edge, cells * edge, cells * edge}, "\"x\", \"y\", \"z\"") +
            granules_text(diameter, density) +
            "[gas]\nclosed = true\ndensity = \"1.2 kg/m3\"\nviscosity = \"1.8e-5 Pa.s\"\ndrag = \"stokes\"\n"
            "initial_velocity = " +
            scene::vector_text(gas, "m/s") +
            // Nothing touches: soft granules only spare steps, each of which rounds all velocities alike.
            fmt::format("\ncells = [{0}, {0}, {0}]\n[contact]\nyoungs_modulus = \"1 kPa\"\n[time]\nduration = \"1 s\"\n"
                        "gas_step = \"{1} s\"\n",
                        cells, step),
        granules_csv(places, diameter / 2, solid));
    auto const& granules = simulation->granules();
    auto const momentum = [&] {
        Vec3 sum = simulation->solver().momentum(simulation->gas());
        for (std::size_t row = 0; row < granules.owned; ++row)
            // The impulse that granules took beyond what the gas was told is the gas's debt of the next step.
            sum += granules.mass[row] * granules.velocity[row] - granules.drag_impulse[row];
        return sum;
    };
    auto const slip = [&] {
        return simulation->solver().cell_velocity(simulation->gas())[2][simulation->grid().at(1, 1, 1)] -
               granules.velocity[0].z;
    };
    Vec3 const before = momentum();
    double const first = slip();
    Box box{};
    for (int n = 0; n < static_cast<int>(std::lround(end / step)); ++n) {
        simulation->step(step);
        box.momentum_lost = std::max(box.momentum_lost, math::norm(momentum() - before) / math::norm(before));
    }
    box.rate = std::log(first / slip()) / end;
    return box;
}

TEST(PeriodicBox, keeps_its_momentum_while_the_slip_decays_at_the_rate_of_its_drag)
{
    double const phi = math::pi / 6 / 8, eps = 1 - phi;
    double const beta = 18 * 1.8e-5 * eps * phi / 1e-6;
    double const exact = beta * (1 / (phi * 10) + 1 / (eps * 1.2));
    Box const coarse = decay(1e-3), fine = decay(5e-4), finest = decay(2.5e-4);
    verify::below("P16", "periodic box: largest change of the momentum, share", 1e-12,
                  std::max({coarse.momentum_lost, fine.momentum_lost, finest.momentum_lost}));
    double const order = std::log2((coarse.rate - fine.rate) / (fine.rate - finest.rate));
    verify::absolute("P16", "periodic box: order of the time step error", 1, order, 0.1);
    verify::relative("P16", "periodic box: decay of the slip, step to 0, 1/s", exact, 2 * finest.rate - fine.rate,
                     1e-3);
    verify::relative("P16", "periodic box: decay of the slip, step of 0.25 ms, 1/s", exact, finest.rate, 1e-2);
}

//! Temperatures of a hot sphere in a stream of 6 m/s at these times, by steps of 10 ms at most.
std::vector<double> cooled(std::vector<double> const& times, double density, double viscosity, double conductivity)
{
    auto const simulation = scene::simulation_of(
        "gravity = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n" + box_text({0.6, 0.6, 0.6}, "\"x\", \"y\"") +
            granules_text(3.6e-3, 8850) +
            "heat_capacity = \"55 J/kg/K\"\nfrozen = true\n[gas]\nvelocity = \"6 m/s\"\ntemperature = \"298.15 K\"\n"
            "heat_transfer = \"ranz-marshall\"\ncells = [3, 3, 3]\n" +
            fmt::format("density = \"{} kg/m3\"\nviscosity = \"{} Pa.s\"\nconductivity = \"{} W/m/K\"\n", density,
                        viscosity, conductivity) +
            "[start]\nbed_temperature = \"373.15 K\"\n[time]\nduration = \"10 s\"\ngas_step = \"10 ms\"\n",
        granules_csv(std::vector{Vec3{0.3, 0.3, 0.3}}, 1.8e-3));
    std::vector<double> out;
    for (double const time : times) {
        while (simulation->time() < time - 1e-9) simulation->step(std::min(0.01, time - simulation->time()));
        out.push_back(simulation->granules().temperature[0]);
    }
    return out;
}

//! Largest share by which a hot sphere is off the temperatures of a table.
double off_cooling(char const* file, char const* column, double density, double viscosity, double conductivity)
{
    scene::Table const table(file);
    std::vector<double> times;
    for (std::size_t row = 0; row < table.rows(); ++row) times.push_back(table.number(row, "t_s"));
    auto const ours = cooled(times, density, viscosity, conductivity);
    double worst = 0;
    for (std::size_t row = 0; row < table.rows(); ++row)
        worst = std::max(worst, std::abs(ours[row] / table.number(row, column) - 1));
    return worst;
}

TEST(HotSphere, in_a_gas_stream_cools_as_the_reference_cases)
{
    // The gas of all cases has 1006 J/kg/K; that of MFIX 999.06: density and viscosity are scaled so that Reynolds and
    // Prandtl numbers are those of the source.
    double const scaled = 999.06 / 1006, density = 1.1854 * scaled, viscosity = 1.8603e-5 * scaled;
    double const conductivity = 1.2396e-4 * 418.4;
    verify::absolute("P17", "hot sphere, conductivity 0.05186 W/m/K: temperature after 0.1 s, K", 366.8414,
                     cooled({0.1}, density, viscosity, conductivity)[0], 0.05);
    verify::below({"H01", "MFIX 1.8e-5"}, "hot sphere, constants of MFIX: temperatures to 5 s, largest share off", 1e-4,
                  off_cooling("h-01-mfix.csv", "T_analytic_K", density, viscosity, conductivity));
    verify::below({"H01", "MFIX 1.8e-5"}, "hot sphere in air: temperatures to 12 s, largest share off", 1e-4,
                  off_cooling("h-01.csv", "Tp_K", 1.1854, 1.85e-5, 0.026));
}

struct Track
{
    double velocity = 0, position = 0;  //!< largest shares off
};

//! Reference case X-01 with cells of `across` x `across` x 20 mm.
Track track(double across, int cells)
{
    scene::Table const table("x-01.csv");
    auto const simulation = scene::simulation_of(
        "gravity = [\"0 m/s2\", \"0 m/s2\", \"-9.80665 m/s2\"]\n" +
            box_text({cells * across, cells * across, 0.12}, "\"x\", \"y\"") + granules_text(1e-4, 2000) +
            "[gas]\nvelocity = \"0.4 m/s\"\ndensity = \"1.2 kg/m3\"\nviscosity = \"1.8e-5 Pa.s\"\n"
            "drag = \"schiller-naumann\"\n" +
            fmt::format("cells = [{0}, {0}, {1}]\n[time]\nduration = \"1 s\"\ngas_step = \"0.1 ms\"\n", cells,
                        std::lround(0.12 / std::min(across, 0.02))),
        granules_csv(std::vector{Vec3{0.5 * across, 0.5 * across, table.number(0, "y_m")}}, 5e-5));
    auto const& granules = simulation->granules();
    Track off;
    for (std::size_t row = 1; row < table.rows(); ++row) {
        double const goal = table.number(row, "t_s");
        while (simulation->time() < goal - 1e-9) simulation->step(goal - simulation->time());
        double const v = table.number(row, "v_m_per_s"), y = table.number(row, "y_m");
        off.velocity = std::max(off.velocity, std::abs(granules.velocity[0].z / v - 1));
        off.position = std::max(off.position, std::abs(granules.position[0].z / y - 1));
    }
    return off;
}

TEST(OneSphere, in_a_gas_stream_follows_the_reference_case)
{
    Track const alone = track(0.05, 3), felt = track(0.004, 5);
    verify::below("X01", "sphere in a stream, cells of 50 mm: velocity, largest share off", 1e-3, alone.velocity);
    verify::below("X01", "sphere in a stream, cells of 50 mm: position, largest share off", 1e-3, alone.position);
    verify::below("X01", "sphere in a stream, cells of 4 mm: velocity, largest share off", 5e-2, felt.velocity);
    verify::below("X01", "sphere in a stream, cells of 4 mm: position, largest share off", 5e-2, felt.position);
}

//! Speed of the middle of a suspension that settles in a closed column, m/s.
double settling_speed(double phi)
{
    double const diameter = 1e-3, spacing = std::cbrt(math::pi / 6 / phi) * diameter;
    // Random places no closer than touching: a lattice, each sphere moved as far as its neighbours allow.
    int const across = static_cast<int>(std::lround(0.01 / spacing)), up = 6 * across;
    double const wide = across * spacing, high = up * spacing;
    std::vector<Vec3> places;
    base::Random random(1, base::Purpose::test, 0, 0);
    auto const shift = [&] { return (random.uniform() - 0.5) * 0.98 * (spacing - diameter) / std::sqrt(3.0); };
    for (int k = 0; k < up; ++k)
        for (int j = 0; j < across; ++j)
            for (int i = 0; i < across; ++i)
                places.push_back(spacing * Vec3(i + 0.5, j + 0.5, k + 0.5) + Vec3(shift(), shift(), shift()));
    auto const simulation = scene::simulation_of(
        box_text({wide, wide, high}, "\"x\", \"y\"") + granules_text(diameter, 2000) +
            "[gas]\nclosed = true\ndensity = \"1000 kg/m3\"\nviscosity = \"1e-3 Pa.s\"\ndrag = \"di-felice\"\n"
            "cells = [4, 4, 24]\n[contact]\nyoungs_modulus = \"50 kPa\"\n[time]\nduration = \"1 s\"\n"
            "gas_step = \"1 ms\"\n",
        granules_csv(places, diameter / 2));
    auto const& granules = simulation->granules();
    double sum = 0;
    long count = 0;
    while (simulation->time() < 0.2) {
        simulation->step(1e-3);
        if (simulation->time() < 0.1) continue;
        for (std::size_t row = 0; row < granules.owned; ++row) {
            double const z = granules.position[row].z;
            if (z < 0.3 * high || z > 0.6 * high) continue;
            sum -= granules.velocity[row].z;
            ++count;
        }
    }
    return sum / static_cast<double>(count);
}

TEST(Suspension, settles_as_richardson_and_zaki_found)
{
    scene::Table const table("x-05.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const phi = table.number(row, "phi_s");
        verify::relative("X05", fmt::format("suspension of {} solids: settling speed, m/s", phi),
                         table.number(row, "hindered_velocity_m_per_s"), settling_speed(phi), 0.1);
    }
}
}
