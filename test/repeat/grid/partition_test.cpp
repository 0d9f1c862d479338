// Space is cut so that all ranks have as much to do in each half of a step: those that wait for each other.
#include "granum/par/partition.hpp"

#include "granum/grid/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using namespace granum;

//! What the ranks get of the points with `half`.
std::vector<double> shares(par::Partition const& partition, std::vector<math::Vec3> const& points,
                           std::vector<double> const& work, std::vector<bool> const& second, bool half)
{
    std::vector<double> out(static_cast<std::size_t>(partition.ranks()));
    for (std::size_t k = 0; k < points.size(); ++k)
        if (second[k] == half) out[static_cast<std::size_t>(partition.owner(points[k]))] += work[k];
    return out;
}

// A bed a tenth as high as its chamber, most of the work: a level cut would give one rank all granules, the other the
// cells, and each would wait while the other works.
TEST(Partition, of_a_low_bed_in_a_tall_chamber_stands_upright)
{
    par::Communicator const comm{MPI_COMM_WORLD};
    auto const lines = grid::uniform_lines({0, 0, 0}, {0.24, 0.24, 0.96}, {12, 12, 48});
    par::Space const space{{{0, 0, 0}, {0.24, 0.24, 0.96}}, {}};
    std::vector<math::Vec3> points;
    std::vector<double> work;
    std::vector<bool> second;
    for (int k = 0; k < 48; ++k)
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i) {
                points.push_back({0.02 * (i + 0.5), 0.02 * (j + 0.5), 0.02 * (k + 0.5)});
                work.push_back(k < 5 ? 400 : 0), second.push_back(false);
                points.push_back(points.back());
                work.push_back(50), second.push_back(true);
            }
    // Every rank names its share of the points.
    std::vector<math::Vec3> mine;
    std::vector<double> of_mine;
    std::vector<bool> halves;
    for (std::size_t k = static_cast<std::size_t>(comm.rank()); k < points.size();
         k += static_cast<std::size_t>(comm.size()))
        mine.push_back(points[k]), of_mine.push_back(work[k]), halves.push_back(second[k]);
    auto const partition = par::Partition::balanced(space, mine, of_mine, comm, &lines, halves);
    ASSERT_EQ(partition.ranks(), comm.size());
    for (bool const half : {false, true}) {
        auto const got = shares(partition, points, work, second, half);
        double sum = 0;
        for (double const one : got) sum += one;
        EXPECT_NEAR(*std::max_element(got.begin(), got.end()), sum / comm.size(), 0.01 * sum / comm.size()) << half;
    }
    // Cuts are faces of cells, and every point has one owner.
    for (int rank = 0; rank < comm.size(); ++rank) EXPECT_EQ(partition.box(rank).upper.z, 0.96) << "not cut level";
}

// Where there is one kind of work alone a tall column is cut level: the border is the shortest.
TEST(Partition, of_a_column_of_cells_has_the_shortest_border)
{
    par::Communicator const comm{MPI_COMM_WORLD};
    if (comm.size() == 1) GTEST_SKIP() << "needs two ranks";
    auto const lines = grid::uniform_lines({0, 0, 0}, {0.1, 0.1, 0.6}, {5, 5, 30});
    std::vector<math::Vec3> points;
    std::vector<double> work;
    if (comm.root())
        for (int k = 0; k < 30; ++k)
            for (int j = 0; j < 5; ++j)
                for (int i = 0; i < 5; ++i)
                    points.push_back({0.02 * (i + 0.5), 0.02 * (j + 0.5), 0.02 * (k + 0.5)}), work.push_back(1);
    auto const partition = par::Partition::balanced({{{0, 0, 0}, {0.1, 0.1, 0.6}}, {}}, points, work, comm, &lines);
    EXPECT_NEAR(partition.box(0).upper.z, comm.size() == 2 ? 0.3 : 0.2, 1e-12);
    EXPECT_EQ(partition.box(0).upper.x, 0.1);
}
}
