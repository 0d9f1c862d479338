// Which granules a droplet may strike: those within its reach, however wide the cells of the gas are.
#include "granum/sim/surroundings.hpp"

#include "scene/case_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using math::Vec3;

constexpr double edge = 0.1, reach = 7e-3;  // m

//! Parcels at random in a box of still gas of `cells` cells along each side.
struct Bed
{
    std::unique_ptr<sim::Simulation> simulation;
    coupling::Mapping mapping;
    std::vector<spray::Nozzle> nozzles;
    par::Partition partition;
    sim::DropletSurroundings around;
    gas::Sources sources;

    static std::string text(int cells)
    {
        return fmt::format(R"(
[apparatus]
shape = "box"
size = ["100 mm", "100 mm", "100 mm"]
[gas]
closed = true
cells = [{0}, {0}, {0}]
[start]
quasi_steady = false
[granules]
diameter = "0.5 mm"
parcel_ratio = 8
density = "1500 kg/m3"
mass = "200 g"
start = "loose"
frozen = true
[contact]
youngs_modulus = "10 MPa"
[time]
duration = "1 s"
)",
                           cells);
    }
    explicit Bed(int cells, double within = reach)
        : simulation(scene::simulation_of(text(cells))),
          mapping(simulation->grid(), simulation->comm(), 0),
          partition(par::Space{{{0, 0, 0}, {edge, edge, edge}}, {}}),
          around(simulation->grid(), mapping, nozzles, partition, 0, within)
    {
        simulation->step(1e-3);
        sources.clear(simulation->grid());
        mapping.locate(simulation->granules());
        around.prepare(simulation->solver(), simulation->gas(), simulation->granules(), sources, 1e-3, false);
    }
    double solids_at(Vec3 const& x) const { return around.seen(x).solids_fraction; }
};

double distance(Vec3 const& a, Vec3 const& b)
{
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

TEST(Targets, are_the_parcels_within_reach_and_offer_their_own_density)
{
    for (int const cells : {6, 20}) {
        Bed const bed(cells);
        auto const& granules = bed.simulation->granules();
        std::vector<spray::Target> found;
        double offered = 0, known = 0;
        for (std::uint64_t n = 0; n < 400; ++n) {
            base::Random random(1, base::Purpose::test, n, 0);
            Vec3 x = granules.position[n];
            for (std::size_t d = 0; d < 3; ++d) x[d] = std::clamp(x[d] + 12e-3 * (random.uniform() - 0.5), 0.0, edge);
            bed.around.targets(x, found);
            std::size_t within = 0;
            for (std::size_t row = 0; row < granules.owned; ++row)
                within += distance(granules.position[row], x) < reach;
            ASSERT_EQ(found.size(), within);
            for (auto const& target : found) {
                ASSERT_LT(distance(granules.position[target.row], x), reach);
                ASSERT_GT(target.chance, 0);
                offered += target.chance * math::pi / 6 * std::pow(target.diameter, 3);
            }
            known += bed.solids_at(x);
        }
        EXPECT_NEAR(offered / known, 1, 0.1) << "solids, in the mean, as the cells know them";
    }
}

TEST(Targets, offer_beside_walls_what_they_offer_far_from_them)
{
    constexpr double wide = 20e-3, radius = 2e-3;
    Bed const bed(10, wide);
    std::vector<spray::Target> found;
    auto const mean_at = [&](double z) {
        double sum = 0;
        constexpr int places = 2000;
        for (int n = 0; n < places; ++n) {
            base::Random random(2, base::Purpose::test, static_cast<std::uint64_t>(n), 0);
            bed.around.targets({edge * random.uniform(), edge * random.uniform(), z}, found);
            for (auto const& target : found) sum += target.chance;
        }
        return sum / places;
    };
    EXPECT_NEAR(mean_at(radius) / mean_at(wide + radius), 1, 0.2) << "a kernel cut by the plate: 0.6";
}

TEST(Targets, are_likelier_the_nearer_they_are_whatever_the_cells)
{
    Bed const wide(6), fine(20);
    auto const &one = wide.simulation->granules(), &other = fine.simulation->granules();
    std::vector<spray::Target> few, same;
    for (std::size_t row = 0; row < 50; ++row) {
        ASSERT_EQ(one.position[row], other.position[row]);
        Vec3 const x = one.position[row];
        wide.around.targets(x, few);
        fine.around.targets(x, same);
        ASSERT_EQ(few.size(), same.size());
        auto const share = [](std::vector<spray::Target> const& of, std::size_t which) {
            double sum = 0, part = 0;
            for (auto const& target : of) sum += target.chance, part += target.row == which ? target.chance : 0;
            return part / sum;
        };
        for (auto const& target : few) EXPECT_NEAR(share(few, target.row), share(same, target.row), 1e-12);
        EXPECT_GT(share(few, row), 1.0 / static_cast<double>(few.size() + 1));
    }
}
}
