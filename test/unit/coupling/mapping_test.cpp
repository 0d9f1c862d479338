// What is spread is neither lost nor made, what is gathered with it is its adjoint, and even suspensions stay even.
#include "unit/coupling/bed.hpp"

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::coupling;

//! A number between 0.5 and 1.5 that belongs to a cell of the whole domain, whatever rank it is on.
double of_cell(Grid const& grid, int i, int j, int k)
{
    auto const id =
        static_cast<std::uint64_t>((i + grid.shift[0]) + 100 * ((j + grid.shift[1]) + 100 * (k + grid.shift[2])));
    return 0.5 + base::Random(3, base::Purpose::test, id, 1).uniform();
}
double of_granule(particle::Id id)
{
    return 0.5 + base::Random(3, base::Purpose::test, id, 2).uniform();
}

struct Way
{
    char const* name;
    Scheme scheme;
    double width;
};

struct Cone : testing::TestWithParam<Way>
{
    Bed bed{cone(), cone_cells, {}, {}, laws(), GetParam().width, false, 293.15, {}, MPI_COMM_WORLD, GetParam().scheme};
    Cone() { bed.fill(2000, 0.2, 27); }

    Field spread()
    {
        bed.mapping.locate(bed.granules);
        Field field = bed.grid.make_field();
        for (std::size_t row = 0; row < bed.granules.owned; ++row)
            bed.mapping.spread(bed.mapping.stencils()[row], of_granule(bed.granules.id[row]), field);
        Field* fields[] = {&field};
        bed.mapping.finish(fields);
        return field;
    }
};

TEST_P(Cone, spreads_all_of_every_amount_and_none_into_closed_cells)
{
    auto const field = spread();
    double const amount = bed.sum_over_granules([&](std::size_t row) { return of_granule(bed.granules.id[row]); });
    EXPECT_EQ(bed.comm.sum(static_cast<long>(bed.granules.owned)), 2000);
    EXPECT_NEAR(bed.sum(field) / amount, 1, 1e-13);
    grid::for_each_cell(bed.grid, [&](int, int, int, Index cell) {
        if (!bed.grid.open(cell)) {
            EXPECT_EQ(field[cell], 0);
        }
        EXPECT_GE(field[cell], 0);
    });
}

TEST_P(Cone, gathers_with_the_adjoint_of_what_it_spreads_with)
{
    auto const field = spread();
    Field seen = bed.grid.make_field();
    double cells = 0;
    grid::for_each_cell(bed.grid, [&](int i, int j, int k, Index cell) {
        seen[cell] = of_cell(bed.grid, i, j, k);
        cells += seen[cell] * field[cell];
    });
    Field* fields[] = {&seen};
    bed.mapping.prepare(fields);
    double const granules = bed.sum_over_granules([&](std::size_t row) {
        return of_granule(bed.granules.id[row]) * bed.mapping.gather(bed.mapping.stencils()[row], seen);
    });
    EXPECT_NEAR(granules / bed.comm.sum(cells), 1, 1e-13);
}

