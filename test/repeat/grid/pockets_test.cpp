// What is closed in a chamber with bodies is the same on any number of ranks, however a pocket winds across their
// borders.
#include "granum/geometry/bodies_in_chamber.hpp"
#include "granum/grid/build.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum;
using geometry::Box;
using geometry::Region;

constexpr std::array<int, 3> cells{12, 6, 24};

//! Slices across z, of unlike thickness.
std::vector<grid::CellBox> slices(int ranks)
{
    std::vector<grid::CellBox> out;
    int from = 0;
    for (int rank = 0; rank < ranks; ++rank) {
        int const to = rank + 1 == ranks ? cells[2] : from + 5 + rank;
        out.push_back({{0, 0, from}, {cells[0], cells[1], to}});
        from = to;
    }
    return out;
}

//! A box of 120 x 60 x 240 mm that is filled but for two parts: the lower end, and a channel that goes up, across, down
//! and up again beside it. A hole may join them.
geometry::Chamber winding(bool joined)
{
    Region space = Region("end", Box{{0, 0, 0}, {0.12, 0.06, 0.04}}) |
                   Region("first", Box{{0.01, 0.01, 0.06}, {0.03, 0.05, 0.22}}) |
                   Region("bridge", Box{{0.03, 0.01, 0.19}, {0.06, 0.05, 0.22}}) |
                   Region("second", Box{{0.05, 0.01, 0.06}, {0.07, 0.05, 0.22}}) |
                   Region("dip", Box{{0.07, 0.01, 0.06}, {0.1, 0.05, 0.09}}) |
                   Region("third", Box{{0.09, 0.01, 0.06}, {0.11, 0.05, 0.24}});
    if (joined) space = space | Region("hole", Box{{0.01, 0.01, 0.03}, {0.03, 0.05, 0.07}});
    return geometry::chamber_of(space);
}

double open_volume(geometry::Chamber const& chamber, par::Communicator const& comm)
{
    auto const lines = grid::uniform_lines({0, 0, 0}, {0.12, 0.06, 0.24}, cells);
    auto const grid = grid::build(grid::openness(chamber), lines, grid::Layout{cells, {}, slices(comm.size())}, comm);
    double sum = 0;
    grid::for_each_cell(grid, [&](int, int, int, grid::Index c) {
        sum += grid.open_volume[c];
        for (std::size_t d = 0; d < 3; ++d)
            EXPECT_TRUE(grid.open_area[d][c] == 0 || grid.open(c)) << "a closed cell has an open face";
    });
    return comm.sum(sum);
}

TEST(Pockets, are_closed_alike_on_any_ranks)
{
    par::Communicator const comm(MPI_COMM_WORLD);
    constexpr double end = 0.12 * 0.06 * 0.04, hole = 0.02 * 0.04 * 0.02;
    constexpr double channel = 0.04 * (0.02 * 0.16 * 2 + 0.02 * 0.18 + 2 * 0.02 * 0.03);
    EXPECT_NEAR(open_volume(winding(true), comm), end + hole + channel, 1e-9);
    // Alone the channel is the larger part: it stays, and the end is closed.
    EXPECT_GT(channel, end);
    EXPECT_NEAR(open_volume(winding(false), comm), channel, 1e-9);
}
}
