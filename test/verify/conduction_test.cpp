// Heat through contacts: a published pair of spheres, and reference case H-02, a row of them between two temperatures.
#include "scene/chain.hpp"
#include "scene/reference.hpp"
#include "table.hpp"

namespace
{
using namespace granum;
using coupling::Conduction;
using scene::Chain;
using scene::Link;

law::conduction::Any const lens = law::conduction::Lens{};
par::Communicator const& alone()
{
    static par::Communicator const self{MPI_COMM_SELF};
    return self;
}
double sphere(double diameter, double density)
{
    return density * math::pi / 6 * diameter * diameter * diameter;
}

TEST(TwoSpheres, exchange_heat_as_published)
{
    std::vector<Link> const links{{.radius = 1.5e-3, .capacity = 800 * sphere(3e-3, 420), .temperature = 298.15},
                                  {.radius = 1.8e-3,
                                   .overlap = 3.3e-3 - 3.299867e-3,
                                   .capacity = 55 * sphere(3.6e-3, 8850),
                                   .temperature = 453.15,
                                   .material = 2}};
    Conduction const conduction(lens, {{.conductivity = 55}, {}, {.conductivity = 0.84}}, alone());
    Chain chain(links);
    auto const advance = [&](double time, double step) {
        for (long k = std::lround(time / step); k > 0; --k) chain.pass(conduction, step);
    };
    advance(0.1, 1e-4);
    verify::absolute("P18", "two spheres in contact: temperature of the colder after 0.1 s, K", 298.30923,
                     chain.temperatures()[0], 1e-4);
    verify::absolute("P18", "two spheres in contact: temperature of the hotter after 0.1 s, K", 453.08639,
                     chain.temperatures()[1], 1e-4);
    advance(499.8, 0.02);
    verify::absolute("P18", "two spheres in contact: temperature of the colder after 499.9 s, K", 408.82180,
                     chain.temperatures()[0], 1e-3);
    verify::absolute("P18", "two spheres in contact: temperature of the hotter after 499.9 s, K", 408.93846,
                     chain.temperatures()[1], 1e-3);
}

TEST(RowOfSpheres, between_two_temperatures_has_the_profile_of_the_reference_case)
{
    // 0.02 W/K between spheres: lenses of 1 mm radius at 10 W/m/K; 0.04 W/K to the ends: of 2 mm, four times as deep.
    scene::Table const table("h-02.csv");
    double const radius = 1e-2, overlap = 1e-6 / radius;
    std::vector<Link> links(table.rows() + 2, Link{.radius = radius, .overlap = overlap, .capacity = 1e-3});
    links.front() = {.radius = radius, .capacity = 1e9, .temperature = math::zero_celsius};
    links.back() = {.radius = radius, .overlap = 4 * overlap, .capacity = 1e9, .temperature = math::zero_celsius + 50};
    links[1].overlap = 4 * overlap;
    Conduction const conduction(lens, {{.conductivity = 10}}, alone());
    Chain chain(links);
    double const before = chain.scene.granules.enthalpy[chain.scene.row(0)];
    for (int step = 0; step < 20000; ++step) chain.pass(conduction, 1e-3);
    double worst = 0;
    auto const t = chain.temperatures();
    for (std::size_t row = 0; row < table.rows(); ++row)
        worst = std::max(worst, std::abs(t[row + 1] - math::zero_celsius - table.number(row, "T_degC")));
    verify::below("H02", "row of spheres between 0 and 50 degC: largest temperature off, K", 1e-4, worst);
    double const start = chain.scene.granules.enthalpy[chain.scene.row(0)];
    for (int step = 0; step < 1000; ++step) chain.pass(conduction, 1e-3);
    EXPECT_GT(start, before);
    verify::relative("H02", "row of spheres: heat that flows, W", 0.1,
                     chain.scene.granules.enthalpy[chain.scene.row(0)] - start, 1e-4);
}
}
