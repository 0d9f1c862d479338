// What the gas gives in momentum and heat is what the granules get, by the law and for any parcel size.
#include "unit/coupling/bed.hpp"

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::coupling;

gas::Settings blown()
{
    gas::Settings settings;
    settings.inlets = {gas::Inlet{.mass_flow = 0.005, .temperature = 350, .vapour_fraction = 0.008}};
    settings.tolerance = 1e-10;
    return settings;
}

gas::Settings box_of_still_gas()
{
    gas::Settings settings;
    settings.outlets = {};
    settings.gravity = {};
    settings.density = 1.2, settings.viscosity = 1.8e-5;
    return settings;
}

struct RandomBed : testing::TestWithParam<double>
{
    Bed bed{cone(), cone_cells, {}, blown(), laws(), GetParam(), false, 330, {0, 0, 0.5}};
    RandomBed() { bed.fill(3000, 0.1, 27); }
};

TEST_P(RandomBed, gets_the_momentum_that_the_gas_gives)
{
    for (int step = 0; step < 3; ++step) {
        EXPECT_LT(bed.couple(1e-3), 1e-13);
        for (std::size_t d = 0; d < 3; ++d) {
            // The engine is told what the gas was told: the impulse it starts from is minus that of the gas step.
            double const told =
                bed.sum_over_granules([&](std::size_t row) { return bed.granules.drag_impulse[row][d]; });
            auto const velocity = bed.solver.cell_velocity(bed.state);
            double given = 0, measure = 0;
            grid::for_each_cell(bed.grid, [&](int, int, int, Index cell) {
                double const drag = bed.sources.drag_coefficient[cell] * velocity[d][cell];
                given += bed.sources.drag_momentum[d][cell] - drag;
                measure += std::abs(bed.sources.drag_momentum[d][cell]) + std::abs(drag);
            });
            EXPECT_NEAR(told / (1e-3 * bed.comm.sum(given)), 1, 1e-12 * bed.comm.sum(measure) / std::abs(given));
        }
    }
}

