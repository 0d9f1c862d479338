// Heat through contacts: what is kept, what it depends on, and that ranks agree.
#include "granum/base/error.hpp"
#include "scene/chain.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace granum;
using coupling::Conduction;
using coupling::Conductor;
using scene::Chain;
using scene::Link;

namespace
{
law::conduction::Any const hertz = law::conduction::Hertz{};

std::vector<Link> ten_spheres()
{
    std::vector<Link> links(10);
    for (std::size_t k = 0; k < links.size(); ++k)
        links[k] = {.radius = 1e-3 + 1e-4 * static_cast<double>(k % 3),
                    .overlap = k > 0 ? 1e-6 * static_cast<double>(k) : 0,
                    .capacity = 0.01 * static_cast<double>(1 + k % 4),
                    .temperature = 300 + 17 * static_cast<double>(k * k % 7)};
    return links;
}
}

TEST(Conduction, keeps_all_heat_and_has_the_same_bits_on_any_number_of_ranks)
{
    auto const links = ten_spheres();
    par::Communicator const world{MPI_COMM_WORLD}, self{MPI_COMM_SELF};
    Chain shared(links, MPI_COMM_WORLD), alone(links);
    Conduction const together(hertz, {{.conductivity = 2}}, world), single(hertz, {{.conductivity = 2}}, self);
    double const before = shared.heat();
    for (int step = 0; step < 200; ++step) {
        shared.pass(together, 0.3);
        alone.pass(single, 0.3);
    }
    EXPECT_NEAR(shared.heat(), before, 1e-14 * before);
    EXPECT_EQ(shared.temperatures(), alone.temperatures());
    auto const after = alone.temperatures();
    EXPECT_GT(std::abs(after[1] - links[1].temperature), 1);
}

TEST(Conduction, brings_all_spheres_to_the_mean_by_heat_capacity)
{
    auto const links = ten_spheres();
    par::Communicator const self{MPI_COMM_SELF};
    Chain chain(links);
    Conduction const conduction(hertz, {{.conductivity = 200}}, self);
    double heat = 0, capacity = 0;
    for (auto const& link : links) heat += link.capacity * link.temperature, capacity += link.capacity;
    int most = 0;
    for (int step = 0; step < 50; ++step) most = std::max(most, chain.pass(conduction, 20));
    EXPECT_GT(most, 1);  // the step is cut where it is too long
    for (double const t : chain.temperatures()) EXPECT_NEAR(t, heat / capacity, 1e-6);
}

TEST(Conduction, passes_nothing_where_one_side_insulates)
{
    std::vector<Link> links(2);
    links[1] = {.overlap = 1e-5, .temperature = 400, .material = 2};
    par::Communicator const self{MPI_COMM_SELF};
    Chain chain(links);
    Conduction const conduction(hertz, {{.conductivity = 2}, {}, {.conductivity = 0}}, self);
    ASSERT_TRUE(conduction.passes_heat());
    chain.pass(conduction, 10);
    EXPECT_EQ(chain.temperatures(), (std::vector<double>{300, 400}));
}

TEST(Conduction, through_softened_spheres_is_that_of_real_ones_at_the_same_force)
{
    // The modulus of the scene is 1/64 of the real one: the overlap is 16 times as deep, the circle 4 times as wide.
    double const soft = scene::limestone.youngs_modulus, real = 64 * soft;
    auto const gain = [&](double overlap, double modulus) {
        std::vector<Link> links(2);
        links[1] = {.overlap = overlap, .temperature = 400};
        par::Communicator const self{MPI_COMM_SELF};
        Chain chain(links);
        Conduction const conduction(hertz, {{.conductivity = 2, .youngs_modulus = modulus, .poisson_ratio = 0.25}},
                                    self);
        chain.pass(conduction, 0.1);
        return chain.temperatures()[0] - 300;
    };
    double const softened = gain(1.6e-5, 0);
    EXPECT_NEAR(gain(1.6e-5, real), softened / 4, 1e-9 * softened);
    EXPECT_NEAR(gain(1.6e-5, real), gain(1e-6, 0), 1e-9 * softened);
    EXPECT_NEAR(gain(1.6e-5, soft), softened, 1e-9 * softened);
}

TEST(Conduction, has_the_same_bits_in_any_order_of_rows)
{
    // A sphere with six around it, each as hot as its number says; it begins without heat, so that all bits of what it
    // gets are seen.
    std::array<math::Vec3, 7> const places{
        {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    par::Communicator const self{MPI_COMM_SELF};
    Conduction const conduction(hertz, {{.conductivity = 2}}, self);
    auto const centre = [&](double hot, std::array<std::size_t, 7> const& order) {
        scene::Scene scene(scene::limestone);
        scene.settings.frozen = true;
        for (auto const number : order) {
            auto const row = scene.add(1.99e-3 * places[number], {}, 1e-3, 2500);
            scene.granules.id[row] = number;
        }
        scene.prepare();
        auto& granules = scene.granules;
        std::vector<double> const capacity(7, 0.01);
        for (std::size_t row = 0; row < 7; ++row) {
            granules.temperature[row] = math::zero_celsius + hot * std::sqrt(static_cast<double>(granules.id[row]));
            granules.enthalpy[row] = 0.01 * (granules.temperature[row] - math::zero_celsius);
        }
        conduction.pass(*scene.engine, granules, capacity, 0.05);
        return granules.enthalpy[scene.row(0)];
    };
    for (double const hot : {3.1, 7.3, 11.7, 17.9, 29.3, 41.1}) {
        double const one = centre(hot, {0, 1, 2, 3, 4, 5, 6});
        EXPECT_EQ(centre(hot, {6, 4, 2, 0, 1, 3, 5}), one);
        EXPECT_EQ(centre(hot, {3, 5, 1, 6, 0, 2, 4}), one);
        EXPECT_GT(one, 0);
    }
}

TEST(Conduction, that_would_need_endless_parts_is_refused)
{
    std::vector<Link> links(2);
    links[1] = {.overlap = 1e-5, .capacity = 1e-12, .temperature = 400};
    par::Communicator const self{MPI_COMM_SELF};
    Chain chain(links);
    Conduction const conduction(hertz, {{.conductivity = 2}}, self);
    EXPECT_THROW(chain.pass(conduction, 1), base::Error);
}