TEST_P(Cone, sees_a_uniform_field_everywhere_as_it_is)
{
    bed.mapping.locate(bed.granules);
    Field field = bed.grid.make_field(3.25);
    Field* fields[] = {&field};
    bed.mapping.prepare(fields);
    for (std::size_t row = 0; row < bed.granules.owned; ++row)
        EXPECT_NEAR(bed.mapping.gather(bed.mapping.stencils()[row], field), 3.25, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Mapping, Cone,
                         testing::Values(Way{"kernel", Scheme::kernel, 0}, Way{"smoothed", Scheme::kernel, 0.03},
                                         Way{"centre", Scheme::centre, 0}, Way{"centre_smoothed", Scheme::centre, 0.03},
                                         Way{"divided", Scheme::divided, 0}),
                         [](auto const& param) { return param.param.name; });

//! Standard deviation along each direction of what `mapping` makes of points anywhere in one cell.
std::array<double, 3> deviation(Bed& bed, Vec3 const& corner, Vec3 const& cell)
{
    constexpr int points = 5;
    std::array<double, 3> second{};
    for (int p = 0; p < points * points * points; ++p) {
        Vec3 const part{(p % points + 0.5) / points, (p / points % points + 0.5) / points,
                        (p / points / points + 0.5) / points};
        Vec3 const x{corner.x + part.x * cell.x, corner.y + part.y * cell.y, corner.z + part.z * cell.z};
        Field field = bed.grid.make_field();
        if (bed.mine(x)) bed.mapping.spread(bed.mapping.stencil(x), 1.0, field);
        Field* fields[] = {&field};
        bed.mapping.finish(fields);
        grid::for_each_cell(bed.grid, [&](int i, int j, int k, Index at) {
            Vec3 const away = bed.grid.centre(i, j, k) - x;
            for (std::size_t d = 0; d < 3; ++d) second[d] += field[at] * away[d] * away[d] / (points * points * points);
        });
    }
    bed.comm.sum(second);
    for (double& value : second) value = std::sqrt(value);
    return second;
}

TEST(Mapping, smooths_to_the_stated_standard_deviation_whatever_the_cells_have_of_it)
{
    for (auto const scheme : {Scheme::kernel, Scheme::centre}) {
        double const width = 0.0125;
        Bed bed({.size = {0.12, 0.16, 0.16}}, {12, 20, 32}, {}, {}, laws(), width, false, 293.15, {}, MPI_COMM_WORLD,
                scheme);
        // Five points a direction instead of all: 4 % of the cells' own variance.
        for (double const got : deviation(bed, {0.06, 0.08, 0.08}, {0.01, 0.008, 0.005}))
            EXPECT_NEAR(got, width, 0.02 * width);
    }
}

TEST(Mapping, needs_no_smoothing_in_cells_that_are_wide_enough)
{
    Bed const bed({.size = {0.12, 0.12, 0.12}}, {12, 12, 12}, {}, {}, laws(), 0.004);
    EXPECT_EQ(bed.mapping.passes(), 0);
}

TEST(Mapping, hardly_shows_on_which_point_of_the_cells_a_granule_lies)
{
    // The voidage that one granule in 10 x 10 x 10 cells of its size sees of itself, as it moves through the cells
    // (physics.md 3.4: below 1 %).
    for (double const ratio : {1.0, 1.5, 2.0, 3.0}) {
        double const d = 1e-3, cell = ratio * d;
        Bed bed({.size = {12 * cell, 12 * cell, 12 * cell}}, {12, 12, 12}, {true, true, true}, {}, laws(), 1.5 * d);
        double least = 1, most = 0;
        for (int p = 0; p < 40; ++p) {
            Vec3 const x{(5 + 0.025 * p) * cell, (5.3 + 0.011 * p) * cell, (5.1 + 0.017 * p) * cell};
            Field solids = bed.grid.make_field();
            if (bed.mine(x)) bed.mapping.spread(bed.mapping.stencil(x), math::pi / 6 * d * d * d, solids);
            Field* fields[] = {&solids};
            bed.mapping.finish(fields);
            for (Index c = 0; c < solids.size(); ++c)
                solids[c] = bed.grid.open(c) ? 1 - solids[c] / bed.grid.open_volume[c] : 1;
            bed.mapping.prepare(fields);
            double const seen = bed.mine(x) ? bed.mapping.gather(bed.mapping.stencil(x), solids) : 0;
            double const eps = bed.comm.sum(seen);
            least = std::min(least, eps), most = std::max(most, eps);
        }
        EXPECT_LT(most - least, 0.01) << "cells of " << ratio << " diameters";
    }
}

//! Eight granules in every cell of a box, at quarter points, on all ranks together.
void fill_evenly(Bed& bed, std::array<int, 3> cells, double diameter)
{
    particle::Id id = 0;
    for (int k = 0; k < 2 * cells[2]; ++k)
        for (int j = 0; j < 2 * cells[1]; ++j)
            for (int i = 0; i < 2 * cells[0]; ++i)
                bed.put(id++, {.position = {(i + 0.5) * 0.5 * bed.grid.axes[0].width(0),
                                            (j + 0.5) * 0.5 * bed.grid.axes[1].width(0),
                                            (k + 0.5) * 0.5 * bed.grid.axes[2].width(0)},
                               .diameter = diameter});
}

TEST(Voidage, of_an_even_suspension_is_even_up_to_the_walls)
{
    std::array<int, 3> const cells{6, 4, 5};
    for (bool const periodic : {false, true})
        for (double const bandwidth : {0.0, 0.004}) {
            Bed bed({.size = {0.012, 0.008, 0.010}}, cells, {periodic, periodic, false}, {}, laws(), bandwidth);
            fill_evenly(bed, cells, 0.8e-3);
            bed.mapping.locate(bed.granules);
            auto const voidage = bed.exchange.voidage(bed.granules);
            double const expected = 1 - 8 * math::pi / 6 * std::pow(0.8e-3, 3) / std::pow(0.002, 3);
            grid::for_each_cell(bed.grid,
                                [&](int, int, int, Index cell) { EXPECT_NEAR(voidage[cell], expected, 1e-13); });
            EXPECT_EQ(bed.exchange.clamped_cells(), 0);
        }
}

TEST(Voidage, leaves_room_for_just_the_granules_that_are_there)
{
    Bed bed(cone(), cone_cells, {}, {}, laws(), 0.02);
    bed.fill(3000, 0.2, 27);
    bed.mapping.locate(bed.granules);
    auto const voidage = bed.exchange.voidage(bed.granules);
    double solids = 0;
    grid::for_each_cell(bed.grid,
                        [&](int, int, int, Index cell) { solids += (1 - voidage[cell]) * bed.grid.open_volume[cell]; });
    ASSERT_EQ(bed.comm.sum(bed.exchange.clamped_cells()), 0);
    EXPECT_NEAR(bed.comm.sum(solids), 3000 * 27 * math::pi / 6 * std::pow(0.6e-3, 3), 1e-15);
}

TEST(Voidage, never_falls_below_the_densest_packing_and_says_where_it_would)
{
    Bed bed({.size = {0.012, 0.008, 0.010}}, {6, 4, 5}, {}, {}, laws());
    for (particle::Id id = 0; id < 20; ++id) bed.put(id, {.position = {0.005, 0.005, 0.005}, .diameter = 1e-3});
    bed.mapping.locate(bed.granules);
    auto const voidage = bed.exchange.voidage(bed.granules);
    long clamped = 0;
    grid::for_each_cell(bed.grid, [&](int, int, int, Index cell) {
        EXPECT_GE(voidage[cell], 0.35);
        clamped += voidage[cell] == 0.35;
    });
    EXPECT_EQ(bed.comm.sum(clamped), 1);
    EXPECT_GE(bed.comm.sum(bed.exchange.clamped_cells()), 1);
}
}
