// What is done to a drag law for mixtures of sizes and for cells that are too coarse.
#include "granum/law/drag/all.hpp"
#include "granum/law/drag/filtered.hpp"
#include "granum/law/drag/polydisperse.hpp"
#include "scene/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::law;

// Three sizes with numbers per volume such that they fill `phi`.
struct Mixture
{
    double phi = 0.4;
    std::vector<double> diameters{0.6e-3, 1e-3, 1.7e-3};
    std::vector<double> numbers{5, 2, 0.5};  // per m3, until scaled

    Mixture()
    {
        double volume = 0;
        for (std::size_t i = 0; i < 3; ++i) volume += numbers[i] * math::pi / 6 * std::pow(diameters[i], 3);
        for (double& number : numbers) number *= phi / volume;
    }
};
double const viscosity = 1.8e-5, gas_density = 1.2, slip = 1.1;

TEST(DragOfAMixture, adds_up_to_that_of_equal_spheres_of_the_sauter_mean)
{
    Mixture const mixture;
    double const mean = drag::sauter_mean(mixture.diameters, mixture.numbers), eps = 1 - mixture.phi;
    EXPECT_NEAR(mean, (5 * 0.216 + 2 + 0.5 * 4.913) / (5 * 0.36 + 2 + 0.5 * 2.89) * 1e-3, 1e-15);
    drag::Flow const flow{mixture.phi, gas_density * eps * slip * mean / viscosity};
    double const equal = mixture.phi / (math::pi / 6 * std::pow(mean, 3));  // spheres of the mean, per m3
    double const stokes = 3 * math::pi * viscosity * eps * slip;
    for (auto const& name : drag::All::names()) {
        auto const law = *drag::All::make(name);
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            double const d = mixture.diameters[i];
            sum += std::visit(
                [&](auto const& chosen) {
                    return mixture.numbers[i] * stokes * d * drag::force_ratio_of_size(chosen, flow, d / mean);
                },
                law);
        }
        double const expected = equal * stokes * mean * drag::force_ratio(law, flow);
        EXPECT_NEAR(sum, expected, 1e-12 * expected) << name;
    }
}

TEST(DragOfAMixture, gives_each_size_the_published_total_force_in_both_models)
{
    Mixture const mixture;
    double const mean = drag::sauter_mean(mixture.diameters, mixture.numbers), eps = 1 - mixture.phi;
    drag::Flow const flow{mixture.phi, gas_density * eps * slip * mean / viscosity};
    drag::Beetstra const law;
    // Model A in a steady fixed bed: eps grad p = - (sum of the drag per volume), and each granule gets -V grad p.
    double per_volume = 0;
    auto const proper = [&](double d) {
        return 3 * math::pi * viscosity * d * eps * slip * drag::force_ratio_of_size(law, flow, d / mean);
    };
    for (std::size_t i = 0; i < 3; ++i) per_volume += mixture.numbers[i] * proper(mixture.diameters[i]);
    double total_a = 0, total_b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double const d = mixture.diameters[i];
        double const model_a = proper(d) + math::pi / 6 * d * d * d * per_volume / eps;
        double const model_b =
            3 * math::pi * viscosity * d * slip * law(flow) * drag::total_force_share(d / mean, mixture.phi);
        EXPECT_NEAR(model_a, model_b, 1e-12 * model_b) << "diameter " << d;
        total_a += mixture.numbers[i] * model_a;
        total_b += mixture.numbers[i] * model_b;
    }
    EXPECT_NEAR(total_a, total_b, 1e-12 * total_b);
    EXPECT_NEAR(total_b, per_volume / eps, 1e-12 * total_b) << "the same pressure drop";
}

TEST(DragOfAMixture, leaves_equal_spheres_alone_unless_the_cubic_term_is_asked_for)
{
    EXPECT_DOUBLE_EQ(drag::total_force_share(1, 0.45), 1);
    EXPECT_DOUBLE_EQ(drag::total_force_share(1, 0.45, drag::CubicTerm::kept), 1 + 0.064 * 0.55);
    EXPECT_DOUBLE_EQ(drag::total_force_share(2, 0.4), 0.6 * 2 + 0.4 * 4);
}

