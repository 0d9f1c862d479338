// Heat through contacts: what is kept, what it depends on, and that ranks agree.
#include "granum/base/error.hpp"
#include "scene/chain.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

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
    coupling::Paths const paths{.contact = hertz, .materials = {{.conductivity = 2}}};
    Conduction const together(paths, world), single(paths, self);
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
    Conduction const conduction({.contact = hertz, .materials = {{.conductivity = 200}}}, self);
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
    Conduction const conduction({.contact = hertz, .materials = {{.conductivity = 2}, {}, {.conductivity = 0}}}, self);
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
        Conduction const conduction(
            {.contact = hertz, .materials = {{.conductivity = 2, .youngs_modulus = modulus, .poisson_ratio = 0.25}}},
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
    Conduction const conduction({.contact = hertz, .materials = {{.conductivity = 2}}}, self);
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
    Conduction const conduction({.contact = hertz, .materials = {{.conductivity = 2}}}, self);
    EXPECT_THROW(chain.pass(conduction, 1), base::Error);
}

TEST(Conduction, of_collisions_takes_back_how_long_softened_ones_last)
{
    // MFIX has the same power: (E_soft / E_real)^(4/15) beside the circle of the real modulus.
    double const soft = scene::limestone.youngs_modulus, real = 64 * soft;
    auto const gain = [&](bool collisions) {
        std::vector<Link> links(2);
        links[1] = {.overlap = 1.6e-5, .temperature = 400};
        par::Communicator const self{MPI_COMM_SELF};
        Chain chain(links);
        Conduction const conduction(
            {.contact = hertz,
             .collisions = collisions,
             .materials =
                 {{.conductivity = 2, .youngs_modulus = real, .poisson_ratio = 0.25, .softened_modulus = soft}}},
            self);
        chain.pass(conduction, 1e-3);
        return chain.temperatures()[0] - 300;
    };
    EXPECT_NEAR(gain(true) / gain(false), std::pow(64, -4.0 / 15), 1e-6);
}

namespace
{
//! Gaps and overlaps from one sphere to the next, all within a lens of 0.2 radii.
std::vector<Link> ten_spheres_apart()
{
    auto links = ten_spheres();
    for (std::size_t k = 1; k < links.size(); ++k) links[k].overlap = 1e-5 * (static_cast<double>(k % 4) - 2);
    return links;
}
}

TEST(FilmConduction, keeps_all_heat_and_has_the_same_bits_on_any_number_of_ranks)
{
    auto const links = ten_spheres_apart();
    par::Communicator const world{MPI_COMM_WORLD}, self{MPI_COMM_SELF};
    Chain shared(links, MPI_COMM_WORLD), alone(links);
    coupling::Paths const paths{.contact = hertz, .film = law::film::RongHorio{}, .materials = {{.conductivity = 0.2}}};
    Conduction const together(paths, world), single(paths, self);
    double const before = shared.heat();
    for (int step = 0; step < 100; ++step) {
        shared.pass(together, 0.3);
        alone.pass(single, 0.3);
    }
    EXPECT_NEAR(shared.heat(), before, 1e-14 * before);
    EXPECT_EQ(shared.temperatures(), alone.temperatures());
    EXPECT_GT(std::abs(alone.temperatures()[2] - links[2].temperature), 1);
}

TEST(FilmConduction, reaches_as_far_as_the_lens_and_no_farther)
{
    par::Communicator const self{MPI_COMM_SELF};
    Conduction const conduction({.film = law::film::RongHorio{}, .gas = 0.026, .materials = {{}}}, self);
    auto const gain = [&](double gap) {
        std::vector<Link> links(2, Link{.radius = 1e-3, .capacity = 0.01});
        links[1].overlap = -gap, links[1].temperature = 400;
        Chain chain(links);
        chain.pass(conduction, 0.1);
        return chain.temperatures()[0] - 300;
    };
    EXPECT_GT(gain(0.19e-3), 1e-4);
    EXPECT_EQ(gain(0.21e-3), 0);
    // An independent quadrature of 2 pi r dr / l for 0.1 mm: 2.26788 mm; one part of the interval, from 100 K.
    EXPECT_NEAR(gain(0.1e-3), 2.26788e-3 * 0.026 * 100 * 0.1 / 0.01, 1e-7);
    EXPECT_GT(gain(0.01e-3), 1.5 * gain(0.1e-3));
}

