// Row P18 and reference cases H-02 and H-11: heat between granules, and between granules and walls, by contact and
// through the gas, each stated as a case and moved by the step of `granum run`.
#include "scene/chain.hpp"
#include "scene/reference.hpp"
#include "still_granules.hpp"
#include "verify/table.hpp"

#include "granum/law/film/all.hpp"

#include <limits>

namespace
{
using namespace granum;
using verify::Still;

void go(sim::Simulation& simulation, double until, double step)
{
    for (long k = std::lround((until - simulation.time()) / step); k > 0; --k) simulation.step(step);
}

TEST(TwoSpheres, exchange_heat_by_contact_as_published)
{
    // All granules of a case have one heat capacity per mass: of the first density times capacity are those published.
    double const capacity = 55, from_wall = 5e-3;
    auto const simulation = scene::simulation_of(
        verify::silent_box({0.02, 0.01, 0.01}, capacity, "",
                           "conduction = \"lens\"\nheat_conductivity = \"55 W/m/K\"\n[material.other]\n"
                           "heat_conductivity = \"0.840 W/m/K\"\n") +
        verify::still_text({Still{{from_wall, 5e-3, 5e-3}, 1.5e-3, "granule", 420 * 800.0 / 55, 298.15},
                            Still{{from_wall + 3.299867e-3, 5e-3, 5e-3}, 1.8e-3, "other", 8850, 453.15}}));
    go(*simulation, 0.1, 1e-4);
    auto t = verify::temperatures(*simulation);
    verify::absolute("P18", "two spheres in contact: temperature of the colder after 0.1 s, K", 298.30923, t[0], 1e-4);
    verify::absolute("P18", "two spheres in contact: temperature of the hotter after 0.1 s, K", 453.08639, t[1], 1e-4);
    go(*simulation, 499.9, 0.02);
    t = verify::temperatures(*simulation);
    verify::absolute("P18", "two spheres in contact: temperature of the colder after 499.9 s, K", 408.82180, t[0],
                     2e-3);
    verify::absolute("P18", "two spheres in contact: temperature of the hotter after 499.9 s, K", 408.93846, t[1],
                     2e-3);
}

TEST(RowOfSpheres, between_two_walls_has_the_profile_of_the_reference_case)
{
    // 0.02 W/K between spheres: lenses of 1 mm radius at 10 W/m/K; 0.04 W/K to the walls: lenses of 2 mm.
    scene::Table const table("h-02.csv");
    double const radius = 1e-2, overlap = 1e-6 / radius, on_wall = 4e-6 / (2 * radius);
    std::vector<Still> row;
    for (std::size_t k = 0; k < table.rows(); ++k)
        row.push_back({{radius - on_wall + static_cast<double>(k) * (2 * radius - overlap), radius * 2, radius * 2},
                       radius,
                       "granule",
                       100});
    auto const simulation = scene::simulation_of(
        verify::silent_box({row.back().at.x + radius - on_wall, 4 * radius, 4 * radius}, 10,
                           "[[gas.wall]]\nof = \"left\"\ntemperature = \"0 degC\"\n[[gas.wall]]\nof = \"right\"\n"
                           "temperature = \"50 degC\"\n",
                           "conduction = \"lens\"\nheat_conductivity = \"10 W/m/K\"\n") +
        verify::still_text(row));
    go(*simulation, 120, 0.05);
    auto const t = verify::temperatures(*simulation);
    double worst = 0;
    for (std::size_t k = 0; k < table.rows(); ++k)
        worst = std::max(worst, std::abs(t[k] - math::zero_celsius - table.number(k, "T_degC")));
    verify::below("H02", "row of spheres between walls of 0 and 50 degC: largest temperature off, K", 1e-4, worst);
    verify::below("H02", "row of spheres between walls: energy missing over what passed", 1e-6,
                  simulation->ledgers().energy.relative_error());
}

TEST(RowOfSpheres, passes_the_heat_of_the_reference_case)
{
    scene::Table const table("h-02.csv");
    double const radius = 1e-2, overlap = 1e-6 / radius;
    using scene::Link;
    std::vector<Link> links(table.rows() + 2, Link{.radius = radius, .overlap = overlap, .capacity = 1e-3});
    links.front() = {.radius = radius, .capacity = 1e9, .temperature = math::zero_celsius};
    links.back() = {.radius = radius, .overlap = 4 * overlap, .capacity = 1e9, .temperature = math::zero_celsius + 50};
    links[1].overlap = 4 * overlap;
    par::Communicator const alone{MPI_COMM_SELF};
    coupling::Conduction const conduction({.contact = law::conduction::Lens{}, .materials = {{.conductivity = 10}}},
                                          alone);
    scene::Chain chain(links);
    for (int step = 0; step < 20000; ++step) chain.pass(conduction, 1e-3);
    double const start = chain.scene.granules.enthalpy[chain.scene.row(0)];
    for (int step = 0; step < 1000; ++step) chain.pass(conduction, 1e-3);
    verify::relative("H02", "row of spheres: heat that flows, W", 0.1,
                     chain.scene.granules.enthalpy[chain.scene.row(0)] - start, 1e-4);
}

TEST(TwoSpheres, apart_exchange_heat_through_the_gas_as_published)
{
    // No case is without convection beside a gas that conducts: the exchange as such.
    double const one = 420 * math::pi / 6 * 27e-9 * 0.191204 * 4184;
    double const other = 8850 * math::pi / 6 * 46.656e-9 * 0.013145 * 4184;
    std::vector<scene::Link> const links{
        {.radius = 1.5e-3, .capacity = one, .temperature = 298.15},
        {.radius = 1.8e-3, .overlap = -0.18e-3, .capacity = other, .temperature = 453.15}};
    par::Communicator const alone{MPI_COMM_SELF};
    coupling::Conduction const conduction({.film = law::film::RongHorio{}, .gas = 1.239e-4 * 418.4, .materials = {{}}},
                                          alone);
    scene::Chain chain(links);
    scene::Table const table("h-11.csv");
    double worst = 0, now = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const goal = table.number(row, "t_s");
        for (; now < goal - 1e-6; now += 2e-3) chain.pass(conduction, 2e-3);
        auto const t = chain.temperatures();
        worst = std::max(
            {worst, std::abs(t[0] / table.number(row, "T1_K") - 1), std::abs(t[1] / table.number(row, "T2_K") - 1)});
    }
    verify::below({"H11", "MFIX 3.1e-7"}, "two spheres 0.18 mm apart, over 200 s: temperatures, largest share off",
                  1e-4, worst);
    // MFIX's archived rate: dT1/dt = A (T2 - T1).
    scene::Chain begun(links);
    double const before = begun.temperatures()[0];
    begun.pass(conduction, 1e-4);
    verify::relative("H11", "two spheres 0.18 mm apart: first rate of the colder, 1/s", 0.0401067383450698,
                     (begun.temperatures()[0] - before) / 1e-4 / 155, 1e-3);
}

