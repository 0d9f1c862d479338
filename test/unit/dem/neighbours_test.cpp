#include "granum/dem/neighbours.hpp"
#include "granum/base/error.hpp"
#include "granum/base/random.hpp"
#include "scene/granules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{
using namespace granum;
using dem::Vec3;

// Granules at random in a box, sizes from `smallest` to 1 mm radius; the last fifth of the rows belong to others.
constexpr double least_room = 1.2e-4;  // m

dem::Frame cloud(Vec3 const& box, double smallest, std::uint32_t seed)
{
    dem::Frame frame;
    constexpr std::size_t rows = 500;
    frame.owned = 400;
    frame.resize(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        base::Random random(seed, base::Purpose::test, row, 0);
        frame.id[row] = (row * 7919) % rows;
        for (std::size_t d = 0; d < 3; ++d) frame.bodies[row].position[d] = box[d] * random.uniform();
        frame.bodies[row].radius = 1e-3 * smallest * std::pow(1 / smallest, random.uniform());
        // One in ten is fast.
        double const room = least_room * (random.uniform() < 0.1 ? 1 + 4 * random.uniform() : 1);
        frame.bodies[row].per_room2 = 1 / (room * room);
    }
    return frame;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> plain_double_loop(dem::Frame const& frame, dem::Domain const& domain,
                                                                    double skin, bool with_room)
{
    std::set<std::pair<std::uint32_t, std::uint32_t>> out;
    for (std::uint32_t a = 0; a < frame.rows(); ++a)
        for (std::uint32_t b = 0; b < frame.rows(); ++b) {
            if (frame.id[a] >= frame.id[b] || (a >= frame.owned && b >= frame.owned)) continue;
            Vec3 apart = frame.position(a) - frame.position(b);
            for (std::size_t d = 0; d < 3; ++d)
                if (domain.periodic[d]) apart[d] -= domain.size()[d] * std::round(apart[d] / domain.size()[d]);
            double const ahead = with_room ? frame.room(a) + frame.room(b) - 2 * least_room : 0;
            if (norm(apart) < frame.radius(a) + frame.radius(b) + skin + ahead) out.insert({a, b});
        }
    return out;
}

TEST(NeighbourSearch, finds_exactly_the_pairs_of_the_plain_double_loop_from_low_to_high_id)
{
    double const skin = 3e-4;  // a little more than the rooms of two: what is seen at a distance
    for (auto const* kernel : dem::kernel::kernels())
        for (double const smallest : {1.0, 0.5, 0.1, 0.02})
            for (int periodic = 0; periodic < 8; ++periodic)
                for (Vec3 const box : {Vec3{0.02, 0.01, 0.04}, Vec3{0.006, 0.05, 0.0047}, Vec3{0.1, 0.1, 0.3}}) {
                    auto const frame = cloud(box, smallest, static_cast<std::uint32_t>(periodic));
                    dem::Domain const domain{
                        {0, 0, 0}, box, {(periodic & 1) != 0, (periodic & 2) != 0, (periodic & 4) != 0}};
                    dem::NeighbourSearch search;
                    dem::Candidates found;
                    search.find(frame, domain, 0.5 * box, {skin, 0.2 * skin, least_room}, found, *kernel);
                    auto const expected = plain_double_loop(frame, domain, skin, true);
                    std::set<std::pair<std::uint32_t, std::uint32_t>> got, near;
                    for (auto const& [low, high] : found.near) got.insert({low, high}), near.insert({low, high});
                    for (auto const& [low, high] : found.far) got.insert({low, high});
                    EXPECT_EQ(got, expected) << smallest << " " << periodic << " " << box.x;
                    EXPECT_EQ(got.size(), found.near.size() + found.far.size());  // none twice
                    EXPECT_EQ(near, plain_double_loop(frame, domain, 0.2 * skin, false));
                    for (std::uint32_t row = 0; row < frame.rows(); ++row)
                        for (auto k = found.near_begin[row]; k < found.near_end[row]; ++k)
                            EXPECT_TRUE(found.near[k].low == row || found.near[k].high == row);
                }
}

TEST(NeighbourSearch, sorts_every_row_once_so_that_neighbours_follow_each_other)
{
    dem::Frame frame;
    frame.owned = 50;
    frame.resize(50);
    for (std::size_t row = 0; row < 50; ++row) {
        frame.bodies[row].position[0] = 1e-3 * static_cast<double>((row * 37) % 50);
        frame.bodies[row].radius = 1e-3;
    }
    dem::NeighbourSearch search;
    auto const order = search.sorted_rows(frame, {{0, 0, 0}, {0.05, 0.05, 0.05}, {}}, {0.025, 0.025, 0.025}, 2e-3);
    ASSERT_EQ(order.size(), 50u);
    EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), 50u);
    for (std::size_t k = 1; k < order.size(); ++k)
        EXPECT_LT(frame.position(order[k - 1]).x, frame.position(order[k]).x + 2.1e-3);
}