TEST(WallConduction, brings_a_sphere_to_the_temperature_of_the_wall_and_counts_what_the_wall_gets)
{
    // A sphere 1e-5 m deep in a wall of 400 K: T = 400 - 100 exp(-t H / C), H = 4 k a / 2 with equal conductivities.
    scene::Scene scene(scene::limestone);
    scene.settings.frozen = true;
    scene.settings.walls = {{.name = "hot", .shapes = {geometry::Plane{{0, 0, 0}, {0, 0, 1}}}, .material = 1},
                            {.name = "other", .shapes = {geometry::Plane{{-0.99e-3, 0, 0}, {1, 0, 0}}}, .material = 1}};
    scene.settings.sight = 0.2e-3;
    double const radius = 1e-3, overlap = 1e-5, capacity = 0.01;
    scene.add({0, 0, radius - overlap}, {}, radius, 2500);
    scene.prepare();
    auto& granules = scene.granules;
    par::Communicator const self{MPI_COMM_SELF};
    std::vector<double> const capacities{capacity};
    auto const start = [&] {
        granules.temperature[0] = 300;
        granules.enthalpy[0] = capacity * (300 - math::zero_celsius);
    };
    std::vector<std::optional<double>> const walls{400.0, std::nullopt};  // the other one is adiabatic
    coupling::Paths const by_contact{
        .contact = hertz, .materials = {{.conductivity = 2}, {.conductivity = 2}}, .walls = walls};
    Conduction const contact(by_contact, self);
    start();
    coupling::PassedHeat passed;
    double to_wall = 0;
    for (int step = 0; step < 2000; ++step) {
        passed = contact.pass(*scene.engine, granules, capacities, 1e-3);
        to_wall += passed.wall_contacts;
        EXPECT_EQ(passed.wall_film, 0);
    }
    double const conductance = 4 * std::sqrt(radius * overlap);  // 4 k k / (k + k) a
    EXPECT_NEAR(granules.temperature[0], 400 - 100 * std::exp(-2 * conductance / capacity), 0.02);
    EXPECT_NEAR(to_wall, -capacity * (granules.temperature[0] - 300), 1e-12);

    // Through the gas: by the law, whose numbers test/unit/law/film_test.cpp holds.
    coupling::Paths by_film{.film = law::film::RongHorio{}, .gas = 0.026, .materials = {{}, {}}, .walls = walls};
    Conduction const film(by_film, self);
    start();
    double const infinite = std::numeric_limits<double>::infinity();
    double const through =
        law::film::conductance(law::film::RongHorio{}, {.radius = radius, .other = infinite, .gap = -overlap}, 0.026);
    to_wall = 0;
    for (int step = 0; step < 100; ++step) to_wall += film.pass(*scene.engine, granules, capacities, 1e-3).wall_film;
    EXPECT_NEAR(granules.temperature[0], 400 - 100 * std::exp(-0.1 * through / capacity), 0.01);
    EXPECT_NEAR(to_wall, -capacity * (granules.temperature[0] - 300), 1e-12);
}

TEST(FilmConduction, crosses_a_gap_to_a_wall_that_is_not_touched)
{
    par::Communicator const self{MPI_COMM_SELF};
    auto const gain = [&](double gap) {
        scene::Scene scene(scene::limestone);
        scene.settings.frozen = true;
        // A closed tube: no plane, so that the search among shapes is used.
        scene.settings.walls = {{.name = "hot",
                                 .shapes = {geometry::Frustum{.base = {0, 0, -0.1},
                                                              .axis = {0, 0, 1},
                                                              .length = 0.2,
                                                              .base_radius = 0.05,
                                                              .top_radius = 0.05,
                                                              .side = geometry::Side::inside}},
                                 .material = 1}};
        scene.settings.sight = 0.25e-3;
        scene.add({0.05 - 1e-3 - gap, 0, 0}, {}, 1e-3, 2500);
        scene.prepare();
        scene.granules.temperature[0] = 300;
        scene.granules.enthalpy[0] = 0.01 * (300 - math::zero_celsius);
        Conduction const conduction(
            {.film = law::film::RongHorio{}, .gas = 0.026, .materials = {{}, {}}, .walls = {std::optional(400.0)}},
            self);
        std::vector<double> const capacities{0.01};
        conduction.pass(*scene.engine, scene.granules, capacities, 0.01);
        return scene.granules.temperature[0] - 300;
    };
    EXPECT_GT(gain(0.05e-3), gain(0.15e-3));
    EXPECT_GT(gain(0.15e-3), 0);
    EXPECT_EQ(gain(0.21e-3), 0);
}
