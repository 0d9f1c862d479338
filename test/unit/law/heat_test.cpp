// Heat and mass transfer between granules and gas: the three laws against tables made elsewhere.
#include "granum/law/heat/all.hpp"
#include "scene/reference.hpp"

#include <gtest/gtest.h>

namespace
{
using namespace granum;
using namespace granum::law;
using heat::Flow;

TEST(HeatLaws, agree_with_independent_numbers)
{
    struct Row
    {
        double re, eps, ranz_marshall, gunn, sun;
    };
    Row const rows[] = {{1, 0.5, 2.5353, 5.6632, 5.1993},
                        {10, 0.5, 3.6927, 8.3892, 6.8814},
                        {100, 0.5, 7.3527, 17.9838, 15.3122},
                        {50, 0.7, 5.7849, 9.0787, 7.0917},
                        {50, 1, 5.7849, 6.5244, 4.3450}};
    for (auto const& row : rows) {
        Flow const flow{1 - row.eps, row.re, 0.71};
        EXPECT_NEAR(heat::RanzMarshall{}(flow), row.ranz_marshall, 0.51e-4);
        EXPECT_NEAR(heat::Gunn{}(flow), row.gunn, 0.51e-4);
        EXPECT_NEAR(heat::Sun{}(flow), row.sun, 0.51e-4);
    }
}

TEST(HeatLaws, agree_with_the_reference_case)
{
    scene::Table const table("h-09.csv");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        Flow const flow{1 - table.number(row, "eps"), table.number(row, "Re"), table.number(row, "Pr")};
        EXPECT_NEAR(heat::Gunn{}(flow), table.number(row, "Nu_gunn"), 1e-6 * table.number(row, "Nu_gunn"));
        EXPECT_NEAR(heat::RanzMarshall{}(flow), table.number(row, "Nu_ranz_marshall_0.6"), 1e-6 * 20);
    }
}

TEST(HeatLaws, of_one_sphere_in_still_gas_are_pure_conduction)
{
    EXPECT_DOUBLE_EQ(heat::RanzMarshall{}({0, 0, 0.7}), 2);
    EXPECT_NEAR(heat::Gunn{}({0, 0, 0.7}), 2, 1e-12);
    EXPECT_NEAR(heat::Sun{}({0, 0, 0.7}), 2, 1e-12);
}

TEST(HeatLaws, grow_with_speed_and_stay_finite_beyond_their_range)
{
    for (auto const& name : heat::All::names()) {
        auto const law = *heat::All::make(name);
        for (double const phi : {0.0, 0.2, 0.45, 0.9}) {
            double last = 0;
            for (double const re : {-1.0, 0.01, 1.0, 100.0, 1e4}) {
                double const nusselt = heat::nusselt(law, {phi, re, 0.7});
                EXPECT_GT(nusselt, last) << name << " at solid fraction " << phi << " and Re " << re;
                last = nusselt;
            }
        }
    }
}
}
