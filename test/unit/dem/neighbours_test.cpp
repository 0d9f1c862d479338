#include "granum/dem/neighbours.hpp"
#include "granum/base/random.hpp"

#include <gtest/gtest.h>

#include <set>

namespace
{
using namespace granum;

TEST(NeighbourSearch, finds_exactly_the_pairs_of_the_plain_double_loop_from_low_to_high_id)
{
    for (double const box : {0.02, 0.05}) {  // dense, and scattered
        particle::Store granules;
        granules.resize(400);
        granules.owned = 300;
        for (std::size_t row = 0; row < 400; ++row) {
            base::Random random(1, base::Purpose::test, row, 0);
            granules.id[row] = (row * 7919) % 400;
            granules.position[row] = {box * random.uniform(), 0.5 * box * random.uniform(), 2 * box * random.uniform()};
            granules.radius[row] = 1e-3 * (0.5 + 0.5 * random.uniform());
        }
        double const skin = 4e-4;
        dem::NeighbourSearch search;
        std::vector<dem::PairRows> found;
        search.pairs(granules, 2e-3 + skin, skin, found);
        std::set<std::pair<std::uint32_t, std::uint32_t>> expected, got;
        for (std::uint32_t a = 0; a < 400; ++a)
            for (std::uint32_t b = 0; b < 400; ++b)
                if (granules.id[a] < granules.id[b] && (a < 300 || b < 300) &&
                    norm(granules.position[a] - granules.position[b]) < granules.radius[a] + granules.radius[b] + skin)
                    expected.insert({a, b});
        for (auto const& [low, high] : found) got.insert({low, high});
        EXPECT_EQ(got, expected);
        EXPECT_EQ(got.size(), found.size());  // none twice
        EXPECT_FALSE(expected.empty());
    }
}

TEST(NeighbourSearch, sorts_every_owned_row_once)
{
    particle::Store granules;
    granules.resize(50);
    granules.owned = 40;
    for (std::size_t row = 0; row < 50; ++row) granules.position[row].x = 1e-3 * static_cast<double>((row * 37) % 50);
    dem::NeighbourSearch search;
    auto const order = search.sorted_rows(granules, 2e-3);
    ASSERT_EQ(order.size(), 40u);
    EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), 40u);
    for (std::size_t k = 1; k < order.size(); ++k)
        EXPECT_LT(granules.position[order[k - 1]].x, granules.position[order[k]].x + 2.1e-3);
}
}
