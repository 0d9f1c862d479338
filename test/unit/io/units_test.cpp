// Quantities as typed: right values, and a helpful word for each way to get one wrong.
#include "granum/io/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace granum::io
{
namespace
{
std::string fault(std::string_view text, Dimension dimension)
{
    try {
        read_quantity(text, dimension);
    } catch (QuantityError const& error) {
        return std::string(error.what()) + " | " + error.hint;
    }
    return "no fault";
}

struct Typed
{
    char const* text;
    Dimension dimension;
    double si;
};
class EveryUnit : public ::testing::TestWithParam<Typed>
{
};
}

TEST_P(EveryUnit, has_its_si_value)
{
    auto const& [text, dimension, si] = GetParam();
    EXPECT_NEAR(read_quantity(text, dimension), si, 1e-12 * std::abs(si)) << text;
}

INSTANTIATE_TEST_SUITE_P(
    of_a_process_engineer, EveryUnit,
    ::testing::Values(
        Typed{"0.6 mm", Dimension::length, 6e-4}, Typed{"40 um", Dimension::length, 4e-5},
        Typed{"40 µm", Dimension::length, 4e-5}, Typed{"25 cm", Dimension::length, 0.25},
        Typed{"0.6mm", Dimension::length, 6e-4}, Typed{"-3e-2 m", Dimension::length, -0.03},
        Typed{"1 kg", Dimension::mass, 1}, Typed{"500 g", Dimension::mass, 0.5}, Typed{"20 mg", Dimension::mass, 2e-5},
        Typed{"1 t", Dimension::mass, 1000}, Typed{"3 s", Dimension::time, 3}, Typed{"5 ms", Dimension::time, 5e-3},
        Typed{"2 min", Dimension::time, 120}, Typed{"1 h", Dimension::time, 3600},
        Typed{"300 K", Dimension::temperature, 300}, Typed{"80 degC", Dimension::temperature, 353.15},
        Typed{"80 °C", Dimension::temperature, 353.15}, Typed{"10 K", Dimension::temperature_difference, 10},
        Typed{"1 bar", Dimension::pressure, 1e5}, Typed{"20 mbar", Dimension::pressure, 2000},
        Typed{"101.325 kPa", Dimension::pressure, 101325}, Typed{"5 MPa", Dimension::pressure, 5e6},
        Typed{"1 barg", Dimension::pressure, 201325}, Typed{"120 m3/h", Dimension::volume_flow, 120.0 / 3600},
        Typed{"120 m³/h", Dimension::volume_flow, 120.0 / 3600}, Typed{"6 L/min", Dimension::volume_flow, 1e-4},
        Typed{"1 mL", Dimension::volume, 1e-6}, Typed{"1.2 kg/h", Dimension::mass_flow, 1.2 / 3600},
        Typed{"20 g/min", Dimension::mass_flow, 0.02 / 60}, Typed{"3 g/s", Dimension::mass_flow, 3e-3},
        Typed{"8 g/kg", Dimension::one, 8e-3}, Typed{"30 %", Dimension::one, 0.3}, Typed{"30 wt%", Dimension::one, 0.3},
        Typed{"0.01 kg/kg", Dimension::one, 0.01}, Typed{"0.3", Dimension::one, 0.3},
        Typed{"3 mPa s", Dimension::viscosity, 3e-3}, Typed{"3 mPa.s", Dimension::viscosity, 3e-3},
        Typed{"3 cP", Dimension::viscosity, 3e-3}, Typed{"63 mN/m", Dimension::surface_tension, 0.063},
        Typed{"180 deg", Dimension::angle, std::numbers::pi}, Typed{"1 rad", Dimension::angle, 1},
        Typed{"60 rpm", Dimension::angular_speed, 2 * std::numbers::pi}, Typed{"1.3 m/s", Dimension::velocity, 1.3},
        Typed{"9.81 m/s2", Dimension::acceleration, 9.81}, Typed{"1445 kg/m3", Dimension::density, 1445},
        Typed{"1.4 kJ/kg/K", Dimension::heat_capacity, 1400}, Typed{"1400 J/(kg K)", Dimension::heat_capacity, 1400},
        Typed{"144.1 g/mol", Dimension::molar_mass, 0.1441}, Typed{"100 W", Dimension::power, 100},
        Typed{"2 kJ", Dimension::energy, 2000}, Typed{"2 N", Dimension::force, 2},
        Typed{"20000 1/s", Dimension::count_rate, 2e4}));

TEST(Quantity, of_another_dimension_names_both)
{
    EXPECT_EQ(fault("0.6 kg", Dimension::length), "expects a length, got a mass (kg) | write it like \"0.6 mm\"");
    EXPECT_NE(fault("120 m3/h", Dimension::mass_flow).find("expects a mass flow, got a volume flow (m3/h)"),
              std::string::npos);
}

TEST(Quantity, of_a_fraction_is_no_angle)
{
    EXPECT_NE(fault("30 %", Dimension::angle).find("expects an angle"), std::string::npos);
    EXPECT_NE(fault("1 rad", Dimension::one).find("got an angle"), std::string::npos);
}

TEST(Quantity, without_a_unit_says_what_to_write)
{
    EXPECT_EQ(fault("0.6", Dimension::length), "needs a unit | expects a length, e.g. \"0.6 mm\"");
}

TEST(Quantity, with_a_decimal_comma_shows_the_point)
{
    EXPECT_EQ(fault("0,6 mm", Dimension::length), "has a decimal comma | write \"0.6 mm\"");
}

TEST(Quantity, with_an_unknown_unit_suggests_a_known_one)
{
    EXPECT_EQ(fault("1 KG", Dimension::mass), "has the unknown unit \"KG\" | did you mean \"kg\"?");
    EXPECT_EQ(fault("80 degc", Dimension::temperature), "has the unknown unit \"degc\" | did you mean \"degC\"?");
    EXPECT_NE(fault("2 mins", Dimension::time).find("did you mean \"min\"?"), std::string::npos);
}

TEST(Quantity, that_is_no_number_is_refused)
{
    for (auto const* text : {"", "mm", "fast", "nan m", "inf m", "1 m m3 &", "--1 m"})
        EXPECT_NE(fault(text, Dimension::length), "no fault") << text;
}

TEST(TemperatureDifference, has_no_zero_point)
{
    EXPECT_NE(fault("10 degC", Dimension::temperature_difference).find("write \"10 K\""), std::string::npos);
}

TEST(Quantity, written_is_read_back)
{
    for (int i = 0; i <= static_cast<int>(Dimension::count_rate); ++i) {
        auto const dimension = static_cast<Dimension>(i);
        double const value = 0.3125;
        EXPECT_NEAR(read_quantity(write_quantity(value, dimension), dimension), value,
                    1e-5 * value + (dimension == Dimension::temperature ? 1e-3 : 0))
            << name_of(dimension);
        EXPECT_NO_THROW(read_quantity(example_of(dimension), dimension)) << name_of(dimension);
    }
}
}
