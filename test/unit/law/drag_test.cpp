// The drag laws: what must hold for every one of them, then numbers that did not come from this code.
#include "granum/law/drag/all.hpp"
#include "granum/law/drag/fluidisation.hpp"
#include "scene/drag_table.hpp"
#include "scene/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace
{
using namespace granum;
using namespace granum::law;
using drag::Flow;

template <class List>
struct AsTypes;
template <class... Laws>
struct AsTypes<base::TypeList<Laws...>>
{
    using type = ::testing::Types<Laws...>;
};

struct ByName
{
    template <class Law>
    static std::string GetName(int)
    {
        return std::string(Law::card.name);
    }
};

template <class Law>
struct EveryDragLaw : ::testing::Test
{
    Law law;
    std::string name{Law::card.name};
    static constexpr std::array<double, 9> packings{0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.65};
    static constexpr std::array<double, 10> speeds{0, 1e-9, 1e-4, 0.01, 1, 10, 100, 500, 1000, 5000};
};
TYPED_TEST_SUITE(EveryDragLaw, AsTypes<drag::All>::type, ByName);

// Laws that are known not to become Stokes' for one slow sphere, with what they give instead.
std::map<std::string, double> const not_stokes{
    {"ergun", 0},                                    // a packed bed's law: no granules, no drag
    {"gidaspow", 0.5 + std::atan(52.5) / math::pi},  // the blend still holds 0.6 % of Ergun at voidage 1
    {"di-felice", 0.96},                             // Dallavalle's coefficient: 4.8^2 / 24
    {"rong", 0.96},
};

// Laws of one sphere, which do not know of others.
std::set<std::string> const of_one_sphere{"stokes", "schiller-naumann"};

TYPED_TEST(EveryDragLaw, becomes_stokes_for_one_slow_sphere)
{
    auto const known = not_stokes.find(this->name);
    double const expected = known != not_stokes.end() ? known->second : 1;
    EXPECT_NEAR(this->law(Flow{0, 0}), expected, 1e-12);
}

TYPED_TEST(EveryDragLaw, is_continuous_as_the_slip_vanishes)
{
    for (double const phi : this->packings)
        EXPECT_NEAR(this->law(Flow{phi, 1e-12}), this->law(Flow{phi, 0}), 1e-6 * (1 + this->law(Flow{phi, 0})))
            << "at solid fraction " << phi;
}

TYPED_TEST(EveryDragLaw, the_force_grows_with_the_slip)
{
    for (double const phi : this->packings) {
        double last = 0;
        for (double const re : this->speeds) {
            double const force = re * this->law(Flow{phi, re});
            EXPECT_GE(force, last) << "at solid fraction " << phi << " and Re " << re;
            last = force;
        }
    }
}

TYPED_TEST(EveryDragLaw, grows_with_packing)
{
    if (of_one_sphere.contains(this->name)) {
        EXPECT_EQ(this->law(Flow{0, 50}), this->law(Flow{0.5, 50})) << "a law of one sphere knows no packing";
        return;
    }
    for (double const re : this->speeds)
        for (double phi = 0.01; phi < 0.65; phi += 0.01)
            EXPECT_GT(this->law(Flow{phi + 0.01, re}), this->law(Flow{phi, re}))
                << "at solid fraction " << phi << " and Re " << re;
}

TYPED_TEST(EveryDragLaw, stays_finite_and_positive_beyond_its_range)
{
    for (double const phi : {-0.1, 0.1, 0.7, 1.0, 2.0})
        for (double const re : {-1.0, 0.0, 1e5}) {
            double const force = this->law(Flow{phi, re});
            EXPECT_TRUE(std::isfinite(force)) << phi << " " << re;
            EXPECT_GE(force, 0) << phi << " " << re;
        }
}

TYPED_TEST(EveryDragLaw, is_found_by_its_name)
{
    auto const made = drag::All::make(this->name);
    ASSERT_TRUE(made.has_value());
    EXPECT_EQ(base::card_of(*made).name, this->name);
    EXPECT_EQ(drag::force_ratio(*made, Flow{0.4, 10}), this->law(Flow{0.4, 10}));
}

TEST(DragLaws, agree_with_independent_numbers)
{
    double const half = 0.501e-4;  // half a unit of the last digit
    for (auto const& row : scene::drag_table)
        for (std::size_t n = 0; n < scene::drag_table_laws.size(); ++n) {
            auto const law = *drag::All::make(scene::drag_table_laws[n]);
            EXPECT_NEAR(drag::force_ratio(law, Flow{1 - row[0], row[1]}), row[2 + n], half)
                << scene::drag_table_laws[n] << ", voidage " << row[0] << ", Re " << row[1];
        }
}

TEST(DragLaws, agree_with_the_reference_case_per_volume)
{
    scene::Table const table("x-06.csv");
    double const viscosity = 1.8e-5, diameter = 1e-3;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const eps = table.number(row, "eps"), phi = 1 - eps;
        Flow const flow{phi, table.number(row, "Re_superficial")};
        double const to_volume = 18 * viscosity * eps * phi / (diameter * diameter);  // beta = 18 mu eps phi F / d^2
        SCOPED_TRACE("row " + std::to_string(row));
        auto const expect = [&](double ratio, std::string const& column) {
            double const expected = table.number(row, column);
            EXPECT_NEAR(to_volume * ratio, expected, 1e-3 * expected) << column;
        };
        expect(drag::Ergun{}(flow), "beta_ergun");
        expect(drag::WenYu{}(flow), "beta_wen_yu");
        expect(drag::DiFelice{}(flow), "beta_di_felice");
        expect(drag::Beetstra{}(flow), "beta_beetstra");
        expect(drag::KochHill{}(flow), "beta_koch_hill");
    }
}