TEST(NeighbourList, made_anew_before_a_step_was_done_is_as_wide_as_before)
{
    // Several ranks make one when they have shared the granules, and another when they have balanced them.
    scene::Scene scene(scene::glass);
    scene.add({0, 0, 0}, {}, 1e-3, 2500);
    scene.add({2.05e-3, 0, 0}, {}, 1e-3, 2500);
    scene.prepare();
    double const width = scene.engine->skin();
    for (int again = 0; again < 3; ++again) scene.engine->prepare(scene.granules);
    EXPECT_EQ(scene.engine->skin(), width);
}

// A cloud of slow granules, through which a few fly fast, from wall to wall.
scene::Scene shot_through(double skin)
{
    scene::Scene scene(scene::limestone);
    double const radius = 1e-3, edge = 0.03;
    scene.enclose({0, 0, 0}, {edge, edge, edge});
    scene.settings.skin = skin;
    scene.settings.gravity = {};
    for (int k = 0; k < 10; ++k)
        for (int j = 0; j < 10; ++j)
            for (int i = 0; i < 10; ++i) {
                base::Random random(5, base::Purpose::test, scene.granules.rows(), 0);
                double const speed = scene.granules.rows() % 250 == 55 ? 8 : 0.1;
                scene.add({3e-3 * i + 1.5e-3, 3e-3 * j + 1.5e-3, 3e-3 * k + 1.5e-3},
                          speed * Vec3{random.normal(), random.normal(), random.normal()}, radius, 2500);
            }
    scene.prepare();
    return scene;
}

TEST(NeighbourList, is_not_made_anew_for_all_because_a_few_are_fast)
{
    constexpr int steps = 4000;
    constexpr double dt = 1e-6, skin = 0.4e-3;
    auto scene = shot_through(skin), plain = shot_through(0.05 * skin);
    scene.run(steps, dt);
    double flown = 0;
    for (int k = 0; k < steps; ++k) {
        plain.run(1, dt);
        double fastest = 0;
        for (std::size_t row = 0; row < plain.granules.owned; ++row)
            fastest = std::max(fastest, norm(plain.granules.velocity[row]));
        flown += fastest * dt;
    }
    EXPECT_LT(static_cast<double>(scene.engine->watch().rebuilds), 0.7 * flown / (0.5 * skin));
    EXPECT_EQ(scene.engine->watch().late_lists, 0);
    EXPECT_GT(plain.engine->watch().dissipated.value(), 0);
    for (std::size_t row = 0; row < plain.granules.owned; ++row) {
        auto const other = scene.row(plain.granules.id[row]);
        EXPECT_EQ(plain.granules.position[row], scene.granules.position[other]);
        EXPECT_EQ(plain.granules.spin[row], scene.granules.spin[other]);
    }
}

// Each pair, and each wall beside a granule, that is closer than the gap, at whatever time one looks.
TEST(Sight, knows_every_surface_within_its_gap_while_granules_move)
{
    scene::Scene scene(scene::limestone);
    double const radius = 1e-3, edge = 0.014, gap = 0.2e-3;
    scene.enclose({0, 0, 0}, {edge, edge, edge});
    scene.settings.walls.pop_back(), scene.settings.walls.pop_back();  // along z the scene repeats itself
    scene.settings.periodic = {false, false, true};
    scene.settings.sight = gap;
    for (int k = 0; k < 5; ++k)
        for (int j = 0; j < 5; ++j)
            for (int i = 0; i < 5; ++i) {
                base::Random random(3, base::Purpose::test, scene.granules.rows(), 0);
                scene.add({2.6e-3 * i + 1.7e-3, 2.6e-3 * j + 1.7e-3, 2.6e-3 * k + 1.7e-3},
                          {random.normal(), random.normal(), random.normal()}, radius * (1 - 0.2 * random.uniform()),
                          2500);
            }
    scene.prepare();
    using Pair = std::pair<dem::Id, dem::Id>;
    std::size_t apart_seen = 0;
    for (int look = 0; look < 40; ++look) {
        scene.run(200, 2e-7);
        auto const& g = scene.granules;
        std::set<Pair> expected, found, walls_expected, walls_found;
        for (std::size_t a = 0; a < g.owned; ++a) {
            for (std::size_t b = 0; b < g.owned; ++b) {
                Vec3 apart = g.position[a] - g.position[b];
                apart.z -= edge * std::round(apart.z / edge);
                if (g.id[a] < g.id[b] && norm(apart) < g.radius[a] + g.radius[b] + gap)
                    expected.insert({g.id[a], g.id[b]});
            }
            for (dem::Id wall = 0; wall < 4; ++wall) {
                double const x = wall < 2 ? g.position[a].x : g.position[a].y, distance = wall % 2 == 0 ? x : edge - x;
                if (distance < g.radius[a] + gap) walls_expected.insert({g.id[a], wall});
            }
        }
        for (auto const& contact : scene.engine->contacts(gap)) {
            (contact.wall ? walls_found : found).insert({contact.low, contact.high});
            apart_seen += contact.overlap < 0;
        }
        EXPECT_EQ(found, expected) << look;
        EXPECT_EQ(walls_found, walls_expected) << look;
    }
    EXPECT_GT(apart_seen, 500u);
    EXPECT_THROW(static_cast<void>(scene.engine->contacts(2 * gap)), base::Error);
}
}