TEST(OneSphere, on_a_hot_wall_follows_the_heat_of_its_contact)
{
    // T = T_wall - (T_wall - T_0) exp(-H t / C): H = 4 k_g k_w / (k_g + k_w) a through Hertz's circle, a = sqrt(R
    // delta).
    double const radius = 2e-3, overlap = 2e-6, density = 2000, capacity = 500;
    double const heat = capacity * density * 4 / 3 * math::pi * std::pow(radius, 3);
    auto const simulation = scene::simulation_of(
        verify::silent_box({0.02, 0.02, 0.02}, capacity, "[[gas.wall]]\nof = \"bottom\"\ntemperature = \"400 K\"\n",
                           "conduction = \"hertz\"\nheat_conductivity = \"0.5 W/m/K\"\n"
                           "wall_heat_conductivity = \"15 W/m/K\"\n") +
        verify::still_text({Still{{0.01, 0.01, radius - overlap}, radius, "granule", density}}));
    double const conductance = 4 * 0.5 * 15 / 15.5 * std::sqrt(radius * overlap);
    double const time = heat / conductance;
    go(*simulation, time, time / 2000);
    verify::relative("E01", "sphere on a wall hotter by 100 K, after one time constant: rise, K",
                     100 * (1 - std::exp(-1)), verify::temperatures(*simulation)[0] - 300, 1e-3);
    double const gained = heat * (verify::temperatures(*simulation)[0] - 300);
    verify::relative("E01", "sphere on a hot wall: heat that the wall lost over what the sphere gained", 1,
                     -simulation->heat().wall_contacts / gained, 1e-6);
    verify::below("E01", "sphere on a hot wall: energy missing over what passed", 1e-6,
                  simulation->ledgers().energy.relative_error());
}

TEST(OneSphere, that_radiates_cools_as_the_closed_form_and_its_gas_gets_the_heat)
{
    // dT/dt = k (T_s^4 - T^4), k = sigma e A / (m c), integrated to t(T); what it sees around it is the gas.
    double const radius = 1e-3, density = 2000, capacity = 500, around = 300, first = 1000, emissivity = 0.8;
    double const k = 5.670374e-8 * emissivity * 3 / (radius * density * capacity);
    auto const simulation =
        scene::simulation_of(verify::silent_box({3, 3, 3}, capacity, "smoothing = \"0 mm\"\n", "",
                                                fmt::format("emissivity = {}\n", emissivity)) +
                             verify::still_text({Still{{1.5, 1.5, 1.5}, radius, "granule", density, first}}));
    auto const time_of = [&](double t) {
        auto const part = [&](double x) {
            return std::log(std::abs((around + x) / (around - x))) + 2 * std::atan(x / around);
        };
        return (part(t) - part(first)) / (4 * k * around * around * around);
    };
    for (double const t : {900.0, 700.0, 500.0}) {
        double const goal = time_of(t);
        while (simulation->time() < goal * (1 - 1e-9))
            simulation->step(std::min(time_of(900) / 400, goal - simulation->time()));
        verify::absolute(
            "E09",
            fmt::format("sphere of 1000 K that radiates into gas of 300 K, after {:.3g} s: temperature, K", goal), t,
            verify::temperatures(*simulation)[0], 0.5);
    }
    verify::below("E09", "sphere that radiates: energy missing over what passed", 1e-6,
                  simulation->ledgers().energy.relative_error());
    double const lost = capacity * density * 4 / 3 * math::pi * std::pow(radius, 3) * 500;
    verify::relative("E09", "sphere that radiates: heat radiated over what it lost", 1,
                     simulation->heat().radiation / lost, 1e-3);
}
}