TEST(Gidaspow, is_ergun_when_dense_wen_yu_when_dilute_and_their_mean_between)
{
    for (double const re : {0.1, 10.0, 1000.0}) {
        Flow const dense{0.5, re}, dilute{0.03, re}, middle{0.2, re};
        EXPECT_NEAR(drag::Gidaspow{}(dense), drag::Ergun{}(dense), 5e-3 * drag::Ergun{}(dense));
        // 0.7 % of Ergun is left in the blend, and Ergun is several times the larger at high Re.
        EXPECT_NEAR(drag::Gidaspow{}(dilute), drag::WenYu{}(dilute), 0.04 * drag::WenYu{}(dilute));
        EXPECT_NEAR(drag::Gidaspow{}(middle), 0.5 * (drag::Ergun{}(middle) + drag::WenYu{}(middle)), 1e-9);
    }
}

TEST(MinimumFluidisation, agrees_with_independent_numbers)
{
    struct Bed
    {
        double diameter, density, ergun_40, ergun_42, ergun_45, beetstra_42;
    };
    Bed const beds[] = {
        {1.2e-3, 1000, 0.3580, 0.4044, 0.4780, 0.3838},   {2.5e-3, 2526, 1.2281, 1.3364, 1.5038, 1.4641},
        {3.256e-3, 1131, 0.9369, 1.0196, 1.1475, 1.1166}, {1e-3, 2500, 0.5608, 0.6291, 0.7367, 0.6051},
        {4.04e-3, 2526, 1.6534, 1.7889, 1.9981, 2.0645},  {3e-3, 2505, 1.3755, 1.4928, 1.6742, 1.6708},
        {0.6e-3, 1445, 0.1771, 0.2068, 0.2569, 0.1883},
    };
    double const half = 0.501e-4;
    for (auto const& bed : beds) {
        auto const speed = [&](auto law, double voidage) {
            return drag::minimum_fluidisation_velocity(law, bed.diameter, bed.density, 1.2, 1.8e-5, voidage);
        };
        SCOPED_TRACE("diameter " + std::to_string(bed.diameter));
        EXPECT_NEAR(speed(drag::Ergun{}, 0.40), bed.ergun_40, half);
        EXPECT_NEAR(speed(drag::Ergun{}, 0.42), bed.ergun_42, half);
        EXPECT_NEAR(speed(drag::Ergun{}, 0.45), bed.ergun_45, half);
        EXPECT_NEAR(speed(drag::Beetstra{}, 0.42), bed.beetstra_42, half);
    }
}

TEST(MinimumFluidisation, of_unknown_voidage_agrees_with_independent_numbers)
{
    struct Bed
    {
        double diameter, density, archimedes, speed;
    };
    for (auto const& bed : {Bed{1.2e-3, 1000, 6.271e4, 0.3385},
                            {2.5e-3, 2526, 1.433e6, 1.2628},
                            {3.256e-3, 1131, 1.417e6, 0.9633},
                            {1e-3, 2500, 9.079e4, 0.5380},
                            {4.04e-3, 2526, 6.049e6, 1.7236},
                            {3e-3, 2505, 2.456e6, 1.4233},
                            {0.6e-3, 1445, 1.133e4, 0.1569}}) {
        EXPECT_NEAR(drag::archimedes(bed.diameter, bed.density, 1.2, 1.8e-5), bed.archimedes, 5.1e-4 * bed.archimedes);
        EXPECT_NEAR(drag::wen_yu_fluidisation_velocity(bed.diameter, bed.density, 1.2, 1.8e-5), bed.speed, 0.51e-4);
    }
}

TEST(TerminalVelocity, agrees_with_independent_numbers)
{
    EXPECT_NEAR(drag::terminal_velocity(30e-6, 1000, 1.2, 1.8e-5), 0.02668, 0.5e-5);
    EXPECT_NEAR(drag::terminal_velocity(0.6e-3, 1445, 1.2, 1.8e-5), 3.0853, 0.51e-4);
    EXPECT_NEAR(drag::terminal_velocity(1e-3, 2500, 1.2, 1.8e-5), 6.8387, 1e-4);
    EXPECT_NEAR(drag::terminal_velocity(1.2e-3, 1000, 1.2, 1.8e-5), 4.5353, 0.51e-4);
}

TEST(TerminalVelocity, starts_the_settling_of_a_suspension)
{
    // The reference case tabulates v0 eps^n; the single sphere is ours to compute.
    double const alone = drag::terminal_velocity(1e-3, 2000, 1000, 1e-3);
    EXPECT_NEAR(alone, 0.112447, 1e-6);
    // Hindered settling by a law of the packing: v = eps * slip, with the mixture's weight on the sphere; the
    // correlation itself scatters by 10 %.
    scene::Table const table("x-05.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const phi = table.number(row, "phi_s"), eps = 1 - phi;
        double const measured = table.number(row, "hindered_velocity_m_per_s");
        double const force = eps * 1000 * 9.81 * math::pi * 1e-9 / 6;  // drag proper: eps of the buoyant weight
        double const settling = drag::superficial_speed(drag::DiFelice{}, force, phi, 1e-3, 1000, 1e-3);
        EXPECT_NEAR(settling, measured, 0.10 * measured) << "solid fraction " << phi;
    }
}
}
