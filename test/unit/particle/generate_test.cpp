#include "granum/particle/generate.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using namespace granum;

TEST(LoosePacking, has_no_overlaps_stays_inside_and_is_a_function_of_the_seed)
{
    geometry::Chamber cone;
    cone.shape = geometry::Chamber::Shape::revolution;
    cone.profile = {{0, 0.09}, {0.45, 0.125}, {1.0, 0.125}};
    geometry::Chamber box;
    box.size = {0.08, 0.06, 0.3};
    for (auto const& chamber : {box, cone}) {
        double const radius = 2.4e-3;
        long const count = chamber.shape == geometry::Chamber::Shape::box ? 2000 : 3000;
        auto const centres = particle::random_loose(chamber, radius, count, 3);
        ASSERT_EQ(static_cast<long>(centres.size()), count);
        double nearest2 = 1, highest = 0;
        for (std::size_t a = 0; a < centres.size(); ++a) {
            EXPECT_TRUE(chamber.inside(centres[a], radius));
            highest = std::max(highest, centres[a].z);
            for (std::size_t b = a + 1; b < centres.size(); ++b)
                nearest2 = std::min(nearest2, norm2(centres[a] - centres[b]));
        }
        EXPECT_GT(std::sqrt(nearest2), 2 * radius);
        double const solids =
            static_cast<double>(count) * 4.0 / 3.0 * math::pi * radius * radius * radius / chamber.volume(0, highest);
        EXPECT_GT(solids, 0.28);  // 0.40 less what the walls leave empty
        EXPECT_LT(solids, 0.45);
        EXPECT_EQ(centres, particle::random_loose(chamber, radius, count, 3));
        EXPECT_NE(centres, particle::random_loose(chamber, radius, count, 4));
    }
}

TEST(LoosePacking, that_does_not_fit_is_refused)
{
    geometry::Chamber box;
    box.size = {0.01, 0.01, 0.01};
    EXPECT_NO_THROW(particle::random_loose(box, 1e-3, 40, 1));
    EXPECT_THROW(particle::random_loose(box, 1e-3, 400, 1), base::NumericsError);
}
}

namespace
{
TEST(RandomPlaces, of_sizes_ten_apart_do_not_overlap_and_fill_three_tenths_of_a_box)
{
    std::vector<double> radii;
    for (int k = 0; k < 4000; ++k) radii.push_back(k < 8 ? 5e-3 : 0.5e-3 * (1 + 0.2 * (k % 5)));
    particle::Region const box{{0, 0, 0}, {0.03, 0.03, 0.1}, [](math::Vec3 const& x, double radius) {
                                   return x.x > radius && x.y > radius && x.z > radius;
                               }};
    auto const centres = particle::random_places(box, radii, 5);
    double highest = 0, volume = 0;
    for (std::size_t a = 0; a < radii.size(); ++a) {
        highest = std::max(highest, centres[a].z + radii[a]);
        volume += 4.0 / 3.0 * math::pi * radii[a] * radii[a] * radii[a];
        for (std::size_t d = 0; d < 3; ++d) {
            EXPECT_GE(centres[a][d], radii[a]);
            EXPECT_LE(centres[a][d], box.upper[d] - radii[a]);
        }
        for (std::size_t b = 0; b < a; ++b) EXPECT_GT(norm(centres[a] - centres[b]), radii[a] + radii[b]);
    }
    EXPECT_NEAR(volume / (0.03 * 0.03 * highest), 0.30, 0.02);
    EXPECT_EQ(centres, particle::random_places(box, radii, 5));
    EXPECT_NE(centres, particle::random_places(box, radii, 6));
}

TEST(RandomPlaces, that_do_not_fit_are_refused)
{
    std::vector<double> const radii(200, 1e-3);
    particle::Region const box{{0, 0, 0}, {0.01, 0.01, 0.01}, [](auto const&, double) { return true; }};
    EXPECT_THROW(particle::random_places(box, radii, 1), base::NumericsError);
}

TEST(Lattice, with_noise_has_no_overlaps)
{
    geometry::Chamber box;
    box.size = {0.05, 0.05, 0.05};
    auto const still = particle::lattice(box, 1e-3, 2.2e-3, 1000);
    auto const moved = particle::lattice(box, 1e-3, 2.2e-3, 1000, 1.0, 4);
    EXPECT_NE(still, moved);
    for (std::size_t a = 0; a < moved.size(); ++a) {
        EXPECT_TRUE(box.inside(moved[a], 1e-3));
        for (std::size_t b = 0; b < a; ++b) EXPECT_GE(norm(moved[a] - moved[b]), 2e-3);
    }
}
}
