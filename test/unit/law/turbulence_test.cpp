// The models of turbulence on prescribed gradients, against closed forms, and the law of the wall.
#include "granum/law/turbulence/all.hpp"
#include "granum/law/turbulence/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum::law;
using turbulence::Local;
using turbulence::Slopes;

Slopes shear(double s)
{
    Slopes out{};
    out[0][2] = s;
    return out;
}
Slopes plane_strain(double a)
{
    Slopes out{};
    out[0][0] = a, out[1][1] = -a;
    return out;
}
Slopes rotation(double w)
{
    Slopes out{};
    out[0][1] = -w, out[1][0] = w;
    return out;
}

TEST(Turbulence, of_every_model_is_nothing_in_gas_that_neither_strains_nor_has_eddies)
{
    for (auto const& name : turbulence::All::names()) {
        auto const model = *turbulence::All::make(name);
        EXPECT_EQ(turbulence::eddy_viscosity(model, {.viscosity = 1e-5, .width = 1e-3}), 0) << name;
        EXPECT_TRUE(std::isfinite(turbulence::eddy_viscosity(
            model, {.slopes = shear(1), .viscosity = 1e-5, .width = 1e-3, .energy = 1, .rate = 0})))
            << name;
    }
}

TEST(Turbulence, does_not_depend_on_the_axes)
{
    // The same strain, rotated by 45 degrees: a shear s is a plane strain s/2 and a rotation -s/2.
    Slopes turned{};
    turned[0][0] = 1, turned[2][2] = -1, turned[0][2] = 1, turned[2][0] = -1;
    for (auto const& name : turbulence::All::names()) {
        auto const model = *turbulence::All::make(name);
        Local const one{
            .slopes = shear(2), .viscosity = 1e-5, .width = 1e-3, .energy = 1, .rate = 1, .wall_distance = 1};
        Local other = one;
        other.slopes = turned;
        double const expected = turbulence::eddy_viscosity(model, one);
        EXPECT_NEAR(turbulence::eddy_viscosity(model, other), expected, 1e-12 * expected) << name;
    }
}

TEST(Smagorinsky, is_the_length_squared_times_the_strain)
{
    turbulence::Smagorinsky const model{.constant = 0.17};
    double const square = 0.17 * 0.17 * 0.02 * 0.02;
    EXPECT_NEAR(model({.slopes = shear(7), .width = 0.02}), square * 7, 1e-15);
    EXPECT_NEAR(model({.slopes = plane_strain(7), .width = 0.02}), square * 14, 1e-15);
    EXPECT_NEAR(model({.slopes = rotation(7), .width = 0.02}), 0, 1e-15);
}

TEST(Wale, vanishes_in_pure_shear_and_has_closed_forms_in_strain_and_rotation)
{
    turbulence::Wale const model;
    double const square = 0.325 * 0.325 * 0.02 * 0.02;
    EXPECT_EQ(model({.slopes = shear(7), .width = 0.02}), 0);
    // D:D = 2/3 a^4, S:S = 2 a^2.
    double const strained = std::pow(2.0 / 3, 1.5) / (std::pow(2.0, 2.5) + std::pow(2.0 / 3, 1.25));
    EXPECT_NEAR(model({.slopes = plane_strain(7), .width = 0.02}), square * 7 * strained, 1e-15);
    // D:D = 2/3 w^4, S:S = 0.
    EXPECT_NEAR(model({.slopes = rotation(7), .width = 0.02}), square * 7 * std::pow(2.0 / 3, 0.25), 1e-15);
}

TEST(KEpsilon, makes_what_shear_makes_and_loses_its_dissipation)
{
    turbulence::KEpsilon const model;
    Local const at{.slopes = shear(4), .viscosity = 1e-5, .energy = 2, .rate = 3};
    EXPECT_NEAR(model(at), 0.09 * 4 / 3.0, 1e-15);
    auto const budget = model.budget(at, model(at));
    EXPECT_NEAR(budget.made, 0.12 * 16, 1e-14);
    EXPECT_NEAR(budget.lost, 1.5, 1e-15);
    EXPECT_NEAR(budget.rate_made, 1.44 * 1.5 * 0.12 * 16, 1e-14);
    EXPECT_NEAR(budget.rate_lost, 1.92 * 1.5, 1e-14);
    // Quiet gas in strong shear makes ten times what it loses at most.
    Local const quiet{.slopes = shear(1e4), .viscosity = 1e-5, .energy = 1e-2, .rate = 1e-2};
    EXPECT_NEAR(model.budget(quiet, model(quiet)).made, 0.1, 1e-14);
    EXPECT_NEAR(model.rate_of(2, 0.1), std::pow(0.09, 0.75) * std::pow(2, 1.5) / 0.1, 1e-14);
}

TEST(KOmegaSst, is_k_over_omega_far_from_walls_and_bounded_by_shear_near_them)
{
    turbulence::KOmegaSst const model;
    Local at{.slopes = shear(100), .viscosity = 1e-5, .energy = 0.5, .rate = 20};
    EXPECT_NEAR(model(at), 0.5 / 20, 1e-15);
    // Beside a wall, where F2 = 1: a1 k / |S|.
    at.wall_distance = 1e-3;
    EXPECT_NEAR(model(at), 0.31 * 0.5 / 100, 1e-9);
    // Far from it the constants are those of k-epsilon, near it those of k-omega.
    at.slopes = {};
    EXPECT_NEAR(model.budget(at, model(at)).rate_lost, 0.075 * 20, 1e-9);
    at.wall_distance = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(model.budget(at, model(at)).rate_lost, 0.0828 * 20, 1e-12);
    EXPECT_NEAR(model.spread(at).rate, 0.856, 1e-12);
    // Production of k is bounded by ten times its dissipation.
    at.slopes = shear(1e4);
    EXPECT_NEAR(model.budget(at, model(at)).made, 10 * 0.09 * 0.5 * 20, 1e-12);
}

TEST(WallLaw, has_two_layers_that_meet)
{
    turbulence::WallLaw const law;
    // y = ln(9.8 y)/0.41, solved by bisection elsewhere.
    EXPECT_NEAR(law.edge(), 11.53, 0.005);
    EXPECT_NEAR(law.velocity(5), 5, 1e-15);
    EXPECT_NEAR(law.velocity(100), std::log(980.0) / 0.41, 1e-12);
    EXPECT_NEAR(law.velocity(law.edge() * (1 - 1e-9)), law.velocity(law.edge() * (1 + 1e-9)), 1e-6);
}

TEST(WallLaw, finds_its_place_from_the_speed)
{
    turbulence::WallLaw const law;
    double const edge = law.edge(), friction = 0.3, viscosity = 1.5e-5;
    for (double const y : {0.1, 3.0, 11.0, 12.0, 50.0, 1e3, 1e5}) {
        double const distance = y * viscosity / friction, speed = friction * law.velocity(y);
        EXPECT_NEAR(law.place(speed, distance, viscosity, edge), y, 1e-9 * y);
    }
}

TEST(WallLaw, passes_heat_as_momentum_where_both_prandtl_numbers_agree)
{
    turbulence::WallLaw const law;
    for (double const y : {2.0, 30.0, 500.0})
        EXPECT_NEAR(law.temperature(y, law.edge(), 0.85, 0.85), 0.85 * law.velocity(y), 1e-12);
}
}