// The blend, from the reference columns of its two laws: half of each at voidage 0.8, and next to the sharp switch of
// the reference away from it.
TEST(DragLaws, blend_about_the_switch_of_the_reference_case)
{
    scene::Table const table("x-06.csv");
    double const diameter = 1e-3;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        double const eps = table.number(row, "eps"), re = table.number(row, "Re_superficial");
        double const beta = 18 * viscosity * eps * (1 - eps) / (diameter * diameter) * drag::Gidaspow{}({1 - eps, re});
        double const dense = table.number(row, "beta_ergun"), dilute = table.number(row, "beta_wen_yu");
        double const sharp = table.number(row, "beta_gidaspow");
        if (eps == 0.8)
            EXPECT_NEAR(beta, 0.5 * (dense + dilute), 1e-3 * beta) << "row " << row;
        else  // atan leaves 1.3 % of the other law at 0.1 from the switch
            EXPECT_NEAR(beta, sharp, 0.013 * std::abs(dense - dilute) + 1e-6 * sharp) << "row " << row;
    }
}

drag::CoarseCell cell(double phi, double width)
{
    // Terminal velocity such that the cluster length u^2/g Fr^(-2/3) = (u^2/g)^(1/3) d^(2/3) is one diameter.
    return {.solid_fraction = phi,
            .width = width,
            .terminal_velocity = std::sqrt(9.81 * 1e-3),
            .diameter = 1e-3,
            .gravity = 9.81};
}

TEST(FilteredDrag, has_the_factor_of_the_tables)
{
    // By hand, cells as wide as the cluster length: 1 - h/(a + 1).
    EXPECT_NEAR(drag::filtered_factor(cell(0.01, 1e-3)), 1 - 0.0797 / 22.51, 1e-12);
    EXPECT_NEAR(drag::filtered_factor(cell(0.05, 1e-3)),
                1 - (0.239 + 0.0928 - 0.001764 + 0.00202904) / (1.96 + 1.47 + 0.412275 - 0.240375 + 1), 1e-12);
    EXPECT_NEAR(drag::filtered_factor(cell(0.2, 1e-3)),
                1 - (0.887 + 0.0206 - 0.002068 + 0.00004792) / (3.52 - 0.3598 + 0.05152 - 0.004824 + 1), 1e-12);
    EXPECT_NEAR(drag::filtered_factor(cell(0.5, 2e-3)), 1 - (0.85 - 0.027 - 0.002452 - 0.0010608) / (1.79 / 2 + 1),
                1e-12);
    // The optional factor of parcels.
    auto parcels = cell(0.2, 1e-3);
    parcels.parcel_ratio = 3, parcels.parcel_rate = 0.05;
    EXPECT_NEAR(drag::filtered_factor(parcels), std::exp(-0.1) * drag::filtered_factor(cell(0.2, 1e-3)), 1e-12);
}

TEST(FilteredDrag, takes_nothing_from_fine_cells_and_more_the_coarser_they_are)
{
    for (double const phi : {0.0, 0.01, 0.1, 0.3, 0.5, 0.6}) {
        EXPECT_NEAR(drag::filtered_factor(cell(phi, 1e-9)), 1, 1e-5) << phi;
        double last = 1;
        for (double width = 1e-4; width < 1; width *= 3) {
            double const factor = drag::filtered_factor(cell(phi, width));
            EXPECT_LE(factor, last) << phi;
            EXPECT_GE(factor, 0.05);
            last = factor;
        }
    }
    auto parcels = cell(0.3, 1e3);
    parcels.parcel_ratio = 10, parcels.parcel_rate = 0.05;
    EXPECT_EQ(drag::filtered_factor(parcels), 0.05);
    EXPECT_EQ(drag::filtered_factor(cell(0.65, 1)), 1) << "the table of h turns negative in a packing";
}

TEST(FilteredDrag, has_pieces_that_meet)
{
    // A misprint in a coefficient shows as a step; two steps are in the source.
    for (double const end : {0.100, 0.180, 0.250})
        EXPECT_NEAR(drag::filtered::a(end - 1e-9), drag::filtered::a(end), 6e-3) << end;
    for (double const end : {0.03, 0.08, 0.12, 0.18, 0.34, 0.48, 0.55})
        EXPECT_NEAR(drag::filtered::h(end - 1e-9), drag::filtered::h(end), 2e-3) << end;
    EXPECT_NEAR(drag::filtered::a(0.016 - 1e-9) - drag::filtered::a(0.016), 21.51 - 2.4647, 1e-3);
}
}