TEST_P(RandomBed, gets_the_heat_that_the_gas_gives)
{
    auto const stock = [&] {
        return bed.sum(bed.state.enthalpy) +
               bed.sum_over_granules([&](std::size_t row) { return bed.granules.enthalpy[row]; });
    };
    double passed = 0, moved = 0;
    double const start = stock();
    for (int step = 0; step < 5; ++step) {
        auto const before = bed.granules.enthalpy.values;
        bed.couple(1e-3);
        passed += bed.comm.sum(bed.passed.enthalpy_in - bed.passed.enthalpy_out);
        moved +=
            bed.sum_over_granules([&](std::size_t row) { return std::abs(bed.granules.enthalpy[row] - before[row]); });
    }
    ASSERT_GT(moved, 1);  // J, so that the next line says something
    EXPECT_NEAR((stock() - start - passed) / moved, 0, 1e-11);
    for (std::size_t row = 0; row < bed.granules.owned; ++row)
        EXPECT_NEAR(
            bed.exchange.heat_capacity(bed.granules, row) * (bed.granules.temperature[row] - math::zero_celsius),
            bed.granules.enthalpy[row], 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Exchange, RandomBed, testing::Values(0.0, 0.02),
                         [](auto const& param) { return param.param > 0 ? "smoothed" : "plain"; });

//! One parcel at rest in the middle of a periodic box of gas that moves at 1.5 m/s.
struct OneParcel
{
    Bed bed;
    OneParcel(Laws chosen, double count, double dt, bool frozen = false)
        : bed({.size = {0.04, 0.04, 0.04}}, {4, 4, 4}, {true, true, true}, box_of_still_gas(), std::move(chosen), 0,
              frozen, 293.15, {0, 0, 1.5})
    {
        bed.put(0, {.position = {0.015, 0.015, 0.015}, .count = count, .temperature = 333.15});
        bed.mapping.locate(bed.granules);
        bed.sources.clear(bed.grid);
        bed.state = bed.solver.start(bed.exchange.voidage(bed.granules), bed.grid.make_field(293.15), 0, {0, 0, 1.5});
        bed.exchange.share(bed.granules, bed.state, dt, bed.seen, bed.sources);
    }
    bool here() const { return bed.granules.owned == 1; }
};

TEST(Drag, on_a_parcel_is_that_of_its_real_granules_one_by_one)
{
    // In the cell's centre, so that all of the parcel lies in one cell of 1 cm3: solids 27 pi/6 d^3 / V.
    double const d = 0.6e-3, count = 27, phi = count * math::pi / 6 * d * d * d / 1e-6, eps = 1 - phi;
    double const re = 1.2 * eps * 1.5 * d / 1.8e-5;
    OneParcel const scene(laws(law::drag::WenYu{}), count, 1e-4);
    if (!scene.here()) return;
    auto const& seen = scene.bed.seen;
    EXPECT_NEAR(seen.solids_fraction[0], phi, 1e-14);
    EXPECT_NEAR(seen.velocity[0].z, 1.5, 1e-14);
    EXPECT_NEAR(seen.slip[0], eps * 1.5, 1e-14);
    EXPECT_NEAR(seen.reynolds[0], re, 1e-12);
    // Wen and Yu by hand in the convention 3 pi mu d eps (u - v) F: (1 + 0.15 Re^0.687) eps^-3.65.
    double const force =
        count * 3 * math::pi * 1.8e-5 * d * eps * (1 + 0.15 * std::pow(re, 0.687)) * std::pow(eps, -3.65);  // N per m/s
    double const mass = count * 1445 * math::pi / 6 * d * d * d;
    EXPECT_NEAR(seen.drag_coefficient[0], force, 1e-10 * force);
    EXPECT_NEAR(seen.drag[0], force / (1 + 1e-4 * force / mass), 1e-10 * force);
}

TEST(Drag, on_a_frozen_granule_is_not_eased_by_its_motion)
{
    OneParcel const free(laws(law::drag::Stokes{}), 1, 1e-2), frozen(laws(law::drag::Stokes{}), 1, 1e-2, true);
    if (!free.here()) return;
    double const stokes = 3 * math::pi * 1.8e-5 * 0.6e-3 * (1 - free.bed.seen.solids_fraction[0]);
    double const rate = stokes / frozen.bed.granules.mass[0];
    EXPECT_NEAR(frozen.bed.seen.drag[0], stokes, 1e-12 * stokes);
    EXPECT_NEAR(free.bed.seen.drag[0], stokes / (1 + 1e-2 * rate), 1e-12 * stokes);
}

TEST(Heat, of_a_parcel_is_that_of_its_real_granules_one_by_one)
{
    double const d = 0.6e-3, count = 8, dt = 1e-3;
    OneParcel const scene(laws(law::drag::Stokes{}, law::heat::RanzMarshall{}), count, dt);
    if (!scene.here()) return;
    double const re = scene.bed.seen.reynolds[0], t = 293.15;
    double const k = 0.0241 + 7.2e-5 * 20, prandtl = 1.8e-5 * 1006 / k;  // air at 20 degC, physics.md 2.2
    double const transfer = count * (2 + 0.6 * std::sqrt(re) * std::cbrt(prandtl)) * k * math::pi * d;
    double const capacity = count * 1445 * math::pi / 6 * d * d * d * Bed::heat_capacity;
    EXPECT_NEAR(scene.bed.seen.temperature[0], t, 1e-10);
    EXPECT_NEAR(scene.bed.seen.heat[0], capacity / dt * -std::expm1(-dt * transfer / capacity), 1e-9 * transfer);
}

TEST(Exchange, hands_what_the_engine_did_differently_to_the_gas_in_the_next_step)
{
    OneParcel scene(laws(law::drag::Stokes{}), 1, 1e-3);
    auto& bed = scene.bed;
    if (scene.here()) bed.granules.drag_impulse[0] = {3e-9, 0, -1e-9};
    bed.sources.clear(bed.grid);
    bed.exchange.share(bed.granules, bed.state, 1e-3, bed.seen, bed.sources);
    Field* fields[] = {&bed.sources.force[0], &bed.sources.force[2]};
    bed.mapping.finish(fields);
    EXPECT_NEAR(bed.sum(bed.sources.force[0]), -3e-6, 1e-18);
    EXPECT_NEAR(bed.sum(bed.sources.force[2]), 1e-6, 1e-18);
}

//! Light granules in a box of turbulent gas that moves at 1.5 m/s, and its sigma.
struct TurbulentBox
{
    Bed bed;
    static gas::Settings settings()
    {
        auto out = box_of_still_gas();
        out.turbulence.model = law::turbulence::KEpsilon{};
        out.turbulence.energy = 1.5;
        return out;
    }
    static Laws langevin()
    {
        auto out = laws(law::drag::Stokes{});
        out.dispersion = law::dispersion::Langevin{};
        return out;
    }
    TurbulentBox()
        : bed({.size = {0.04, 0.04, 0.04}}, {4, 4, 4}, {true, true, true}, settings(), langevin(), 0, false, 293.15,
              {0, 0, 1.5})
    {
        bed.granules.keep({.eddies = true});
        bed.fill(2000, 0.04, 1);
        for (std::size_t row = 0; row < bed.granules.owned; ++row) {
            base::Random random(3, base::Purpose::test, bed.granules.id[row], 0);
            bed.granules.fluctuation[row] = {random.normal(), random.normal(), random.normal()};
        }
    }
};

TEST(Dispersion, of_granules_takes_from_the_gas_what_they_receive)
{
    TurbulentBox scene;
    for (int step = 0; step < 3; ++step) EXPECT_LT(scene.bed.couple(1e-4), 1e-11);
}

TEST(Dispersion, shows_granules_a_gas_of_the_turbulences_variance)
{
    TurbulentBox scene;
    auto& bed = scene.bed;
    bed.couple(1e-4);
    double squares = 0, along = 0;
    for (std::size_t row = 0; row < bed.granules.owned; ++row) {
        squares += math::norm2(bed.seen.fluctuation[row]);
        along += bed.seen.velocity[row].z;
    }
    double const number = bed.comm.sum(static_cast<double>(bed.granules.owned));
    EXPECT_NEAR(bed.comm.sum(squares) / (3 * number), 1, 0.06);  // 2k/3; 6000 components leave 1.8 %
    EXPECT_NEAR(bed.comm.sum(along) / number, 1.5, 4 / std::sqrt(number));
}
}
